//! A row of a sweep.

use lptn_study::standing::{KEPT, NONE, WARNING};

/// One row: the case, counted from 0, and its numbers as they are shown, axes first.
#[derive(Debug, Default)]
pub struct Row {
    /// The case, counted from 0.
    pub case: u64,
    /// Axes, then reports, then the least margins of limits, in the units that are shown; NaN for
    /// unknown values.
    pub numbers: Vec<f64>,
    /// The limits in a word of [`standing`](mod@lptn_study::standing); empty without limits and if
    /// it failed.
    pub limits: String,
    /// The name of the worst limit; empty if none was judged.
    pub worst: String,
    /// Laws outside the ranges in which they are known.
    pub outside: u64,
    /// The code of the error that it failed with, else empty.
    pub failed: String,
}

impl Clone for Row {
    fn clone(&self) -> Self {
        let mut new = Self::default();
        new.clone_from(self);
        new
    }

    /// Into the room that is there.
    fn clone_from(&mut self, other: &Self) {
        (self.case, self.outside) = (other.case, other.outside);
        self.numbers.clone_from(&other.numbers);
        self.limits.clone_from(&other.limits);
        self.worst.clone_from(&other.worst);
        self.failed.clone_from(&other.failed);
    }
}

impl Row {
    /// True if it keeps all limits of severity `"error"`, or there are none.
    pub fn keeps(&self) -> bool {
        [NONE, KEPT, WARNING, ""].contains(&self.limits.as_str())
    }
}

/// The columns of a row that not every sweep has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RowShape {
    /// The number of all columns.
    pub columns: usize,
    /// True if limits are judged.
    pub judged: bool,
    /// True if a column counts laws outside their ranges.
    pub ranged: bool,
}
