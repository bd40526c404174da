//! Time counted from the start of a run, and as the caller counts it.

use crate::{IntegrateError, Step};

/// The time of an integrator begins at 0 with the run: far from 0 a step may be shorter than the
/// distance of two doubles. The caller sees the last double that is not after it, so that one is
/// before the stop as long as the other is.
pub(crate) struct Clock {
    origin: f64,
    /// Present time since the start.
    pub(crate) now: f64,
    /// Start of the last step.
    from: f64,
    pub(crate) stop: f64,
    pub(crate) shown: f64,
    shown_from: f64,
    pub(crate) shown_stop: f64,
}

impl Clock {
    pub(crate) fn new(origin: f64) -> Self {
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

    pub(crate) fn set_stop(&mut self, t: f64) {
        (self.stop, self.shown_stop) = (t - self.origin, t);
    }

    /// The step of no length that is taken at the stop; `None` before it.
    pub(crate) fn step_at_stop(&self) -> Result<Option<Step>, IntegrateError> {
        let Self { now, stop, shown: time, shown_stop, .. } = *self;
        if stop.is_nan() {
            return Err(IntegrateError::InvalidOption { option: "stop", value: stop });
        }
        if stop > now {
            return Ok(None);
        }
        if shown_stop < time {
            return Err(IntegrateError::StopBehind { time, stop: shown_stop });
        }
        Ok(Some(Step { from: time, to: shown_stop, at_stop: true, roots: false }))
    }

    /// The caller's time of one since the start.
    pub(crate) fn shown_of(&self, time: f64) -> f64 {
        if time >= self.stop {
            return self.shown_stop;
        }
        let near = self.origin + time;
        let not_after = if near - self.origin > time { near.next_down() } else { near };
        not_after.min(self.shown_stop.next_down())
    }

    /// A step to a time since the start; the caller's times of its ends.
    pub(crate) fn step_to(&mut self, time: f64) -> (f64, f64) {
        (self.from, self.shown_from) = (self.now, self.shown);
        self.shown = self.shown_of(time).max(self.shown);
        self.now = time;
        (self.shown_from, self.shown)
    }

    /// A time of the caller inside the last step, ends included, since the start.
    pub(crate) fn within(&self, t: f64) -> Result<f64, IntegrateError> {
        let (from, to) = (self.shown_from, self.shown);
        match (from..=to).contains(&t) {
            true => Ok((t - self.origin).clamp(self.from, self.now)),
            false => Err(IntegrateError::OutsideLastStep { time: t, from, to }),
        }
    }

    /// Restarts at a time inside the last step.
    pub(crate) fn begin_at(&mut self, time: f64, shown: f64) {
        (self.now, self.shown) = (time, shown);
        self.begin();
    }

    /// Restarts here: nothing but the present time is inside the last step.
    pub(crate) fn begin(&mut self) {
        (self.from, self.shown_from) = (self.now, self.shown);
    }
}
