//! Columns on both sides of the times at which something jumps, bends or switches.
//!
//! Rows are at the times that a user requests. A straight line between two rows draws a jump as a
//! ramp, and a temperature that rises before its heat comes. Pictures therefore read their columns
//! at these known times too. The rows do not depend on it.

use super::days::MOST_NUMBERS;
use super::{Recorder, StateAt};
use crate::drawn::Drawn;
use crate::readings::pieces;
use crate::stop_reason::StopReason;

/// Intervals of a picture of a part of a run: its rows may be far apart.
const SAMPLES: u32 = 600;

/// Columns at the known times between the rows.
#[derive(Clone, Debug)]
pub(crate) struct Jumps {
    drawn: Drawn,
    /// Times in s, ascending, at which a picture of a part of the run reads its columns too.
    samples: Vec<f64>,
    /// Time in s and values in SI units, by step. The time before a jump is the next smaller one.
    sides: Vec<(f64, Vec<f64>)>,
    too_many: bool,
}

impl Jumps {
    /// For a run over this span in s.
    pub(crate) fn new(drawn: Drawn, run: (f64, f64)) -> Self {
        let (from, to) = (drawn.span.0.max(run.0), drawn.span.1.min(run.1));
        let is_part = from < to && (from > run.0 || to < run.1);
        let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(SAMPLES);
        let samples = if is_part { (0..=SAMPLES).map(at).collect() } else { Vec::new() };
        Self { drawn, samples, sides: Vec::new(), too_many: false }
    }

    /// The samples in a step, but for its end.
    fn samples(&self, (from, to): (f64, f64)) -> Vec<f64> {
        let place = |time: f64| self.samples.partition_point(|sample| *sample < time);
        self.samples[place(from)..place(to)].to_vec()
    }

    /// Every side that is drawn; `None` if they need too much memory.
    pub(crate) fn into_sides(self) -> Option<Vec<(f64, Vec<f64>)>> {
        (!self.too_many).then_some(self.sides)
    }

    /// True if a side at this time is kept.
    fn shows(&self, time: f64) -> bool {
        !self.too_many && time >= self.drawn.span.0 && time <= self.drawn.span.1
    }

    fn keep(&mut self, time: f64, values: Vec<f64>) {
        self.too_many |= (self.sides.len() + 1) * (values.len() + 1) > MOST_NUMBERS;
        if self.too_many {
            self.sides = Vec::new();
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

    /// Keeps the columns on both sides of the jumps in a step and before one at its end, and its
    /// samples.
    pub(super) fn keep_between(
        &mut self,
        (from, to): (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        let Some(jumps) = &self.jumps else { return Ok(()) };
        for time in jumps.samples((from, to)) {
            self.inside = self.readings.inside(time);
            self.place_at(time, state_at)?;
            self.keep_after(time)?;
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
        let Some(jumps) = self.jumps.as_mut().filter(|jumps| jumps.shows(time)) else {
            return Ok(());
        };
        self.reading.place(&mut self.work, (time, inside)).map_err(StopReason::Input)?;
        let mut values = Vec::with_capacity(jumps.drawn.of.quantities().len());
        for &quantity in jumps.drawn.of.quantities() {
            let value = self.reading.value(&mut self.work, quantity);
            values.push(value.map_err(StopReason::Input)?);
        }
        jumps.keep(time, values);
        Ok(())
    }
}
