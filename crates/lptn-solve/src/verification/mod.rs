//! Comparison of a run with an independent solution.

mod disturbed;
mod error;
mod near;

pub use error::NearError;
pub use near::{Disturbance, DisturbanceShape, NearState};

use lptn_assembly::ThermalSystem;
use lptn_network::Network;

use crate::error::TransientError;
use crate::exact::{Difference, ExactError, ExactSolution};
use crate::selection::RecordedNodes;
use crate::settings::{Proceed, Progress, Transient};
use crate::solution::{RunStatus, Solution};
use crate::table::Table;

/// Comparison of runs of a network with its exact solution.
#[derive(Clone, Debug)]
pub struct Verification {
    /// The reference of the comparison.
    pub reference: Reference,
    /// One comparison a run, the coarsest tolerance first.
    pub comparisons: Vec<RunComparison>,
}

/// A reference for runs.
#[derive(Clone, Debug)]
pub enum Reference {
    /// The solution by modes, and by the exponential of a matrix if streams flow.
    Exact {
        /// Number of nodes with capacity.
        states: usize,
        /// See [`ExactSolution::carried`].
        carried: usize,
        /// See [`ExactSolution::quadrature_error`].
        quadrature_error: Option<f64>,
        /// See [`ExactSolution::own_error`].
        own_error: f64,
    },
    /// There is no independent solution: a run at a hundredth of the tolerance.
    FinerRun {
        /// Its tolerance in K.
        tolerance: f64,
        /// The reason.
        reason: NoReference,
    },
}

/// Reason why a network has no independent solution.
#[derive(Clone, Debug)]
pub enum NoReference {
    /// It cannot be solved exactly.
    Unsolved(ExactError),
    /// Its exact solution is not better than the run to be verified: its rates span too much.
    TooStiff {
        /// The error of the exact solution in K.
        own_error: f64,
    },
}

/// One run and its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct RunComparison {
    /// Tolerance of the run in K.
    pub tolerance: f64,
    /// Its largest difference.
    pub difference: Difference,
    /// The largest error that is allowed, in K: [`allowed_error`].
    pub allowed: f64,
    /// Possible error of the reference itself, in K.
    pub reference_error: f64,
}

/// No run is requested for less than this, in K: temperatures near 300 K have a last digit of 6e-14
/// K, and the integrator needs room above it.
pub const LEAST_TOLERANCE: f64 = 1e-10;

/// Part of the allowed error that a reference may have itself and still judge a run.
const MOST_OWN_ERROR: f64 = 0.1;

/// Largest allowed error of a run, in K: ten times its tolerance down to 1e-5 K, fifty times below
/// that.
pub fn allowed_error(tolerance: f64) -> f64 {
    let coarse = tolerance >= 1e-5 * (1.0 - 1e-9);
    tolerance * if coarse { 10.0 } else { 50.0 }
}

impl RunComparison {
    /// True if the run may be as accurate as required.
    pub fn passes(&self) -> bool {
        self.difference.largest <= self.allowed + self.reference_error
    }
}

impl Verification {
    /// Runs `system` as `settings` say, at their tolerance and at a hundredth of it, and compares
    /// every node at every row with the exact solution; if there is none, the two runs with each
    /// other.
    ///
    /// # Errors
    /// The error of a run.
    pub fn of(system: &ThermalSystem, settings: &Transient) -> Result<Self, TransientError> {
        let runs = runs(system, settings, &mut |_, _| Proceed::Continue)?;
        Ok(Self::of_runs(system, settings, &runs))
    }

    /// The same; `observer` is called after every step of a run with its tolerance in K and may
    /// interrupt it. Then there is nothing to judge, and the result is `None`.
    ///
    /// # Errors
    /// The error of a run.
    pub fn observed(
        system: &ThermalSystem,
        settings: &Transient,
        observer: &mut dyn FnMut(f64, Progress) -> Proceed,
    ) -> Result<Option<Self>, TransientError> {
        let runs = runs(system, settings, observer)?;
        let whole = runs.iter().all(|run| run.end() == RunStatus::Reached);
        Ok(whole.then(|| Self::of_runs(system, settings, &runs)))
    }

