//! The time of CVODES, which begins at 0, and that of the caller; and how long a step may be.
//!
//! Far from 0 a step may be shorter than the distance of two doubles. The caller gets the last
//! double that is not later, so that comparisons with rows and stops stay exact.

use super::Cvodes;
use crate::memory::Counters;
use lptn_integrate::{IntegrateError, OdeSystem};

/// A step that is longer than the longest by this factor is so by rounding.
const ROOM: f64 = 1.0 + 1e-9;

/// Times as the caller counts them: the last double that is not after CVODES' time. So one is
/// before the stop as long as the other is.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub(super) time: f64,
    pub(super) from: f64,
    pub(super) stop: f64,
}

impl<S: OdeSystem> Cvodes<S> {
    /// CVODES' time of a time inside the last step, ends included.
    pub(super) fn within(&self, t: f64) -> Result<f64, IntegrateError> {
        let Shown { from, time: to, .. } = self.shown;
        match (from..=to).contains(&t) {
            true => Ok((t - self.origin).clamp(self.from, self.time)),
            false => Err(IntegrateError::OutsideLastStep { time: t, from, to }),
        }
    }

    /// The time as the caller counts it.
    pub(super) fn show(&mut self) {
        let Shown { time, stop, .. } = self.shown;
        if self.time >= self.stop {
            self.shown.time = stop;
            return;
        }
        let near = self.origin + self.time;
        let not_after = if near - self.origin > self.time { near.next_down() } else { near };
        self.shown.time = not_after.min(stop.next_down()).max(time);
    }

    /// The stop time, or an earlier one if CVODES would take a step that is too long: it chose the
    /// size at the end of the step before, with the limit of that moment. After a root it first
    /// takes the rest of a step.
    pub(super) fn held_stop(&self) -> f64 {
        let Counters { steps, current_step, .. } = self.memory.counters();
        let too_long = steps > 0 && current_step > self.longest * ROOM && !self.roots.met();
        if too_long { self.stop.min(self.time + self.longest) } else { self.stop }
    }
}
