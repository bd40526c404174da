//! Columns on both sides of the times at which something jumps, bends or switches.
//!
//! Rows are at the times that a user requests. A straight line between two rows draws a jump as a
//! ramp, and a temperature that rises before its heat comes. Pictures therefore read their columns
//! at these known times too. The rows do not depend on it.

use super::{Recorder, StateAt};
use crate::readings::pieces;
use crate::selection::Selection;
use crate::stop_reason::StopReason;

/// More sides than this are too many for a picture: none is kept.
const MOST_SIDES: usize = 4000;

/// Columns at the known times between the rows.
#[derive(Clone, Debug)]
pub(crate) struct Jumps {
    of: Selection,
    /// Time in s and values in SI units, ascending. The time before a jump is the next smaller one.
    sides: Vec<(f64, Vec<f64>)>,
    too_many: bool,
}

impl Jumps {
    pub(crate) fn new(of: Selection) -> Self {
        Self { of, sides: Vec::new(), too_many: false }
    }

    /// Every side; `None` if there are too many.
    pub(crate) fn into_sides(self) -> Option<Vec<(f64, Vec<f64>)>> {
        (!self.too_many).then_some(self.sides)
    }

    fn keep(&mut self, time: f64, values: Vec<f64>) {
        self.too_many |= self.sides.len() >= MOST_SIDES;
        if self.too_many {
            self.sides.clear();
        } else {
            self.sides.push((time, values));
        }
    }
}

impl Recorder<'_> {
    /// Keeps the columns after a jump, at the state of the workspace.
    pub(super) fn keep_after(&mut self, time: f64) -> Result<(), StopReason> {
        let has_row = self.rows.binary_search_by(|row| row.total_cmp(&time)).is_ok();
        if has_row { Ok(()) } else { self.keep(time, self.inside) }
    }

    /// Keeps the columns on both sides of the jumps in a step, and before one at its end.
    pub(super) fn keep_between(
        &mut self,
        (from, to): (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        if self.jumps.is_none() {
            return Ok(());
        }
        for ((time, _), begins) in pieces(self.readings.inner(), (from, to)) {
            // the start of the segment has its sides
            if begins && time > self.segment.from {
                self.keep_before(time, state_at)?;
                self.inside = self.readings.inside(time);
                self.place_at(time, state_at)?;
                self.keep_after(time)?;
            }
        }
        if to >= self.segment.to.min(self.edge) && to < self.span().1 {
            self.keep_before(to, state_at)?;
        }
        Ok(())
    }

    fn keep_before(&mut self, time: f64, state_at: &mut StateAt<'_>) -> Result<(), StopReason> {
        self.inside = self.readings.inside_before(time);
        self.place_at(time, state_at)?;
        self.keep(time.next_down(), self.inside)
    }

    fn keep(&mut self, time: f64, inside: f64) -> Result<(), StopReason> {
        let Some(jumps) = self.jumps.as_mut().filter(|jumps| !jumps.too_many) else {
            return Ok(());
        };
        self.reading.place(&mut self.work, (time, inside)).map_err(StopReason::Input)?;
        let mut values = Vec::with_capacity(jumps.of.quantities().len());
        for &quantity in jumps.of.quantities() {
            let value = self.reading.value(&mut self.work, quantity);
            values.push(value.map_err(StopReason::Input)?);
        }
        jumps.keep(time, values);
        Ok(())
    }
}
