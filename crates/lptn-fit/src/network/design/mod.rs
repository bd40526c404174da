//! Choice of a measurement that determines parameters of a network to a given error.
//!
//! The information of a record about its unknowns follows from the derivatives of its temperatures
//! alone. Fisher's information is the sum of `x x^T` over its rows, `x` being the derivatives of a
//! row over the standard deviation of its value. It adds up over rows, sensors and runs, so each
//! run is computed once, and every set of sensors and every length is a sum. The predicted error is
//! that of the fit of [`crate::network`], which takes values as independent: `A^-1 M A^-1` with
//! that sum `A` and the same sum `M` under the correlation of the noise (see [`crate::noise`]).
//! Values of a drifting sensor are weighted by the drift that many of them retain
//! ([`DesignPlace::weight`]).
//!
//! Sensors are chosen from every set ([`MOST_PLACES`] places at most; beyond, by exchange), runs
//! one after the other: each time the one whose largest error, over its target, is least. The
//! problem is that of V. V. Fedorov, Theory of Optimal Experiments, 1972; A. C. Atkinson, A. N.
//! Donev, R. D. Tobias, Optimum Experimental Designs, with SAS, 2007.
//!
//! A plan predicts the fit that will be made, not the best possible one. Each run is computed once,
//! at some 50 lengths; only the length in the answer is found row by row. The offset of a single
//! record is eliminated before runs are added. With a drift, a fit has to weigh a value by the
//! information that many values retain. Otherwise it trusts the record more than a `±`. The plan
//! uses that weight and prints it. Existing records inform everything that their fit varies.
//! Unknowns that the plan does not name are included, because omitting them would mean knowing
//! them.

mod choice;
mod error;
mod given;
mod information;
mod limit;
mod records;
mod sensitive;
mod sets;
mod space;
mod taken;
mod task;

pub use choice::MOST_LEGS;
pub use error::DesignError;
pub use given::GivenFit;
pub use sensitive::DesignObserver;
pub use sets::{MOST_PLACES, Searched};
pub use task::{DesignPlace, DesignRun, DesignTask, Known};

use crate::network::apart::{accuracy, told_apart};
use crate::network::coordinates::Coordinates;
use crate::network::design::choice::{Choice, choose};
pub(crate) use crate::network::design::information::Information;
use crate::network::design::limit::limits;
use crate::network::design::sets::{BestSet, best_sets};
use crate::network::design::space::{Leg, Space};
use crate::network::identify::Identifiability;
use crate::network::model::Model;
use crate::network::unknown::Unknown;

/// Number of rows of a run in the search for unknowns that no record determines.
const FEW_ROWS: usize = 150;

/// The best measurement, and its errors. Errors are standard errors, one for each of
/// [`DesignTask::unknowns`] in its SI unit, infinite if nothing determines it.
#[derive(Clone, Debug)]
pub struct Design {
    /// Errors before the measurement: by `±`, and by existing records.
    pub before: Vec<f64>,
    /// The best set for each number of places, the smallest first.
    pub sets: Vec<DesignSet>,
    /// Search for these sets.
    pub searched: Searched,
    /// The best measurement; none if the budget has room for no run, or if a target is never
    /// determined.
    pub plan: Option<DesignPlan>,
    /// Each run as the next one, with sensors at the places of the plan; the best first.
    pub next: Vec<NextRun>,
    /// Errors of the plan over the measured time, in s; its last run goes on to its end.
    pub curve: Vec<(f64, Vec<f64>)>,
    /// Unknowns that sensors at every place and all runs together do not determine.
    pub never: Option<Never>,
    /// True if derivatives are exact, and not differences of runs.
    pub exact: bool,
}

/// The best set with a number of places.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignSet {
    /// The places.
    pub places: Vec<usize>,
    /// The most informative run with them, and the number of its samples that the budget allows.
    pub run: Option<(usize, usize)>,
    /// Errors after it.
    pub errors: Vec<f64>,
    /// Number of samples that reaches all targets; about, an evaluated length.
    pub enough: Option<usize>,
}

/// The best measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPlan {
    /// Places of the sensors.
    pub places: Vec<usize>,
    /// The runs, with their samples.
    pub runs: Vec<(usize, usize)>,
    /// Errors after them.
    pub errors: Vec<f64>,
    /// True if all targets are reached.
    pub reached: bool,
    /// Cost of sensors and runs.
    pub cost: f64,
    /// For each unknown the one whose `±` causes most of its variance, and that part of it.
    pub causes: Vec<Option<(usize, f64)>>,
    /// Limit of each error if the runs last longer and longer; 0 if it keeps falling. None if such
    /// runs fail.
    pub limits: Option<Vec<f64>>,
}

