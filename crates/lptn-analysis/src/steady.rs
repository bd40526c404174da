//! Steady states.

use lptn_assembly::ThermalSystem;
use lptn_solve::{SteadyError, SteadyState};

use crate::trust::Trust;
use crate::trusted::Trusted;

/// The steady state with the inputs as they are at `time` in s; see [`SteadyState::solve`].
///
/// # Errors
/// [`SteadyError`], also if a range of validity has no value.
pub fn steady(system: &ThermalSystem, time: f64) -> Result<Trusted<SteadyState>, SteadyError> {
    answered(system, SteadyState::solve(system, time)?)
}

/// The steady state that a run with this tolerance in K comes to; see
/// [`SteadyState::solve_within`].
///
/// # Errors
/// As [`steady`].
pub fn steady_within(
    system: &ThermalSystem,
    time: f64,
    tolerance: f64,
) -> Result<Trusted<SteadyState>, SteadyError> {
    answered(system, SteadyState::solve_within(system, time, tolerance)?)
}

fn answered(
    system: &ThermalSystem,
    result: SteadyState,
) -> Result<Trusted<SteadyState>, SteadyError> {
    let trust = Trust::of_steady(system.network(), &result)?;
    Ok(Trusted { result, trust })
}
