//! The first step after a start, whose length is a guess.
//!
//! CVODES makes that guess from the flow some way ahead. If the flow cannot be evaluated there, it
//! gives up after four tries and leaves the last state tried in the output. That is not the present
//! state, and a shorter step may still succeed.
//!
//! The start is restored and shorter first steps are tried.

use sundials_sys as sys;

use super::Cvodes;
use crate::memory::{Flag, Reached};
use lptn_integrate::OdeSystem;

/// Largest number of shorter first steps that are tried.
const ATTEMPTS: usize = 6;

/// Length of such a step, as a part of the time up to the failed evaluation.
const PART: f64 = 0.1;

/// CVODES' flags for a flow that cannot be evaluated.
const REFUSED: [i32; 3] =
    [sys::CV_REPTD_RHSFUNC_ERR, sys::CV_REPTD_QRHSFUNC_ERR, sys::CV_REPTD_SRHSFUNC_ERR];

impl<S: OdeSystem> Cvodes<S> {
    /// One step of CVODES. After a failure the state is that of the last good one.
    pub(super) fn take_step(&mut self, towards: f64) -> Result<Reached, Flag> {
        if self.memory.counters().steps > 0 {
            return self.memory.step(towards, &mut self.state, &mut self.time);
        }
        let start = self.state.as_slice().to_vec();
        let mut reached = self.memory.step(towards, &mut self.state, &mut self.time);
        for _ in 0..ATTEMPTS {
            let Err(flag) = &reached else { break };
            self.state.as_mut_slice().copy_from_slice(&start);
            let Some(length) = self.shorter().filter(|_| REFUSED.contains(&flag.value)) else {
                break;
            };
            self.begin_anew()?;
            self.memory.set_initial_step(length)?;
            reached = self.memory.step(towards, &mut self.state, &mut self.time);
            self.memory.set_initial_step(self.first_step)?;
        }
        if reached.is_err() {
            self.state.as_mut_slice().copy_from_slice(&start);
        }
        reached
    }

    /// Length of a step that ends well before the time at which a callback failed last.
    fn shorter(&self) -> Option<f64> {
        let failed = self.shared.get().failure.as_ref()?.time;
        let length = PART * (failed - self.origin - self.time);
        (length > f64::EPSILON * self.time.abs()).then_some(length)
    }
}
