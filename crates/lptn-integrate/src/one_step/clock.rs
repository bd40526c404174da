//! Time counted from the start of a run, and as the caller counts it.

use crate::IntegrateError;

/// The time of an integrator begins at 0 where the run does: far from 0 a step may be shorter than
/// the distance of two doubles. The caller sees the last double that is not after it, so that one is
/// before the stop as long as the other is.
pub(super) struct Clock {
    origin: f64,
    /// Since the start.
    pub(super) now: f64,
    /// Where the last step began.
    from: f64,
    pub(super) stop: f64,
    pub(super) shown: f64,
    shown_from: f64,
    pub(super) shown_stop: f64,
}

impl Clock {
    pub(super) fn new(origin: f64) -> Self {
        Self {
            origin,
            now: 0.0,
            from: 0.0,
            stop: f64::INFINITY,
            shown: origin,
            shown_from: origin,
            shown_stop: f64::INFINITY,
        }
    }

    pub(super) fn set_stop(&mut self, t: f64) {
        (self.stop, self.shown_stop) = (t - self.origin, t);
    }

    /// The caller's time of one since the start.
    pub(super) fn shown_of(&self, time: f64) -> f64 {
        if time >= self.stop {
            return self.shown_stop;
        }
        let near = self.origin + time;
        let not_after = if near - self.origin > time { near.next_down() } else { near };
        not_after.min(self.shown_stop.next_down())
    }

    /// A step to a time since the start; the caller's times of its ends.
    pub(super) fn step_to(&mut self, time: f64) -> (f64, f64) {
        (self.from, self.shown_from) = (self.now, self.shown);
        self.shown = self.shown_of(time).max(self.shown);
        self.now = time;
        (self.shown_from, self.shown)
    }

    /// A time of the caller inside the last step, ends included, since the start.
    pub(super) fn within(&self, t: f64) -> Result<f64, IntegrateError> {
        let (from, to) = (self.shown_from, self.shown);
        match (from..=to).contains(&t) {
            true => Ok((t - self.origin).clamp(self.from, self.now)),
            false => Err(IntegrateError::OutsideLastStep { time: t, from, to }),
        }
    }

    /// Begins anew at a time inside the last step.
    pub(super) fn begin_at(&mut self, time: f64, shown: f64) {
        (self.now, self.shown) = (time, shown);
        self.begin();
    }

    /// Begins anew here: nothing but the present time is inside the last step.
    pub(super) fn begin(&mut self) {
        (self.from, self.shown_from) = (self.now, self.shown);
    }
}
