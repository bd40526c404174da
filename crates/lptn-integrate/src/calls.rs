//! Calls of a system, with their failures as errors of the integrator.

use crate::{Callback, FactorError, IntegrateError, OdeSystem, Retry, Statistics, kernels};

/// Writes the flow at a time and state; all of it finite.
pub(crate) fn flow_at(
    system: &mut impl OdeSystem,
    counts: &mut Statistics,
    (time, y): (f64, &[f64]),
    flow: &mut [f64],
) -> Result<(), IntegrateError> {
    counts.flow_evaluations += 1;
    system.flow(time, y, flow).map_err(|retry| refused(Callback::Flow, time, retry))?;
    kernels::first_not_finite(flow).map_or(Ok(()), |index| {
        Err(IntegrateError::NotFinite { callback: Callback::Flow, time, index })
    })
}

/// The error of a callback that could not do its work.
pub(crate) fn refused(callback: Callback, time: f64, retry: Retry) -> IntegrateError {
    match retry {
        Retry::SmallerStep => IntegrateError::Refused { callback, time },
        Retry::Stop => IntegrateError::Stopped { callback, time },
    }
}

/// The error of a factorisation or solve.
pub(crate) fn linear_trouble(time: f64, cause: FactorError) -> IntegrateError {
    match cause {
        FactorError::OutOfMemory => IntegrateError::OutOfMemory { function: "linear solver" },
        cause => IntegrateError::Linear { time, cause },
    }
}
