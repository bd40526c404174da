//! Networks with streams of constant capacity rate: linear, but heat acts downstream only.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::linear::{self, Factorization};
use lptn_integrate::{FactorError, Pattern};
use lptn_network::InputError;

use crate::error::ReduceError;

/// `G` of `C dT/dt = q - G T` with streams, and its transpose unless it is symmetric; factorised.
pub(crate) struct Streams {
    pattern: Pattern,
    values: Vec<f64>,
    factors: Box<dyn Factorization>,
    transposed: Option<(Vec<f64>, Box<dyn Factorization>)>,
    /// True if the streams only join single nodes to boundaries, so that G is symmetric.
    pub(crate) symmetric: bool,
}

/// Steps of refinement of each solution.
const STEPS: usize = 3;

impl Streams {
    pub(crate) fn new(system: &ThermalSystem) -> Result<Self, ReduceError> {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let mut values = vec![0.0; pattern.len()];
        let mut work = system.workspace();
        let still = vec![0.0; system.unknowns().len()];
        system
            .jacobian_at(&mut work, &still, JacobianForm::Exact, &mut values)
            .map_err(ReduceError::Input)?;
        values.iter_mut().for_each(|v| *v = -*v);
        tie_down(system, &pattern, &mut values);
        let factors = factorized(&pattern, &values)?;
        let mirrored = transposed(&pattern, &values);
        let largest = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * largest;
        let symmetric = values.iter().zip(&mirrored).all(same);
        let transposed = if symmetric {
            None
        } else {
            let factors = factorized(&pattern, &mirrored)?;
            Some((mirrored, factors))
        };
        Ok(Self { pattern, values, factors, transposed, symmetric })
    }

    /// `G^-1 b`, one number per unknown; with `adjoint` that of the transpose.
    pub(crate) fn solve(&mut self, b: &[f64], adjoint: bool) -> Result<Vec<f64>, FactorError> {
        let mut x = vec![0.0; b.len()];
        let (values, factors) = match &mut self.transposed {
            Some((values, factors)) if adjoint => (&*values, factors),
            _ => (&self.values, &mut self.factors),
        };
        linear::solve_refined(factors.as_mut(), (&self.pattern, values), b, &mut x, STEPS)?;
        Ok(x)
    }
}

/// Heat that the inputs in `work` bring to each unknown in W while all of them are at zero.
pub(crate) fn inflow(system: &ThermalSystem, work: &mut Workspace) -> Result<Vec<f64>, InputError> {
    let still = vec![0.0; system.unknowns().len()];
    let mut flow = still.clone();
    system.flow(work, &still, &mut flow)?;
    Ok(flow)
}

fn factorized(pattern: &Pattern, values: &[f64]) -> Result<Box<dyn Factorization>, FactorError> {
    let mut factors = linear::for_exact(pattern)?;
    factors.factorize(values)?;
    factors.check(pattern, values)?;
    Ok(factors)
}

/// The values of the transpose in the same pattern, which is symmetric.
fn transposed(pattern: &Pattern, values: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; values.len()];
    for column in 0..pattern.size() {
        for slot in pattern.column(column) {
            if let Some(mirror) = pattern.slot(column, pattern.row_indices()[slot]) {
                out[mirror] = values[slot];
            }
        }
    }
    out
}

/// Islands without a boundary become regular, as in networks without streams; no one sees it.
fn tie_down(system: &ThermalSystem, pattern: &Pattern, values: &mut [f64]) {
    for loose in system.network().ungrounded().into_iter().flatten() {
        if let Some(place) = system.unknowns().iter().position(|id| *id == loose) {
            let slot = pattern.diagonal_slot(place);
            values[slot] = if values[slot] > 0.0 { 2.0 * values[slot] } else { 1.0 };
        }
    }
}
