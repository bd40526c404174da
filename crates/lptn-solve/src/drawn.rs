//! The columns that pictures of a run read on both sides of jumps, and their days.

use crate::selection::Selection;

/// A day in s; days begin at its multiples.
pub(crate) const DAY: f64 = 86_400.0;

/// The columns of a picture, which are read between the rows too. The rows do not depend on it.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The columns.
    pub of: Selection,
    /// The times in s between which it shows them.
    pub span: (f64, f64),
    /// True if means and extremes of days are wanted: see [`crate::ColumnDays::of`].
    pub days: bool,
}

/// Mean, least and largest value of each column over a day, in SI units.
#[derive(Clone, Debug)]
pub(crate) struct Day {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) values: Vec<[f64; 3]>,
}
