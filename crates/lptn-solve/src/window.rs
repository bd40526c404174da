//! Windows of time, and their results.

use lptn_network::{History, Network, ReportId};
use lptn_units::{Type, Unit};

use crate::quantity::Shown;
use crate::selection::Selection;

/// A part of a run over which columns are averaged and their extremes found.
#[derive(Clone, Debug)]
pub struct Window {
    /// Its name.
    pub name: String,
    /// Its start in s.
    pub from: f64,
    /// Its end in s; after `from`.
    pub to: f64,
    /// The columns.
    pub of: Selection,
}

/// Results of a column over a window, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnSeen {
    /// The name of the column, `steel.T`.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// The mean over time.
    pub mean: f64,
    /// The least value and its first time in s; at a jump both sides count.
    pub min: (f64, f64),
    /// The largest value and its first time in s.
    pub max: (f64, f64),
    /// The value at the end of the window.
    pub last: f64,
    /// Time in s for which it is above zero.
    pub positive: f64,
    /// Possible relative error of the mean in addition to the error of the run, because it changes
    /// faster than steps resolve.
    pub open: f64,
    pub(crate) shown: Shown,
}

impl WindowSeen {
    /// The statistics of a column of the window.
    pub fn history(&self, column: &ColumnSeen) -> History {
        let ColumnSeen { last, min, max, mean, positive, .. } = *column;
        History { last, min: min.0, max: max.0, mean, positive, length: self.to - self.from }
    }
}

impl ColumnSeen {
    /// The share of a mean that is rounding.
    const ROUNDED: f64 = 1e-6;

    /// True if it changes faster than steps resolve, so that the mean may be off by more than
    /// rounding.
    pub fn is_open(&self) -> bool {
        self.open > Self::ROUNDED
    }

    /// The unit that its values are shown in: `temperature` for points on the scale, that of a
    /// signal which has one, K or degR for a difference of temperatures, else SI; `1` for a number.
    pub fn unit(&self, temperature: &Unit) -> String {
        self.shown.unit(temperature)
    }

    /// A value in that unit.
    pub fn shown(&self, value: f64, temperature: &Unit) -> f64 {
        self.shown.value(value, temperature)
    }
}

/// Results over a window.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowSeen {
    /// Its name.
    pub name: String,
    /// Its start in s.
    pub from: f64,
    /// Its end in s; if the run broke off earlier, that time.
    pub to: f64,
    /// Each of its columns.
    pub columns: Vec<ColumnSeen>,
    /// The numbers over the window of its reports that are functionals.
    pub reports: Vec<ReportSeen>,
}

/// The number of a report over a run, a cycle or a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportSeen {
    /// The report.
    pub report: ReportId,
    /// Its value in SI units; NaN if it has none.
    pub value: f64,
    /// Possible error of the value in SI units, of a life as a share of it, in addition to the
    /// error of temperatures, because its quantity changes faster than steps resolve; 0 if it does
    /// not.
    pub open: f64,
    /// A proven bound on the error of the value in SI units, if it was asked for and found.
    pub bound: Option<f64>,
}

impl ReportSeen {
    /// From the statistics of the quantity of a report over `window`.
    pub(crate) fn of(
        (report, column): (ReportId, &ColumnSeen),
        window: &WindowSeen,
        network: &Network,
    ) -> Self {
        let history = window.history(column);
        let mut scope = network.evaluation();
        let value = network.report_over_time(report, &history, &mut scope).unwrap_or(f64::NAN);
        let over_time = network.reports()[report.index()].over_time.as_ref();
        let open = over_time.filter(|_| column.is_open());
        let open = open.map_or(0.0, |over_time| over_time.functional.error(&history, column.open));
        Self { report, value, open, bound: None }
    }
}
