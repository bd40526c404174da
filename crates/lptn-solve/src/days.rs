//! Means and extremes of days of a run.

use lptn_units::Unit;

use crate::drawn::Day;
use crate::quantity::{Quantity, Shown};
use crate::selection::Selection;
use crate::solution::Solution;

/// A column over a day, or over the part of it that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaySeen {
    /// Its start in s.
    pub from: f64,
    /// Its end in s.
    pub to: f64,
    /// The mean over time.
    pub mean: f64,
    /// The least value; at a jump both sides count.
    pub low: f64,
    /// The largest value.
    pub high: f64,
}

/// The days of a column, in the unit that it is shown in.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnDays {
    /// The name of the column, `steel.T`.
    pub name: String,
    /// Its days in order.
    pub days: Vec<DaySeen>,
}

impl ColumnDays {
    /// The days of each column of a run from the solver's own curve, temperatures in `unit`.
    /// `selection` is that of [`crate::Drawn`]. Empty if no days are known.
    pub fn of(solution: &Solution, selection: &Selection, unit: &Unit) -> Vec<Self> {
        if solution.days.is_empty() {
            return Vec::new();
        }
        let network = solution.network();
        let column = |(i, quantity): (usize, &Quantity)| {
            let shown = Shown::of(*quantity, network);
            let value = |si: f64| shown.value(si, unit);
            let of = |day: &Day| {
                let [mean, low, high] = day.values[i].map(value);
                DaySeen { from: day.from, to: day.to, mean, low, high }
            };
            let days = solution.days.iter().map(of).collect();
            Self { name: quantity.name(network), days }
        };
        selection.quantities().iter().enumerate().map(column).collect()
    }
}
