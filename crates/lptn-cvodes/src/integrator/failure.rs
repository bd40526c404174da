//! Errors for the steps that CVODES gave up.

use sundials_sys as sys;

use super::Cvodes;
use crate::context::Context;
use crate::memory::{Flag, name_of};
use lptn_integrate::{IntegrateError, Integrator, OdeSystem, kernels};

impl<S: OdeSystem> Cvodes<S> {
    /// The error for a step that CVODES gave up.
    pub(super) fn explain(&mut self, flag: Flag) -> IntegrateError {
        let time = self.shown.time;
        let failure = self.shared.get_mut().failure.take();
        match (flag.value, failure) {
            (sys::CV_ERR_FAILURE, _) => IntegrateError::ErrorTest {
                time,
                step: self.memory.counters().current_step,
                index: self.worst(),
            },
            (sys::CV_TOO_MUCH_ACC, _) => {
                let index = kernels::worst(self.state(), &vec![1.0; self.state().len()]);
                IntegrateError::ToleranceTooSmall { time, index }
            }
            (_, Some(failure)) => failure.into_error(),
            (sys::CV_CONV_FAILURE, None) => IntegrateError::Newton {
                time,
                step: self.memory.counters().current_step,
                index: self.worst(),
            },
            (_, None) => self.unexpected(flag),
        }
    }

    /// The component with the largest estimated error in the last step tried.
    pub(super) fn worst(&mut self) -> usize {
        let known = self.memory.local_errors(&mut self.scratch).is_ok();
        let errors = self.scratch.as_slice();
        if known { kernels::worst(errors, &vec![1.0; errors.len()]) } else { 0 }
    }

    pub(super) fn unexpected(&self, flag: Flag) -> IntegrateError {
        unexpected(flag, self.shown.time, &self.context)
    }
}

pub(super) fn unexpected(flag: Flag, time: f64, context: &Context) -> IntegrateError {
    let Flag { function, value } = flag;
    if value == sys::CV_MEM_FAIL {
        return IntegrateError::OutOfMemory { function };
    }
    let (name, message) = (name_of(value), context.last_message());
    IntegrateError::Sundials { function, flag: value, name, message, time }
}
