//! Expressions of results that are not part of a network, over the rows of a run.
//!
//! They may bend and jump at times that the run ignores. Each row is read on one side of them.

use std::borrow::Cow;

use lptn_network::{Value, same_time};

use crate::solution::Solution;

impl Solution {
    /// An expression of results over the rows in SI units, compiled for this network; NaN if it has
    /// no value, and unless every node was recorded.
    pub fn result(&self, value: &Value) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.times.len());
        let Some(insides) = self.insides_of(value) else {
            return vec![f64::NAN; self.times.len()];
        };
        let own = |row: usize, column: usize| self.row(row)[column];
        let rows = (0..self.times.len(), &insides[..]);
        self.replay_as((&self.system, &own), rows, |at| values.push(at.result(value)));
        values
    }

    /// For each row a time in s inside its stretch of an expression of results: between breakpoints
    /// of the run and of the expression, after the row or, before a jump, before it. `None` if the
    /// expression has too many breakpoints.
    pub(crate) fn insides_of(&self, value: &Value) -> Option<Cow<'_, [f64]>> {
        let (Some(&first), Some(&last)) = (self.times.first(), self.times.last()) else {
            return Some(Cow::Borrowed(&self.segments));
        };
        let ends = self.network().value_breakpoints(value, (first, last)).ok()?;
        if ends.is_empty() {
            return Some(Cow::Borrowed(&self.segments));
        }
        let same = same_time(first, last);
        let rows = self.times.iter().zip(&self.segments);
        let inside = |(&time, &inside): (&f64, &f64)| {
            let end = match inside < time {
                true => ends[..ends.partition_point(|end| *end < time - same)].last(),
                false => ends.get(ends.partition_point(|end| *end <= time + same)),
            };
            let cut = end.filter(|end| (inside - **end) * (time - **end) <= 0.0);
            cut.map_or(inside, |end| 0.5 * (time + end))
        };
        Some(rows.map(inside).collect())
    }
}
