//! Parameters of a network from records of its temperatures, heat flows and expressions of them.
//!
//! Residuals are model less record, over the standard deviation of a value if one is given, at
//! every row of every record. A prior of a parameter (`±`) counts as one more residual. Runs are
//! distributed to threads, and nothing depends on their number. Searches begin at the own values
//! and at points between the bounds, on at most 150 rows of each record; the best goes on with all
//! rows.
//!
//! Standard errors follow from the residuals as they are, not from the given standard deviations,
//! and include that neighbours in a record are alike: see [`crate::noise`]. If records differ by
//! more than that, errors follow from their scatter ([`BetweenRecords`]). Only if few values are
//! left over, errors are at least those from the standard deviations. [`Identifiability`] lists the
//! parameters that the records cannot separate.

mod apart;
mod between;
mod combination;
mod coordinates;
pub mod design;
mod error;
mod errors;
mod fitted;
mod held;
mod hint;
mod holding;
mod identify;
mod lag;
mod model;
mod open;
pub(crate) mod plan;
mod posterior;
mod predict;
mod prior;
mod profile;
mod readings;
mod recorded;
mod search;
mod shared;
mod taken;
mod task;
mod undetermined;
mod unknown;

pub use between::BetweenRecords;
pub use combination::CombinationKind;
pub use error::NetworkFitError;
pub use fitted::{ColumnMisfit, FittedParameter, NetworkFit};
pub(crate) use held::unknown_input;
pub use hint::{FAR, Hint};
pub use identify::Identifiability;
pub(crate) use lag::{follow, refined};
pub use lptn_netlist::{Certainty, SensorValue};
pub use lptn_network::Varied;
pub(crate) use predict::{Misses, misses, refit};
pub(crate) use prior::Priors;
pub use profile::Profile;
pub(crate) use recorded::{Held, line};
pub use recorded::{RecordedSignal, RecordedStart};
pub use search::Starts;
pub use shared::SharedNoise;
pub use taken::{Moved, Off};
pub use task::{
    FitObserver, FitStage, Instrument, Measurand, MeasuredColumn, MeasuredRun, NetworkFitTask,
};
pub use undetermined::{Combination, Unseparated};
pub use unknown::{Unknown, UnknownOf};

use lptn_solve::Proceed;

use crate::Covariance;
use crate::least_squares::LeastSquaresFit;
use crate::network::apart::told_apart;
use crate::network::coordinates::Coordinates;
use crate::network::errors::Errors;
use crate::network::model::{Evaluated, Model};
use crate::network::open::settled;
use crate::network::profile::{End, Rise, misleads, profile};
use crate::network::search::{Found, search};

/// Fits the parameters of a task.
///
/// # Errors
/// [`NetworkFitError`] for a task with nothing to fit, or if the own values have no run. If the
/// search does not converge, that is an answer: [`NetworkFit::not_converged`].
pub fn fit_network(task: &NetworkFitTask) -> Result<NetworkFit, NetworkFitError> {
    fit_network_observed(task, &|_, _| Proceed::Continue)
}

/// The same; `observer` is called after every step of every run and may interrupt the fit.
///
/// # Errors
/// The same as for [`fit_network`]; [`NetworkFitError::Interrupted`] with the best values up to now.
pub fn fit_network_observed(
    task: &NetworkFitTask,
    observer: &FitObserver<'_>,
) -> Result<NetworkFit, NetworkFitError> {
    let unknowns = task.unknowns();
    check(task, &unknowns)?;
    let own: Vec<f64> = unknowns.iter().map(|unknown| unknown.own).collect();
    let coordinates = Coordinates::new(&unknowns);
    let found = search((task, observer), (&unknowns, &coordinates), &own)?;
    let found = settled(found, (task, &unknowns, &coordinates), &own)?;
    let Found { estimate, outcome, starts, gradient, mut model, searches, accuracy, .. } = found;
    let (values, _) = coordinates.values(&estimate.parameters);
    let Ok(at_end) = model.at(&values).cloned() else {
        return Err(NetworkFitError::NoData); // the search ends where there are runs
    };
    let identifiability = told_apart((task, &unknowns), (&at_end, accuracy), &mut model);
    if model.interrupted {
        return Err(model.broken_off());
    }
    let errors = Errors::new(task, &model, (&at_end, &estimate.free(), identifiability.as_ref()));
    let covariance = errors.covariance();
    let (columns, shared_noise) = (errors.columns(), errors.shared_noise());
    let known = identifiability.as_ref();
    let mut parameters =
        fitted_parameters((&errors, covariance.as_ref(), known), (&values, &own, &estimate));
    let left_over = errors.left_over();
    let rises = match outcome {
        Ok(()) => one_sided(
            (task, &model, &at_end),
            (&unknowns, &parameters),
            (&errors, &estimate.free(), known),
        ),
        // values that are not a result have no interval
        Err(_) => Vec::new(),
    };
    let end = End {
        coordinates: &coordinates,
        unknowns: &unknowns,
        parameters: &estimate.parameters,
        values: &values,
        squares: estimate.squares,
    };
    for (i, rise) in rises {
        parameters[i].profile = Some(profile(&mut model, &end, (i, rise)));
    }
    if model.interrupted {
        return Err(model.broken_off());
    }
    Ok(NetworkFit {
        not_converged: outcome.err(),
        parameters,
        rms: rms_of(&columns, task.unit().is_some()),
        columns,
        shared_noise,
        covariance,
        left_over,
        identifiability,
        starts,
        gradient,
        evaluations: searches + model.evaluations,
    })
}

