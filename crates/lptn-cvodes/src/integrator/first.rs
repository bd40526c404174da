//! The first step after a start, whose length is a guess.
//!
//! CVODES makes that guess from the flow some way ahead. Where this cannot be had there, it gives
//! up after four looks, with the last state that it looked at in the output: that must not be taken
//! for the present one, and nothing says that a shorter step would fail as well.
//!
//! The start is restored and shorter first steps are tried.

use sundials_sys as sys;

use super::Cvodes;
use crate::memory::{Flag, Reached};
use lptn_integrate::OdeSystem;

/// How often a shorter first step is tried.
const ATTEMPTS: usize = 6;

/// Its length, as a part of the way to where the flow could not be had.
const PART: f64 = 0.1;

/// CVODES' flags for a flow that cannot be had.
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

    /// A step that stays well in front of where a callback failed last.
    fn shorter(&self) -> Option<f64> {
        let failed = self.shared.get().failure.as_ref()?.time;
        let length = PART * (failed - self.origin - self.time);
        (length > f64::EPSILON * self.time.abs()).then_some(length)
    }
}