/// A run as the next one.
#[derive(Clone, Debug, PartialEq)]
pub struct NextRun {
    /// The run, and its samples.
    pub run: (usize, usize),
    /// Errors after it.
    pub errors: Vec<f64>,
    /// Number of samples that reaches all targets; about, an evaluated length.
    pub enough: Option<usize>,
    /// Its cost, without sensors.
    pub cost: f64,
}

/// Unknowns that no record of the runs determines, however long.
#[derive(Clone, Debug)]
pub struct Never {
    /// All estimated unknowns; the offsets of single records are among them.
    pub unknowns: Vec<Unknown>,
    /// Their values.
    pub values: Vec<f64>,
    /// Their identifiability.
    pub told: Identifiability,
}

/// Plans a measurement.
///
/// # Errors
/// [`DesignError`] if a run fails or is interrupted. If nothing reaches the targets, that is an
/// answer.
pub fn design(task: &DesignTask, observer: &DesignObserver<'_>) -> Result<Design, DesignError> {
    let space = Space::new(task, observer)?;
    let (best, sets, searched) = best_sets(&space);
    let never = never(&space, observer)?;
    let choice = match is_lost(task, never.as_ref()) {
        true => None,
        false => choose(&space, (&best, &sets)),
    };
    let places = choice.as_ref().map_or_else(
        || best.last().map_or_else(Vec::new, |set| set.places.clone()),
        |choice| choice.places.clone(),
    );
    let mut design = Design {
        before: space.before.errors(),
        sets: best.iter().map(|set| of_set(&space, set)).collect(),
        searched,
        plan: None,
        next: next(&space, &places),
        curve: Vec::new(),
        never,
        exact: space.runs.iter().all(|run| run.exact),
    };
    if let Some(choice) = choice {
        design.curve = curve(&space, &choice);
        design.plan = Some(plan(&space, &choice, observer)?);
    }
    Ok(design)
}

/// True if a target is never determined.
fn is_lost(task: &DesignTask, never: Option<&Never>) -> bool {
    never.is_some_and(|never| {
        let lost = |known: &Known| !never.determines(&task.unknowns[known.unknown]);
        task.known.iter().any(lost)
    })
}

impl Never {
    /// True if an estimated unknown is determined.
    pub fn determines(&self, unknown: &Unknown) -> bool {
        let place = self.unknowns.iter().position(|own| own.of == unknown.of);
        place.is_some_and(|place| self.told.determines(place))
    }
}

fn of_set(space: &Space<'_>, set: &BestSet) -> DesignSet {
    let mut told = space.base(&set.places);
    let enough = set.leg.and_then(|leg| enough(space, &set.places, (&told, leg)));
    set.leg.iter().for_each(|leg| told.add(&space.tells(&set.places, *leg)));
    DesignSet {
        places: set.places.clone(),
        run: set.leg.map(|leg| (leg.run, space.samples(leg))),
        errors: told.errors(),
        enough,
    }
}

/// Number of samples of a run that reaches all targets; 1 if they are reached already.
fn enough(space: &Space<'_>, places: &[usize], (base, leg): (&Information, Leg)) -> Option<usize> {
    match space.score(base).is_reached() {
        true => Some(1),
        false => space.shortest(places, (base, leg)).map(|leg| space.samples(leg)),
    }
}

fn next(space: &Space<'_>, places: &[usize]) -> Vec<NextRun> {
    let base = space.base(places);
    let one = |run: usize| {
        let leg = space.whole(run);
        let mut told = base.clone();
        told.add(&space.tells(places, leg));
        let enough = enough(space, places, (&base, leg));
        let (run, cost) = ((run, space.samples(leg)), space.cost_of(leg));
        NextRun { run, errors: told.errors(), enough, cost }
    };
    let mut all: Vec<NextRun> = (0..space.runs.len()).map(one).collect();
    let score = |next: &NextRun| space.score_of(&next.errors);
    all.sort_by(|a, b| score(a).partial_cmp(&score(b)).unwrap_or(std::cmp::Ordering::Equal));
    all
}

/// Information before the last run of a design, and that run.
fn before_last(space: &Space<'_>, choice: &Choice) -> (Information, Option<Leg>) {
    let mut base = space.base(&choice.places);
    let [all @ .., last] = choice.legs.as_slice() else { return (base, None) };
    all.iter().for_each(|leg| base.add(&space.tells(&choice.places, *leg)));
    (base, Some(*last))
}

