//! The trust in an answer.

use lptn_network::{InputError, LimitId, Network, Passing, ReportId};
use lptn_solve::{Beyond, Others, OutOfRange, Snapshot, Solution, SteadyState, Unbounded};

/// Limits on the trust in numbers that a reader has to know. None of them is an error: an energy
/// balance that does not close is one, and its numbers are never returned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trust {
    /// A temperature that nothing real has.
    pub beyond: Option<Beyond>,
    /// Stretches in which laws were outside the ranges in which they are known.
    pub out_of_range: Vec<OutOfRange>,
    /// Why the tolerance does not bound the error; `None` if it does, and for steady states, which
    /// are refined to rounding.
    pub unbounded: Option<Unbounded>,
    /// Results that change faster than steps are evaluated.
    pub unresolved: Vec<Unresolved>,
    /// Knowledge of other steady states with the same inputs; [`Others::None`] over time.
    pub others: Others,
    /// The factor by which a cycle multiplies a disturbance of a periodic steady state, if it is
    /// above 1: the state is unstable.
    pub grows: Option<f64>,
    /// The nodes into which flows of a flow network bring another stream than they take away, at
    /// the end of a run or in steady state.
    pub unbalanced: Vec<Passing>,
}

/// A result that changes faster than steps are evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum Unresolved {
    /// The margin of a limit.
    Margin {
        /// The limit.
        limit: LimitId,
        /// Its possible error in SI units.
        by: f64,
    },
    /// A report over the run.
    Report {
        /// The report.
        report: ReportId,
        /// Its possible error in SI units, of a life as a share of it.
        by: f64,
    },
    /// The mean of a column over a window.
    Mean {
        /// The name of the column.
        column: String,
        /// The name of the window.
        window: String,
        /// Its possible error as a share of it.
        share: f64,
    },
}

impl Unresolved {
    fn all_of(solution: &Solution) -> Vec<Self> {
        let limits = solution.limits().iter().filter(|seen| seen.open > 0.0);
        let limits = limits.map(|seen| Self::Margin { limit: seen.limit, by: seen.open });
        let reports = solution.reports_over_time().iter().filter(|seen| seen.open > 0.0);
        let reports = reports.map(|seen| Self::Report { report: seen.report, by: seen.open });
        let means = solution.windows().iter().flat_map(|window| {
            let open = window.columns.iter().filter(|column| column.is_open());
            open.map(|column| Self::Mean {
                column: column.name.clone(),
                window: window.name.clone(),
                share: column.open,
            })
        });
        limits.chain(reports).chain(means).collect()
    }
}

impl Trust {
    pub(crate) fn of_run(solution: &Solution) -> Self {
        Self {
            beyond: Beyond::of_run(solution),
            out_of_range: solution.out_of_range().to_vec(),
            unbounded: solution.why_unbounded(),
            unresolved: Unresolved::all_of(solution),
            others: Others::None,
            grows: None,
            unbalanced: flows_of_run(solution),
        }
    }

    pub(crate) fn of_steady(network: &Network, steady: &SteadyState) -> Result<Self, InputError> {
        Ok(Self {
            beyond: Beyond::of_steady(network, steady),
            out_of_range: OutOfRange::of_steady(network, steady)?,
            unbounded: None,
            unresolved: Vec::new(),
            others: steady.others.clone(),
            grows: None,
            unbalanced: flows(network, &steady.state)?,
        })
    }
}

/// [`Network::unbalanced_flows`] of a steady state, or at the end of a run.
fn flows(network: &Network, at: &Snapshot) -> Result<Vec<Passing>, InputError> {
    let temperatures = [&at.temperatures[..], &at.boundary_temperatures].concat();
    network.unbalanced_flows(&mut at.evaluation(network), &temperatures)
}

/// [`flows`] at the last row; none if a value fails there, or not every node was recorded.
fn flows_of_run(solution: &Solution) -> Vec<Passing> {
    let network = solution.network();
    let last = solution.times().len().checked_sub(1).filter(|_| network.has_flows());
    let found = last.and_then(|row| flows(network, &solution.snapshot(row)?).ok());
    found.unwrap_or_default()
}
