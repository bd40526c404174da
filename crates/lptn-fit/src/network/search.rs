//! Searches from several starts.

use lptn_solve::{Gradient, SensitiveError};

use crate::least_squares::{LeastSquaresFit, Settings, Stop, Termination, minimise};
use crate::network::apart::accuracy;
use crate::network::coordinates::Coordinates;
use crate::network::error::NetworkFitError;
use crate::network::model::Model;
use crate::network::task::{FitObserver, FitStage, NetworkFitTask};
use crate::network::unknown::Unknown;

/// Number of rows of a record in the searches, before the best of them goes on with all.
const COARSE_ROWS: usize = 150;

/// Tolerance in K of the runs of the searches, and of the last search.
const TOLERANCES: [f64; 2] = [1e-6, 1e-7];

/// Sums of squares that differ by less than this part belong to one minimum.
pub(crate) const SAME: f64 = 1e-3;

/// Seed of the starts between the bounds.
const SEED: u32 = 6;

/// Results of the searches from several starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Starts {
    /// Number of starts, the own values first.
    pub tried: usize,
    /// Number of them that led to the minimum that was taken.
    pub same: usize,
    /// Number of them that led to another minimum.
    pub other: usize,
    /// Number of them that led to no minimum.
    pub failed: usize,
}

/// End of the searches.
pub(crate) struct Found<'a> {
    pub(crate) estimate: LeastSquaresFit,
    /// The reason if that is not a minimum.
    pub(crate) outcome: Result<(), Stop>,
    pub(crate) starts: Starts,
    pub(crate) gradient: Gradient,
    /// True if no derivative is a difference.
    pub(crate) exact: bool,
    /// Relative accuracy of derivatives.
    pub(crate) accuracy: f64,
    /// The model with all rows.
    pub(crate) model: Model<'a>,
    /// Number of earlier evaluations of the runs of all records.
    pub(crate) searches: usize,
}

/// Finds the best minimum.
pub(crate) fn search<'a>(
    (task, observer): (&'a NetworkFitTask, &'a FitObserver<'a>),
    (unknowns, coordinates): (&'a [Unknown], &'a Coordinates),
    own: &[f64],
) -> Result<Found<'a>, NetworkFitError> {
    let tolerance =
        |least: f64| task.runs.iter().fold(least, |t, run| t.min(run.settings.tolerance()));
    let starts = starts(task, coordinates, own);
    let mut coarse = Model::new(
        (task, observer),
        (unknowns, coordinates),
        (COARSE_ROWS, tolerance(TOLERANCES[0])),
    );
    coarse.stage = FitStage { search: 1, of: starts.len(), evaluations: 0 };
    if let Err((run, error)) = coarse.at(own) {
        if let SensitiveError::Interrupted = error {
            return Err(coarse.broken_off());
        }
        return Err(NetworkFitError::Start {
            record: task.runs[run].name.clone(),
            error: Box::new(error),
        });
    }
    coarse.without_value().map_or(Ok(()), Err)?;
    let gradient = coarse.gradient.unwrap_or(Gradient::Exact);
    let mut ends = Vec::new();
    let roughly = settings(coordinates, (1e-4, 1e-6), coarse.error());
    for (i, start) in starts.iter().enumerate() {
        coarse.stage.search = i + 1;
        let search = minimise(&mut coarse, &coordinates.of(start), &roughly);
        ends.push(search.map_err(|error| coarse.ended(error))?);
    }
    let (best, starts) = best(&ends, coarse.error());
    let mut model = Model::new(
        (task, observer),
        (unknowns, coordinates),
        (usize::MAX, tolerance(TOLERANCES[1])),
    );
    model.best = Some((f64::INFINITY, coordinates.values(&ends[best].parameters).0));
    model.stage = FitStage { search: 0, ..coarse.stage_now() };
    // an expression may have no value in rows that the searches left out
    let begins = coordinates.values(&ends[best].parameters).0;
    if model.at(&begins).is_ok() {
        model.without_value().map_or(Ok(()), Err)?;
    }
    let exact = exactly(coordinates, (gradient, model.error()));
    let estimate = minimise(&mut model, &ends[best].parameters, &exact);
    let estimate = estimate.map_err(|error| model.ended(error))?;
    let exact = gradient == Gradient::Exact && !task.has_inputs_estimated(unknowns);
    let outcome = outcome(&estimate, model.error(), exact);
    let accuracy = accuracy(gradient);
    let searches = coarse.evaluations;
    Ok(Found { estimate, outcome, starts, gradient, exact, accuracy, searches, model })
}