/// Values with their errors; `own` are those before the fit.
fn fitted_parameters(
    (errors, covariance, known): (&Errors<'_>, Option<&Covariance>, Option<&Identifiability>),
    (values, own, estimate): (&[f64], &[f64], &LeastSquaresFit),
) -> Vec<FittedParameter> {
    let standard_error = |i: usize| {
        let determined = known.is_some_and(|known| known.determines(i));
        if determined { covariance?.standard_error(i) } else { None }
    };
    let parameter = |i: usize| {
        let standard_error = standard_error(i);
        let interval = standard_error.and(covariance).and_then(|c| errors.interval(c, i));
        FittedParameter {
            value: values[i],
            standard_error,
            half_width: interval.map(|(half, _)| half),
            degrees_of_freedom: interval.map(|(_, degrees)| degrees),
            between: standard_error.and(errors.between(i)),
            start: own[i],
            on_bound: estimate.on_bound[i],
            profile: None,
        }
    };
    (0..values.len()).map(parameter).collect()
}

/// The parameters whose interval is not value ± error, with the rise of the sum of squares at its
/// ends: those for which value ± error contains impossible values, and those on a bound.
fn one_sided(
    (task, model, at_end): (&NetworkFitTask, &Model<'_>, &Evaluated),
    (unknowns, parameters): (&[Unknown], &[FittedParameter]),
    (errors, free, known): (&Errors<'_>, &[usize], Option<&Identifiability>),
) -> Vec<(usize, Rise)> {
    if errors.left_over() == 0 {
        return Vec::new();
    }
    let of_free = |i: usize| {
        let half = parameters[i].half_width?;
        let misleads = misleads(&unknowns[i], parameters[i].value, half);
        if misleads { Some(Rise { of: errors.rise(i, half)?, half }) } else { None }
    };
    let on_bound = |i: usize| {
        if unknowns[i].is_shift() || parameters[i].value < 0.0 {
            return None;
        }
        let mut with = free.to_vec();
        with.push(i);
        with.sort_unstable();
        let errors = Errors::new(task, model, (at_end, &with, known));
        let half = errors.interval(&errors.covariance()?, i)?.0;
        Some(Rise { of: errors.rise(i, half)?, half })
    };
    let one = |i: usize| match parameters[i].on_bound {
        Some(_) => on_bound(i),
        None => of_free(i),
    };
    (0..parameters.len()).filter_map(|i| Some((i, one(i)?))).collect()
}

fn check(task: &NetworkFitTask, unknowns: &[Unknown]) -> Result<(), NetworkFitError> {
    if unknowns.is_empty() {
        return Err(NetworkFitError::NoParameter);
    }
    for run in &task.runs {
        let span = (
            run.times.first().copied().unwrap_or(f64::NAN),
            run.times.last().copied().unwrap_or(f64::NAN),
        );
        let start = run.settings.start();
        if !(span.0 >= start && span.1 > start) {
            return Err(NetworkFitError::Times { record: run.name.clone(), span, start });
        }
    }
    let columns = task.runs.iter().flat_map(|run| &run.columns);
    let values = columns.flat_map(|column| &column.values).filter(|value| !value.is_nan()).count();
    if values == 0 {
        return Err(NetworkFitError::NoData);
    }
    let priors = unknowns.iter().filter(|unknown| unknown.prior.is_some()).count();
    if values + priors < unknowns.len() {
        let parameters = unknowns.len();
        return Err(NetworkFitError::TooFew { values: values + priors, parameters });
    }
    if let Some(parameter) = Priors::impossible(unknowns, &task.correlations) {
        return Err(NetworkFitError::Correlations { parameter });
    }
    let outside = |u: &Unknown| !(u.bounds.0 <= u.own && u.own <= u.bounds.1);
    match unknowns.iter().position(outside) {
        Some(parameter) => Err(NetworkFitError::StartOutside { parameter }),
        None => Ok(()),
    }
}

/// In standard deviations if the columns have no common unit: then each has one.
fn rms_of(columns: &[ColumnMisfit], one_unit: bool) -> f64 {
    let unit = |c: &ColumnMisfit| if one_unit { 1.0 } else { c.sigma.unwrap_or(1.0) };
    let squares: f64 = columns.iter().map(|c| (c.rms / unit(c)).powi(2) * c.samples as f64).sum();
    let samples: usize = columns.iter().map(|c| c.samples).sum();
    (squares / samples.max(1) as f64).sqrt()
}
