//! A row of a sweep.

/// One row: the case, counted from 0, and its numbers as they are shown, axes first.
#[derive(Debug, Default)]
pub struct Row {
    /// The case, counted from 0.
    pub case: u64,
    /// Axes, then reports, in the units that are shown; NaN for unknown values.
    pub numbers: Vec<f64>,
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
        self.failed.clone_from(&other.failed);
    }
}
