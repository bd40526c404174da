//! Lines through the rises and time constants of runs over the speed, as in the captions of the
//! seed paper's Figures 7 and 8, and the differences of the columns.
//!
//! Every run has the same weight, so that the scatter between runs makes the errors; the noise of
//! the records is their lower bound.

use lptn_units::statistics;

use super::columns::{ColumnFits, RunFit};
use super::consistency::{Consistency, Significance};
use super::interval::{Estimate, Scatter};
use super::stated::Exponent;

/// Minimum number of runs for a slope.
const FEWEST: usize = 3;

/// The lines of one column.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnLines {
    /// The name of the column.
    pub column: String,
    /// The rise over the speed, by a line through the origin, in K s/rad. `None` for fewer than
    /// three runs or a single speed.
    pub rise: Option<Estimate>,
    /// The exponent of the rise from logarithms, and the significance of its difference from 1, the
    /// exponent of that line; `None` if [`Consistency`] has none.
    pub exponent: Option<(Exponent, Significance)>,
    /// The mean of the time constants in s, with the error of the mean. `None` for a single run.
    pub time_constant: Option<Estimate>,
    /// The slope of the time constant over the speed in s^2/rad, by a line with an intercept.
    /// `None` as for the rise.
    pub time_slope: Option<Estimate>,
}

/// The first column less another one. Both come from the same runs and share the differences
/// between runs, so the differences within each run count.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnDifference {
    /// The column from which the other is subtracted.
    pub of: String,
    /// The other column.
    pub less: String,
    /// Difference of the slopes of the rise, in K s/rad.
    pub rise: Option<Estimate>,
    /// Difference of the means of the time constants, in s.
    pub time_constant: Option<Estimate>,
}

/// One value a run, in the order of the speeds.
struct Values {
    values: Vec<f64>,
    /// Their standard errors by the noise of the records.
    known: Vec<f64>,
}

impl Values {
    fn of(column: &ColumnFits, pick: fn(&RunFit) -> (f64, f64)) -> Self {
        let (values, known) = column.fits.iter().map(pick).unzip();
        Self { values, known }
    }

    fn rises(column: &ColumnFits) -> Self {
        Self::of(column, |fit| (fit.power.rise.value, fit.power.rise.random))
    }

    fn time_constants(column: &ColumnFits) -> Self {
        Self::of(column, |fit| (fit.fit.tau.value, fit.fit.tau.standard_error))
    }

    /// Difference run by run.
    fn less(&self, other: &Self) -> Self {
        let values = self.values.iter().zip(&other.values).map(|(a, b)| a - b).collect();
        let known = self.known.iter().zip(&other.known).map(|(a, b)| a.hypot(*b)).collect();
        Self { values, known }
    }

    /// The coefficient of the first of some functions of the speed, whose sum is fitted.
    fn first(&self, rows: Vec<Vec<f64>>) -> Option<Estimate> {
        let mut slopes = vec![0.0; rows.first()?.len()];
        slopes[0] = 1.0;
        let (scatter, found) = Scatter::linear(rows, &self.values, self.known.clone())?;
        Some(scatter.estimate(found[0], &slopes))
    }

    fn mean(&self) -> Option<Estimate> {
        let several = self.values.len() > 1;
        several.then(|| self.first(vec![vec![1.0]; self.values.len()])).flatten()
    }

    /// Slope of a line through the origin.
    fn proportion(&self, speeds: &[f64]) -> Option<Estimate> {
        sloped(speeds).then(|| self.first(speeds.iter().map(|speed| vec![*speed]).collect()))?
    }

    /// Slope of a line with an intercept, which is taken in the middle of the speeds.
    fn slope(&self, speeds: &[f64]) -> Option<Estimate> {
        let middle = statistics::mean(speeds);
        let rows = || speeds.iter().map(|speed| vec![speed - middle, 1.0]).collect();
        sloped(speeds).then(|| self.first(rows()))?
    }
}

/// True if runs at these speeds may show a slope.
fn sloped(speeds: &[f64]) -> bool {
    let differ = |speed: &f64| (speed - speeds[0]).abs() > 1e-9 * speeds[0];
    speeds.len() >= FEWEST && speeds.iter().any(differ)
}

impl ColumnLines {
    /// Lines of a column at speeds in rad/s; its consistency gives the exponent.
    pub(crate) fn of(column: &ColumnFits, speeds: &[f64], laws: Option<&Consistency>) -> Self {
        let (rises, times) = (Values::rises(column), Values::time_constants(column));
        let exponent = laws.and_then(|laws| Some((laws.rise, laws.claim(laws.rise, 1.0)?)));
        Self {
            column: column.column.clone(),
            rise: rises.proportion(speeds),
            exponent,
            time_constant: times.mean(),
            time_slope: times.slope(speeds),
        }
    }
}

impl ColumnDifference {
    /// Differences of the first column from every other one.
    pub(crate) fn all(columns: &[ColumnFits], speeds: &[f64]) -> Vec<Self> {
        let [first, others @ ..] = columns else { return Vec::new() };
        let (rises, times) = (Values::rises(first), Values::time_constants(first));
        let difference = |other: &ColumnFits| Self {
            of: first.column.clone(),
            less: other.column.clone(),
            rise: rises.less(&Values::rises(other)).proportion(speeds),
            time_constant: times.less(&Values::time_constants(other)).mean(),
        };
        others.iter().map(difference).collect()
    }
}
