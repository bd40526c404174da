//! Steady state by direct solution.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::FactorError;
use lptn_network::{Network, NodeId};

use crate::conductances::Conductances;
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
    /// Solves `G T = q` with the inputs as they are at `time` in s.
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
        system.read_inputs(&mut work, time, just_after(time)).map_err(SteadyError::Input)?;
        let states = states(system, &work).map_err(SteadyError::Factorization)?;
        system.recover(&mut work, &states);
        let steady = Self::from_workspace(system, &work, &states);
        if steady.imbalance().abs() > BALANCE * steady.turned_over() + rounding(system, &steady) {
            return Err(SteadyError::Unbalanced { residual: steady.imbalance() / steady.turned_over() });
        }
        check_absolute(network, &steady.temperatures)?;
        Ok(steady)
    }

    fn from_workspace(system: &ThermalSystem, work: &Workspace, states: &[f64]) -> Self {
        let network = system.network();
        let mut boundary_heat = vec![0.0; network.boundaries().len()];
        system.boundary_heat(work, states, &mut boundary_heat);
        Self {
            temperatures: system.node_temperatures(work).to_vec(),
            boundary_temperatures: system.boundary_temperatures(work).to_vec(),
            conductor_heat: network.conductor_ids().map(|id| system.conductor_heat(work, id)).collect(),
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

/// A time at which comparisons of `t` have the truth that holds from `time` on: a jump at the start is over, as
/// it is in the first row of a run. The distance is far below any thermal time.
pub(crate) fn just_after(time: f64) -> f64 {
    time + 1e-12 * time.abs().max(1.0)
}

/// What the last digit of the temperatures does to the balance in W: a network at one temperature carries heat of
/// this size and nothing else.
fn rounding(system: &ThermalSystem, steady: &SteadyState) -> f64 {
    let all = steady.temperatures.iter().chain(&steady.boundary_temperatures);
    4.0 * f64::EPSILON * system.boundary_conductance() * all.copied().fold(0.0, f64::max)
}

fn check_absolute(network: &Network, temperatures: &[f64]) -> Result<(), SteadyError> {
    match temperatures.iter().position(|&t| t < 0.0) {
        Some(i) => Err(SteadyError::BelowAbsoluteZero {
            name: network.nodes()[i].name.clone(),
            temperature: temperatures[i],
        }),
        None => Ok(()),
    }
}

/// Temperatures of the states, sought as a rise over one boundary.
fn states(system: &ThermalSystem, work: &Workspace) -> Result<Vec<f64>, FactorError> {
    let start = system.boundary_temperatures(work).first().copied().unwrap_or(0.0);
    Conductances::new(system)?.states(work, start, Conductances::REFINEMENTS)
}
