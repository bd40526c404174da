//! The factorised conductances of a system: temperatures at which its inputs balance.
//!
//! This is the one factorised G, for steady states and equivalents. Islands without a boundary get
//! twice their diagonal, which no other block reads. A port elsewhere can then be analysed.

use std::fmt;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::linear::{self, Factorization, LinearSolver};
use lptn_integrate::{FactorError, Pattern};

/// `G` of `C dT/dt = q - G T`, factorised once for many inputs. Steady states and Norton
/// equivalents come from it.
pub struct Conductances<'a> {
    system: &'a ThermalSystem,
    /// `None` for a system without states.
    factors: Option<Box<dyn Factorization>>,
}

impl fmt::Debug for Conductances<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Conductances")
            .field("states", &self.system.states().len())
            .finish_non_exhaustive()
    }
}

impl<'a> Conductances<'a> {
    /// Most steps of iterative refinement that are of use; two are usual.
    pub const REFINEMENTS: usize = 6;

    /// Factorises the conductances of a system.
    ///
    /// Heat does not determine the temperature of nodes without a path to a boundary. They are kept
    /// apart, and the only valid question is if they keep their temperatures.
    ///
    /// # Errors
    /// [`FactorError`] if the conductances span more than doubles can represent.
    pub fn new(system: &'a ThermalSystem) -> Result<Self, FactorError> {
        let factors = if system.states().is_empty() { None } else { Some(factorized(system)?) };
        Ok(Self { system, factors })
    }

    /// Temperature of each state in K, in the order of [`ThermalSystem::states`], at which the
    /// inputs in `work` balance. The search starts from `start` in K everywhere, so that a network
    /// at rest there stays so to the last digit.
    ///
    /// There are at most `refinements` refinements. The residual is taken from the links, where a
    /// heat flow leaves one node as the number that enters the other. The diagonal of the matrix
    /// has lost a small conductance next to a large one by rounding (a missing path to ground). So
    /// the total balance is exact, and the refinement restores what was rounded.
    ///
    /// # Errors
    /// [`FactorError`] if the solution is not finite.
    pub fn states(
        &mut self,
        work: &Workspace,
        start: f64,
        refinements: usize,
    ) -> Result<Vec<f64>, FactorError> {
        let Some(factors) = &mut self.factors else { return Ok(Vec::new()) };
        let mut states = vec![start; self.system.states().len()];
        let (mut flow, mut step) = (vec![0.0; states.len()], vec![0.0; states.len()]);
        for refinement in 0..=refinements {
            self.system.linear_flow(work, &states, &mut flow);
            if refinement == 0 {
                step.copy_from_slice(&flow);
                factors.solve_in_place(&mut step)?;
            } else {
                // an iteration need not resolve what is below the last digits
                step.fill(0.0);
                factors.solve_from(&flow, &mut step, f64::EPSILON * size(&states))?;
            }
            states.iter_mut().zip(&step).for_each(|(t, dt)| *t += dt);
            if size(&step) <= f64::EPSILON * size(&states) {
                break;
            }
        }
        Ok(states)
    }
}

fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

fn factorized(system: &ThermalSystem) -> Result<Box<dyn Factorization>, FactorError> {
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    let mut values = vec![0.0; pattern.len()];
    system.jacobian(&mut values);
    values.iter_mut().for_each(|v| *v = -*v);
    tie_down(system, &pattern, &mut values);
    let mut factors = linear::for_steady(&pattern, LinearSolver::Auto)?;
    factors.factorize(&values)?;
    factors.check(&pattern, &values)?;
    Ok(factors)
}

/// Makes the blocks of islands without a boundary regular, by twice their diagonal: no other block
/// sees it, and without heat the solution is zero all the same.
fn tie_down(system: &ThermalSystem, pattern: &Pattern, values: &mut [f64]) {
    for loose in system.network().ungrounded().into_iter().flatten() {
        if let Ok(state) = system.states().binary_search(&loose) {
            let slot = pattern.diagonal_slot(state);
            values[slot] = if values[slot] > 0.0 { 2.0 * values[slot] } else { 1.0 };
        }
    }
}
