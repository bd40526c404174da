//! Evaluations between the rows: watched nodes, limits and windows.

use super::{Recorder, StateAt};
use crate::interval::{Interval, POINTS, time_of};
use crate::readings::pieces;
use crate::stop_reason::StopReason;
use crate::tracked::Tracked;

/// Nodes that are placed to find the tops of watched ones in a step. If there are more of both, the
/// interpolation through the points of the step is used.
const MOST_PLACED: usize = 4096;

impl Recorder<'_> {
    /// True if something has to be evaluated between the rows.
    fn looks(&self) -> bool {
        !(self.lookout.is_empty() && self.limits.is_empty() && self.ranges.is_empty())
    }

    /// Evaluates watched nodes, limits and windows between two times, with a restart wherever
    /// results may jump.
    pub(super) fn look_between(
        &mut self,
        step: (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        if self.looks() {
            for (piece, begins) in pieces(&self.readings.limits, step) {
                self.inside = self.readings.inside(piece.0);
                if begins {
                    self.place_at(piece.0, state_at)?;
                    let at = (piece.0, self.inside);
                    self.limits.enter(&mut self.work, at).map_err(StopReason::Input)?;
                    self.ranges.enter(&mut self.work, piece.0).map_err(StopReason::Input)?;
                }
                self.look(piece, state_at)?;
            }
        }
        if !self.windows.is_empty() {
            for (piece, _) in pieces(&self.readings.windows, step) {
                self.inside = self.readings.inside(piece.0);
                let mut windows = std::mem::take(&mut self.windows);
                let outcome = windows.iter_mut().try_for_each(|w| self.track(w, piece, state_at));
                self.windows = windows;
                outcome?;
            }
        }
        self.count_days(step, state_at)?;
        self.inside = self.readings.inside_before(step.1);
        Ok(())
    }

    /// Takes a step into a window, if it reaches it.
    pub(super) fn track(
        &mut self,
        window: &mut Tracked,
        step: (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        window.stand(&mut self.reading.scope);
        window.step(step, &mut |time, (of, bends), values| {
            self.place_at(time, state_at)?;
            let at = (time, self.inside);
            self.reading.place(&mut self.work, at).map_err(StopReason::Input)?;
            for &quantity in of.quantities() {
                let value = self.reading.value(&mut self.work, quantity);
                values.push(value.map_err(StopReason::Input)?);
            }
            bends.read(&mut self.reading.scope, values);
            Ok(())
        })
    }

    fn look(&mut self, step: (f64, f64), state_at: &mut StateAt<'_>) -> Result<(), StopReason> {
        if self.lookout.is_empty() && self.limits.is_empty() && self.ranges.is_slow() {
            self.place_at(step.1, state_at)?;
            return self.ranges.sample(&mut self.work, step.1).map_err(StopReason::Input);
        }
        let mut values: [Vec<f64>; POINTS] = Default::default();
        values[0] = self.limits.last();
        for (point, values) in values.iter_mut().enumerate().skip(1) {
            *values = self.look_at(step, point, state_at)?;
        }
        self.look_at_watched(step, state_at)?;
        self.look_at_limits(Interval { from: step.0, to: step.1, values }, state_at)
    }

    /// Evaluates one point of a step, and before it, for laws that may leave their range in
    /// between, the middle of a wide gap; returns the values of the limits.
    fn look_at(
        &mut self,
        step: (f64, f64),
        point: usize,
        state_at: &mut StateAt<'_>,
    ) -> Result<Vec<f64>, StopReason> {
        let time = time_of(step, point);
        let last = point + 1 == POINTS;
        if point > 1 && !last && !self.ranges.is_slow() {
            let middle = time_of(step, point - 1).midpoint(time);
            self.place_at(middle, state_at)?;
            self.ranges.sample_inside(&mut self.work, middle).map_err(StopReason::Input)?;
        }
        self.place_at(time, state_at)?;
        self.lookout.take(point, self.system.node_temperatures(&self.work));
        let looked = match last {
            true => self.ranges.sample(&mut self.work, time),
            false => self.ranges.sample_inside(&mut self.work, time),
        };
        looked.map_err(StopReason::Input)?;
        self.limits.values(&mut self.work, (time, self.inside)).map_err(StopReason::Input)
    }

    /// Takes in the points of the watched nodes, and the tops between them.
    fn look_at_watched(
        &mut self,
        step: (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        let tops = self.lookout.tops(step);
        let nodes = self.system.network().nodes().len();
        for (i, (temperature, time)) in tops.iter().copied() {
            let exact = match tops.len() * nodes <= MOST_PLACED {
                true => {
                    self.place_at(time, state_at)?;
                    let node = self.lookout.node(i).index();
                    self.system.node_temperatures(&self.work)[node]
                }
                false => temperature,
            };
            self.lookout.peak_at(i, (time, exact));
        }
        Ok(())
    }

    /// Evaluates the limits over a step whose points are known.
    fn look_at_limits(
        &mut self,
        step: Interval,
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        if self.limits.is_empty() {
            return Ok(());
        }
        let end = (step.to, step.values[POINTS - 1].clone());
        let mut look = self.limits.take_look();
        let outcome = look.step(step, &mut |time| {
            self.place_at(time, state_at)?;
            let at = (time, self.inside);
            self.limits.values(&mut self.work, at).map_err(StopReason::Input)
        });
        self.limits.looked(look, end);
        outcome
    }
}
