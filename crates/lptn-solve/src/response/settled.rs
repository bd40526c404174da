//! Rises that stay, for many heats at once.

use lptn_integrate::linear::{self, LinearSolver};

use super::{Effect, ResponseError};
use crate::linearised::Linearised;

/// Steps of iterative refinement.
const REFINEMENTS: usize = 3;

/// Rises of all nodes in K that stay of these heats into all nodes in W, one list a heat, from one
/// factorisation. Heat into nodes that no path joins to a boundary is left out: it never settles,
/// and no other node feels it.
///
/// # Errors
/// [`ResponseError`]
pub fn settled_rises(
    linear: &Linearised<'_>,
    heats: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, ResponseError> {
    let system = linear.system();
    let (pattern, mut values) = linear.conductances();
    let loose: Vec<usize> =
        system.network().ungrounded().into_iter().flatten().map(|id| id.index()).collect();
    for (row, id) in system.unknowns().iter().enumerate() {
        if loose.contains(&id.index()) {
            let slot = pattern.diagonal_slot(row);
            values[slot] = if values[slot] > 0.0 { 2.0 * values[slot] } else { 1.0 };
        }
    }
    let mut factors = linear::new(pattern, false, LinearSolver::Auto)?;
    factors.factorize(&values)?;
    let mut rises = Vec::with_capacity(heats.len());
    for heat in heats {
        let mut heat = heat.clone();
        loose.iter().for_each(|&node| heat[node] = 0.0);
        let effect = Effect::of_heat(system, heat);
        let mut x = vec![0.0; effect.flow.len()];
        let of = (pattern, &values[..]);
        linear::solve_refined(&mut *factors, of, &effect.flow, &mut x, REFINEMENTS)?;
        rises.push(effect.recovered(system, &x, 1.0));
    }
    Ok(rises)
}