fn plan(
    space: &Space<'_>,
    choice: &Choice,
    observer: &DesignObserver<'_>,
) -> Result<DesignPlan, DesignError> {
    let places = &choice.places;
    let (mut told, last) = before_last(space, choice);
    let whole = |leg: &Leg| (leg.run, space.samples(*leg));
    let mut runs: Vec<(usize, usize)> = choice.legs.iter().map(whole).collect();
    if let Some(leg) = last {
        let mut samples = space.samples(leg);
        if choice.score.is_reached() {
            samples = space.fewest(places, (&told, leg), observer)?;
        }
        let own = space.exactly(places, (leg.run, samples), observer)?;
        told.add(&space.settled(leg.run, own));
        runs.pop();
        runs.push((leg.run, samples));
    }
    let of_runs: f64 = runs.iter().map(|&(run, samples)| space.cost_of_run(run, samples)).sum();
    let errors = told.errors();
    let limits = limits(space, (places, &runs), (&space.base(places), &errors, observer));
    let limits = match limits {
        Err(DesignError::Interrupted) => return Err(DesignError::Interrupted),
        limits => limits.ok(),
    };
    Ok(DesignPlan {
        errors,
        reached: space.score(&told).is_reached(),
        cost: space.cost_of_places(places) + of_runs,
        causes: causes(space, &told),
        places: places.clone(),
        limits,
        runs,
    })
}

/// For each unknown the one whose `±` causes most of its variance.
fn causes(space: &Space<'_>, told: &Information) -> Vec<Option<(usize, f64)>> {
    let (covariance, known) = (told.covariance(), space.task.of_priors());
    let unknowns = space.task.unknowns.iter().enumerate();
    let priors: Vec<usize> =
        unknowns.filter(|(_, unknown)| unknown.prior.is_some()).map(|(i, _)| i).collect();
    let most = |i: usize| {
        if !covariance.error(i).is_finite() {
            return None;
        }
        let shares = priors.iter().map(|&prior| (prior, covariance.share(i, (prior, &known))));
        shares.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    (0..told.count).map(most).collect()
}

/// Errors over the measured time, run after run, the last one to its end.
fn curve(space: &Space<'_>, choice: &Choice) -> Vec<(f64, Vec<f64>)> {
    let (mut base, mut begun) = (space.base(&choice.places), 0.0);
    let mut points = Vec::new();
    for (i, leg) in choice.legs.iter().enumerate() {
        let is_last = i + 1 == choice.legs.len();
        let end = if is_last { space.whole(leg.run) } else { *leg };
        for length in 0..=end.length {
            let leg = Leg { length, ..*leg };
            let mut told = base.clone();
            told.add(&space.tells(&choice.places, leg));
            points.push((begun + space.task.lasts(space.samples(leg)), told.errors()));
        }
        base.add(&space.tells(&choice.places, *leg));
        begun += space.task.lasts(space.samples(*leg));
    }
    points
}

/// Unknowns that sensors everywhere and every run together do not determine.
fn never(space: &Space<'_>, observer: &DesignObserver<'_>) -> Result<Option<Never>, DesignError> {
    let (task, mut all) = (space.task, space.before.clone());
    let places: Vec<usize> = (0..task.places.len()).collect();
    (0..space.runs.len()).for_each(|run| all.add(&space.tells(&places, space.whole(run))));
    if all.errors().iter().all(|error| error.is_finite()) {
        return Ok(None);
    }
    let unknowns = task.fit.unknowns();
    let shared = |own: &Unknown| task.unknowns.iter().position(|unknown| unknown.of == own.of);
    let value = |own: &Unknown| shared(own).map_or(own.own, |place| task.values[place]);
    let values: Vec<f64> = unknowns.iter().map(value).collect();
    let coordinates = Coordinates::new(&unknowns);
    let observed = |_, step| observer(0, step);
    let mut model = Model::new((&task.fit, &observed), (&unknowns, &coordinates), (FEW_ROWS, 1e-7));
    let Ok(at) = model.at(&values).cloned() else { return Ok(None) };
    let Some(gradient) = model.gradient else { return Ok(None) };
    let told = told_apart((&task.fit, &unknowns), (&at, accuracy(gradient)), &mut model);
    if model.interrupted {
        return Err(DesignError::Interrupted);
    }
    Ok(told.map(|told| Never { unknowns, values, told }))
}
