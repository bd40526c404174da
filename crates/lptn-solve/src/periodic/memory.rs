//! The memory of a network, from its balances at one moment.

use lptn_assembly::ThermalSystem;

use crate::newton::Newton;
use crate::times::just_after;
use crate::unfold::Unfold;

/// Iterations towards the slowest part.
const ITERATIONS: usize = 100;

/// More states than these are not factorised for an estimate.
const MOST_STATES: usize = 20_000;

/// The slowest time constant in s of small disturbances of a state at a time in s, with everything
/// fixed as it is there, by inverse iteration with the capacities. `None` if nothing is forgotten,
/// and for very many states.
pub(super) fn slowest(system: &ThermalSystem, time: f64, carried: &[f64]) -> Option<f64> {
    if system.states().len() > MOST_STATES || !system.network().ungrounded().is_empty() {
        return None;
    }
    let mut work = system.workspace();
    system.read_inputs(&mut work, time, just_after(time)).ok()?;
    let mut unfold = Unfold::new(system).ok()?;
    let temperatures = unfold.temperatures(&mut work, carried).ok()?.to_vec();
    let mut newton = Newton::new(system, (0..temperatures.len()).collect()).ok()?;
    newton.factorize(&mut work, &temperatures, 0.0).ok()?;
    let capacity: Vec<f64> =
        system.mass().iter().zip(unfold.slopes()).map(|(c, slope)| c / slope).collect();
    let mut x = vec![1.0; temperatures.len()];
    let mut slowest = 0.0;
    for _ in 0..ITERATIONS {
        x.iter_mut().zip(&capacity).for_each(|(x, c)| *x *= c);
        newton.factors.solve_in_place(&mut x).ok()?;
        slowest = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        x.iter_mut().for_each(|x| *x /= slowest);
    }
    (slowest.is_finite() && slowest > 0.0).then_some(slowest)
}
