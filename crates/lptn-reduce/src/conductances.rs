//! Rises from heat alone: `G x = b`, solved to the last digits.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::linear::{self, Factorization, LinearSolver};
use lptn_integrate::{FactorError, Pattern};

use crate::error::ReduceError;

/// The factorised conductances of a system with all its boundaries at zero.
pub(crate) struct Conductances<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    /// `None` for a system without states.
    factors: Option<Box<dyn Factorization>>,
    still: Vec<f64>,
}

/// Most steps of iterative refinement; two are usual.
const REFINEMENTS: usize = 6;

impl<'a> Conductances<'a> {
    /// Factorises the conductances; the network must be grounded.
    pub(crate) fn new(system: &'a ThermalSystem) -> Result<Self, FactorError> {
        let still = vec![0.0; system.network().boundaries().len()];
        let factors = if system.states().is_empty() { None } else { Some(factorized(system)?) };
        Ok(Self { system, work: system.workspace(), factors, still })
    }

    /// Rise of every node in K for these heats into the nodes in W.
    pub(crate) fn rise(&mut self, heat: &[f64]) -> Result<Vec<f64>, ReduceError> {
        self.system.apply(&mut self.work, heat, &self.still);
        let states = self.states(REFINEMENTS)?;
        self.system.recover(&mut self.work, &states);
        Ok(self.system.node_temperatures(&self.work).to_vec())
    }

    /// Rise of every state in K for these heats into the states in W, refined once.
    pub(crate) fn state_rise(&mut self, heat: &[f64]) -> Result<Vec<f64>, ReduceError> {
        let mut nodes = vec![0.0; self.system.network().nodes().len()];
        self.system.states().iter().zip(heat).for_each(|(id, q)| nodes[id.index()] = *q);
        self.system.apply(&mut self.work, &nodes, &self.still);
        self.states(1)
    }

    /// The states for the inputs applied. The residual is the heat flow summed link by link, not `b - G x` with
    /// the sums on the diagonal: rounding of those sums would be a path to ground that is not there.
    fn states(&mut self, refinements: usize) -> Result<Vec<f64>, ReduceError> {
        let Some(factors) = &mut self.factors else { return Ok(Vec::new()) };
        let mut x = vec![0.0; self.system.states().len()];
        let mut step = x.clone();
        let size = |v: &[f64]| v.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        for _ in 0..=refinements {
            self.system.flow(&self.work, &x, &mut step);
            factors.solve_in_place(&mut step)?;
            x.iter_mut().zip(&step).for_each(|(x, dx)| *x += dx);
            if size(&step) <= f64::EPSILON * size(&x) {
                break;
            }
        }
        Ok(x)
    }

    /// Heat that every boundary takes in W at the rises last asked for by [`Conductances::rise`].
    pub(crate) fn boundary_heat(&self) -> Vec<f64> {
        let mut heat = vec![0.0; self.still.len()];
        let mut states = vec![0.0; self.system.states().len()];
        self.system.state_temperatures(self.system.node_temperatures(&self.work), &mut states);
        self.system.boundary_heat(&self.work, &states, &mut heat);
        heat.iter_mut().for_each(|q| *q = -*q);
        heat
    }
}

fn factorized(system: &ThermalSystem) -> Result<Box<dyn Factorization>, FactorError> {
    let mut values = vec![0.0; system.pattern().entries()];
    system.jacobian(&mut values);
    values.iter_mut().for_each(|v| *v = -*v);
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    let mut factors = linear::new(&pattern, true, LinearSolver::Auto)?;
    factors.factorize(&values)?;
    factors.check(&pattern, &values)?;
    Ok(factors)
}
