//! A row of a sweep.

/// One row: the case, counted from 0, and its numbers as they are shown, axes first.
#[derive(Debug, Default)]
pub(crate) struct Row {
    pub(crate) case: u64,
    pub(crate) numbers: Vec<f64>,
    pub(crate) outside: u64,
    /// Empty unless it failed.
    pub(crate) failed: String,
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