fn settings(coordinates: &Coordinates, (gradient, step): (f64, f64), error: f64) -> Settings {
    let bounds = coordinates.bounds();
    Settings { bounds, gradient, step, error, iterations: 200, ..Settings::default() }
}

/// Settings of the last search, with runs that are off by `error`.
pub(crate) fn exactly(coordinates: &Coordinates, (gradient, error): (Gradient, f64)) -> Settings {
    let ends = match gradient {
        Gradient::Exact => (1e-7, 1e-10),
        Gradient::Differences(_) => (1e-5, 1e-8),
    };
    settings(coordinates, ends, error)
}

/// The own values, then points of a scrambled Sobol sequence between the bounds (A. B. Owen, in
/// Monte Carlo and Quasi-Monte Carlo Methods in Scientific Computing, 1995, 299).
fn starts(task: &NetworkFitTask, coordinates: &Coordinates, own: &[f64]) -> Vec<Vec<f64>> {
    let mut starts = vec![own.to_vec()];
    if (0..own.len()).any(|j| coordinates.is_bounded(j)) {
        let more = u32::try_from(task.more_starts).unwrap_or(u32::MAX);
        starts.extend((0..more).map(|k| {
            let share = |j: usize| {
                f64::from(sobol_burley::sample(k, u32::try_from(j % 256).unwrap_or(0), SEED))
            };
            let shares: Vec<f64> = (0..own.len()).map(share).collect();
            coordinates.between(&shares, own)
        }));
    }
    starts
}

/// The lowest minimum, or the lowest point if no search found one, and counts of the others.
fn best(ends: &[LeastSquaresFit], floor: f64) -> (usize, Starts) {
    let converged = |end: &LeastSquaresFit| end.outcome.converged() || removable(end) <= floor;
    let rank = |i: &usize| (!converged(&ends[*i]), ends[*i].squares);
    let order = |a: &usize, b: &usize| {
        let (a, b) = (rank(a), rank(b));
        let nan_last = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
        a.0.cmp(&b.0).then(nan_last(a.1).total_cmp(&nan_last(b.1)))
    };
    let best = (0..ends.len()).min_by(order).unwrap_or(0);
    let least = ends[best].squares;
    let is_same = |end: &&LeastSquaresFit| end.squares <= least * (1.0 + SAME) + floor * floor;
    let minima = || ends.iter().filter(|end| converged(end));
    let (same, found) = (minima().filter(is_same).count(), minima().count());
    (best, Starts { tried: ends.len(), same, other: found - same, failed: ends.len() - found })
}

/// The root of the sum of squares that could still be removed.
fn removable(end: &LeastSquaresFit) -> f64 {
    end.offset * end.squares.sqrt()
}

/// A search is at its minimum if it gets no further because less is left to remove than the errors
/// of the runs.
pub(crate) fn outcome(end: &LeastSquaresFit, floor: f64, exact: bool) -> Result<(), Stop> {
    /// Differences of runs are no more accurate than this.
    const DIFFERENCES: f64 = 1e-3;
    match end.outcome {
        Termination::Converged(_) => Ok(()),
        Termination::NotConverged(_) if removable(end) <= floor => Ok(()),
        Termination::NotConverged(Stop::Stalled) if !exact && end.offset <= DIFFERENCES => Ok(()),
        Termination::NotConverged(stop) => Err(stop),
    }
}
