//! What is looked at between the rows: watched nodes, limits and windows.

use lptn_network::LimitId;

use super::{Recorder, StateAt};
use crate::error::StopReason;
use crate::readings::pieces;
use crate::watch::{REFINEMENTS, SAMPLES};

/// Halvings of the interval in which a limit is first broken: to the rounding of its length.
const BISECTIONS: usize = 53;

impl Recorder<'_> {
    /// Whether something is to be looked at between the rows.
    fn looks(&self) -> bool {
        !(self.seen.is_empty() && self.limits.is_empty() && self.ranges.is_empty())
    }

    /// Looks at watched nodes and limits and into the windows between two times, anew where results
    /// may jump.
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
                self.track(piece, state_at)?;
            }
        }
        self.inside = self.readings.inside_before(step.1);
        Ok(())
    }

    /// Takes a step into the windows that it reaches.
    fn track(&mut self, step: (f64, f64), state_at: &mut StateAt<'_>) -> Result<(), StopReason> {
        let mut windows = std::mem::take(&mut self.windows);
        let outcome = windows.iter_mut().try_for_each(|window| {
            window.step(step, &mut |time, of, values| {
                self.place_at(time, state_at)?;
                let at = (time, self.inside);
                self.reading.place(&mut self.work, at).map_err(StopReason::Input)?;
                for &quantity in of.quantities() {
                    let value = self.reading.value(&mut self.work, quantity);
                    values.push(value.map_err(StopReason::Input)?);
                }
                Ok(())
            })
        });
        self.windows = windows;
        outcome
    }

    fn look(
        &mut self,
        (from, to): (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        let ends = self.seen.is_empty() && self.limits.is_empty() && self.ranges.is_slow();
        let count = if ends { 1 } else { SAMPLES + 1 };
        for (points, seen) in self.points.iter_mut().zip(&self.seen) {
            points.clear();
            points.push(seen.last_point());
        }
        for k in 1..=count {
            let time =
                if k == count { to } else { from + (to - from) * f64::from(k) / f64::from(count) };
            self.place_at(time, state_at)?;
            let nodes = self.system.node_temperatures(&self.work);
            for (list, seen) in self.points.iter_mut().zip(&self.seen) {
                list.push((time, nodes[seen.watch.node.index()]));
            }
            let at = (time, self.inside);
            self.limits.sample(&mut self.work, at).map_err(StopReason::Input)?;
            let looked = match k == count {
                true => self.ranges.sample(&mut self.work, time),
                false => self.ranges.sample_inside(&mut self.work, time),
            };
            looked.map_err(StopReason::Input)?;
        }
        for i in 0..self.seen.len() {
            self.seen[i].look(&self.points[i]);
            self.refine(i, state_at)?;
        }
        self.limits.ids().try_for_each(|id| self.look_at_limit(id, state_at))
    }

    /// Evaluates the watched node where a parabola has its top, until the peak stands still.
    fn refine(&mut self, i: usize, state_at: &mut StateAt<'_>) -> Result<(), StopReason> {
        for _ in 0..REFINEMENTS {
            let Some(time) = self.seen[i].promising(&self.points[i]) else { break };
            self.place_at(time, state_at)?;
            let nodes = self.system.node_temperatures(&self.work);
            let point = (time, nodes[self.seen[i].watch.node.index()]);
            self.seen[i].peak_at(point);
            let place = self.points[i].partition_point(|p| p.0 < time);
            self.points[i].insert(place, point);
        }
        Ok(())
    }

    /// Looks where a limit is nearest to being broken, and finds when it first was.
    fn look_at_limit(&mut self, id: LimitId, state_at: &mut StateAt<'_>) -> Result<(), StopReason> {
        for time in self.limits.valleys(id) {
            let margin = self.margin_at(id, time, state_at)?;
            self.limits.insert(id, (time, margin));
        }
        let mut broken_at = None;
        if let Some((mut kept, mut broken)) = self.limits.break_between(id) {
            for _ in 0..BISECTIONS {
                let middle = kept + 0.5 * (broken - kept);
                match self.margin_at(id, middle, state_at)? < 0.0 {
                    true => broken = middle,
                    false => kept = middle,
                }
            }
            broken_at = Some(broken);
        }
        self.limits.take_in(id, broken_at);
        Ok(())
    }

    fn margin_at(
        &mut self,
        id: LimitId,
        time: f64,
        state_at: &mut StateAt<'_>,
    ) -> Result<f64, StopReason> {
        self.place_at(time, state_at)?;
        let at = (time, self.inside);
        self.limits.margin(id, &mut self.work, at).map_err(StopReason::Input)
    }
}
