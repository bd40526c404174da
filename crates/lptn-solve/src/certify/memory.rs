//! The shape of bounds that shrink at every node.

use lptn_assembly::ThermalSystem;
use lptn_integrate::Pattern;

use super::shifted::Shifted;
use crate::times::just_after;

/// Times in s, one for each unknown, with `-A v = C` for the matrix `A` of `bound.rs` at this time
/// in s and state in K: bounds `v exp(-t/max v)` are not exceeded, as `A v/max v >= -C v/max v`.
/// `None` if there are none, as without a path to a boundary.
pub(crate) fn shrinking(system: &ThermalSystem, time: f64, state: &[f64]) -> Option<Vec<f64>> {
    let network = system.network();
    let mut scope = network.evaluation();
    let [over, _] = network.input_bounds(&mut scope, (time, time), just_after(time));
    let points: Vec<[f64; 2]> = state.iter().map(|t| [*t, *t]).collect();
    let slopes = system.enclose_slopes(&mut over.still(), &points).ok()?;
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    let mut factors = Shifted::new(&pattern, &vec![0.0; state.len()]).ok()?;
    factors.set(&slopes.worst(system));
    factors.factorize(1.0)?;
    let mut times = system.mass().to_vec();
    factors.solve(&mut times)?;
    times.iter().all(|time| *time > 0.0 && time.is_finite()).then_some(times)
}
