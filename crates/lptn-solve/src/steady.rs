//! Steady state by direct solution.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::linear::{self, LinearSolver};
use lptn_integrate::{FactorError, Pattern};
use lptn_network::{Network, NodeId};

use crate::error::SteadyError;

/// The temperatures at which nothing is stored any more.
#[derive(Clone, Debug)]
pub struct SteadyState {
    /// Temperature of each node in K.
    pub temperatures: Vec<f64>,
    /// Temperature of each boundary in K.
    pub boundary_temperatures: Vec<f64>,
    /// Heat flow of each conductor in W, positive from `from` to `to`.
    pub conductor_heat: Vec<f64>,
    /// Heat of each source in W.
    pub source_heat: Vec<f64>,
    /// Heat that each boundary gives to the network in W.
    pub boundary_heat: Vec<f64>,
}

/// How far heat in and heat out of a steady state may differ, relative to the heat turned over.
const BALANCE: f64 = 1e-9;

impl SteadyState {
    /// Solves `G T = q` with the inputs as they are at `time` \[s\].
    ///
    /// # Errors
    /// [`SteadyError`], in particular for nodes without a path to a boundary.
    pub fn solve(system: &ThermalSystem, time: f64) -> Result<Self, SteadyError> {
        let network = system.network();
        let loose: Vec<NodeId> = network.ungrounded().into_iter().flatten().collect();
        if !loose.is_empty() {
            let names = loose.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
            return Err(SteadyError::NoBoundary { nodes: loose, names });
        }
        let mut work = system.workspace();
        system.read_inputs(&mut work, time, time).map_err(SteadyError::Input)?;
        let states = states(system, &work)?;
        system.recover(&mut work, &states);
        let steady = Self::from_workspace(system, &work);
        if steady.imbalance().abs() > BALANCE * steady.turned_over() + rounding(network, &steady) {
            return Err(SteadyError::Unbalanced { residual: steady.imbalance() / steady.turned_over() });
        }
        Ok(steady)
    }

    fn from_workspace(system: &ThermalSystem, work: &Workspace) -> Self {
        let network = system.network();
        let mut conductor_heat = vec![0.0; network.conductors().len()];
        let mut boundary_heat = vec![0.0; network.boundaries().len()];
        system.conductor_heat(work, &mut conductor_heat);
        system.boundary_heat(work, &mut boundary_heat);
        Self {
            temperatures: system.node_temperatures(work).to_vec(),
            boundary_temperatures: system.boundary_temperatures(work).to_vec(),
            conductor_heat,
            source_heat: system.source_powers(work).to_vec(),
            boundary_heat,
        }
    }

    /// Heat of all sources and boundaries in W: zero but for rounding.
    pub fn imbalance(&self) -> f64 {
        self.source_heat.iter().chain(&self.boundary_heat).sum()
    }

    /// The sum of the absolute heat of every source, boundary and conductor in W.
    pub fn turned_over(&self) -> f64 {
        let all = self.source_heat.iter().chain(&self.boundary_heat).chain(&self.conductor_heat);
        all.map(|q| q.abs()).sum()
    }
}

/// What rounding the temperatures alone does to the balance in W: a network at one temperature carries heat
/// of this size, and nothing else.
fn rounding(network: &Network, steady: &SteadyState) -> f64 {
    let all = steady.temperatures.iter().chain(&steady.boundary_temperatures);
    let hottest = all.copied().fold(0.0, f64::max);
    let conductance: f64 = network.conductor_ids().map(|id| network.conductance(id)).sum();
    4.0 * f64::EPSILON * conductance * hottest
}

/// Temperatures of the states. The solution is sought as a rise over one boundary, so that a network at rest
/// is at rest to the last digit.
fn states(system: &ThermalSystem, work: &Workspace) -> Result<Vec<f64>, SteadyError> {
    let n = system.states().len();
    if n == 0 {
        return Ok(Vec::new());
    }
    let reference = system.boundary_temperatures(work)[0];
    let mut flow = vec![0.0; n];
    system.flow(work, &vec![reference; n], &mut flow);
    let mut values = vec![0.0; system.pattern().entries()];
    system.jacobian(&mut values);
    values.iter_mut().for_each(|v| *v = -*v);
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    let rise = rise(&pattern, &values, &flow).map_err(SteadyError::Factorization)?;
    Ok(rise.iter().map(|rise| reference + rise).collect())
}

/// Steps of iterative refinement: one recovers what a spread of conductances costs, the second is free of it.
const REFINEMENTS: usize = 2;

fn rise(pattern: &Pattern, values: &[f64], flow: &[f64]) -> Result<Vec<f64>, FactorError> {
    let mut factors = linear::new(pattern, true, LinearSolver::Auto)?;
    factors.factorize(values)?;
    factors.check(pattern, values)?;
    let mut rise = vec![0.0; flow.len()];
    linear::solve_refined(&mut *factors, (pattern, values), flow, &mut rise, REFINEMENTS)?;
    Ok(rise)
}