    fn of_runs(system: &ThermalSystem, settings: &Transient, runs: &[Solution]) -> Self {
        let runs: Vec<&Solution> = runs.iter().collect();
        match exact(system.network(), runs[0], settings.start) {
            Ok(exact) => Self::against_exact(&exact, &runs),
            Err(reason) => Self::against_each_other(reason, &runs),
        }
    }

    /// Compares runs with an exact solution at the same times; runs of other times or nodes are
    /// left out.
    pub fn against_exact(exact: &ExactSolution, runs: &[&Solution]) -> Self {
        let own = exact.own_error();
        let compare = |run: &&Solution| Some(RunComparison::new(run, exact.difference(run)?, own));
        Self {
            reference: Reference::Exact {
                states: exact.states(),
                carried: exact.carried(),
                quadrature_error: exact.quadrature_error(),
                own_error: exact.own_error(),
            },
            comparisons: runs.iter().filter_map(compare).collect(),
        }
    }

    fn against_each_other(reason: NoReference, runs: &[&Solution]) -> Self {
        let (&coarse, &fine) = (&runs[0], &runs[runs.len() - 1]);
        let difference =
            (runs.len() > 1).then(|| Difference::largest(coarse, |row| fine.row(row))).flatten();
        Self {
            reference: Reference::FinerRun { tolerance: fine.tolerance(), reason },
            comparisons: difference
                .map(|d| RunComparison::new(coarse, d, 0.0))
                .into_iter()
                .collect(),
        }
    }

    /// True if every difference is allowed, and there is one to judge.
    pub fn passes(&self) -> bool {
        !self.comparisons.is_empty() && self.comparisons.iter().all(RunComparison::passes)
    }

    /// One row per run: `tolerance`, `difference` (the largest), `allowed`, `time` (of the largest
    /// difference), and `NAME.difference` of every node.
    pub fn table(&self, network: &Network) -> Table {
        let mut table = Table::of(&self.comparisons);
        table.column("tolerance", "K", |c| c.tolerance);
        table.column("difference", "K", |c| c.difference.largest);
        table.column("allowed", "K", |c| c.allowed);
        table.column("time", "s", |c| c.difference.time);
        for (i, node) in network.nodes().iter().enumerate() {
            table.column(format!("{}.difference", node.name), "K", |c| c.difference.by_node[i]);
        }
        table.done()
    }
}

impl RunComparison {
    fn new(run: &Solution, difference: Difference, reference_error: f64) -> Self {
        let tolerance = run.tolerance();
        Self { tolerance, difference, allowed: allowed_error(tolerance), reference_error }
    }
}

/// A run at the tolerance of `settings` and one at a hundredth of it, if there is room for it; the
/// last one may be interrupted.
fn runs(
    system: &ThermalSystem,
    settings: &Transient,
    observer: &mut dyn FnMut(f64, Progress) -> Proceed,
) -> Result<Vec<Solution>, TransientError> {
    let mut run = |tolerance: f64| {
        let settings = Transient {
            tolerance,
            record: RecordedNodes::All,
            watch: Vec::new(),
            drawn: None,
            ..settings.clone()
        };
        settings.solve_observed(system, &mut |progress| observer(tolerance, progress))
    };
    let fine = (0.01 * settings.tolerance).max(LEAST_TOLERANCE);
    let mut runs = vec![run(settings.tolerance)?];
    if fine < settings.tolerance && runs[0].end() == RunStatus::Reached {
        runs.push(run(fine)?);
    }
    Ok(runs)
}

/// The exact solution at the rows of a run, unless it cannot judge that run.
fn exact(network: &Network, run: &Solution, start: f64) -> Result<ExactSolution, NoReference> {
    let exact = ExactSolution::solve(network, start, run.times()).map_err(NoReference::Unsolved)?;
    let own_error = exact.own_error();
    if own_error <= MOST_OWN_ERROR * allowed_error(run.tolerance()) {
        Ok(exact)
    } else {
        Err(NoReference::TooStiff { own_error })
    }
}
