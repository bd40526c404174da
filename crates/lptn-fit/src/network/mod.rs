//! Parameters of a network from records of its temperatures.
//!
//! Residuals are model less record, over the standard deviation of a value where one is given, at
//! every row of every record; what is known of a parameter beforehand (`±`) counts as one more.
//! Runs are shared out to threads, and nothing depends on how many there are. Searches begin at the
//! own values and at points between the bounds, on at most 150 rows of each record; the best goes
//! on with all rows.
//!
//! Standard errors follow from the residuals as they are, not from the standard deviations given,
//! and know that neighbours in a record are alike: see [`crate::noise`]. Only where few values are
//! left over they are no smaller than the standard deviations say. [`Identifiability`] tells what
//! the records cannot separate.

mod combination;
mod coordinates;
mod error;
mod errors;
mod fitted;
mod identify;
mod model;
mod plan;
mod search;
mod task;
mod undetermined;

pub use combination::CombinationKind;
pub use error::NetworkFitError;
pub use fitted::{ColumnMisfit, FittedParameter, NetworkFit};
pub use identify::Identifiability;
pub use lptn_network::Varied;
pub use search::Starts;
pub use task::{FitObserver, FitStage, MeasuredColumn, MeasuredRun, NetworkFitTask};
pub use undetermined::{Combination, Unseparated};

use lptn_solve::{Gradient, Proceed};

use crate::network::coordinates::Coordinates;
use crate::network::errors::Errors;
use crate::network::identify::identify;
use crate::network::model::{Evaluated, Model};
use crate::network::search::{Found, search};
use crate::network::undetermined::Place;

/// The size of a temperature as a parameter, in K: its zero says nothing.
const TEMPERATURE: f64 = 10.0;

/// A value below this part of a parameter's size does not measure it.
const SMALL: f64 = 0.1;

/// How accurate derivatives are, relative: those that come with runs at a tolerance of 1e-7 K, and
/// differences.
const EXACT: f64 = 1e-6;
const DIFFERENCES: f64 = 1e-4;

/// Fits the parameters of a task.
///
/// # Errors
/// [`NetworkFitError`] for a task that asks for nothing, or where the own values have no run. That
/// the search does not converge is an answer: [`NetworkFit::not_converged`].
pub fn fit_network(task: &NetworkFitTask<'_>) -> Result<NetworkFit, NetworkFitError> {
    fit_network_observed(task, &|_, _| Proceed::Continue)
}

/// The same; `observer` is called after every step of every run and may interrupt the fit.
///
/// # Errors
/// As [`fit_network`]; [`NetworkFitError::Interrupted`] with the best values so far.
pub fn fit_network_observed(
    task: &NetworkFitTask<'_>,
    observer: &FitObserver<'_>,
) -> Result<NetworkFit, NetworkFitError> {
    check(task)?;
    let own: Vec<f64> =
        task.parameters.iter().map(|v| task.network.parameter_value(v.parameter)).collect();
    let absolute: Vec<bool> = task.parameters.iter().map(|v| is_temperature(task, *v)).collect();
    let sizes = sizes(task, &own);
    let coordinates = Coordinates::new(&task.parameters, &absolute);
    let Found { estimate, outcome, starts, gradient, mut model, searches } =
        search((task, observer), &coordinates, &own)?;
    let (values, _) = coordinates.values(&estimate.parameters);
    let Ok(at_end) = model.at(&values).cloned() else {
        return Err(NetworkFitError::NoData); // the search ends where there are runs
    };
    let identifiability = told_apart(task, (&at_end, &sizes), &mut model, &gradient);
    if model.interrupted {
        return Err(model.broken_off());
    }
    let errors = Errors::new(task, &model, (&at_end, &estimate.free(), identifiability.as_ref()));
    let covariance = errors.covariance();
    let standard_error = |i: usize| {
        let determined = identifiability.as_ref().is_some_and(|known| known.determines(i));
        if determined { covariance.as_ref()?.standard_error(i) } else { None }
    };
    let parameter = |i: usize| FittedParameter {
        value: values[i],
        standard_error: standard_error(i),
        start: own[i],
        on_bound: estimate.on_bound[i],
    };
    let columns = errors.columns();
    Ok(NetworkFit {
        not_converged: outcome.err(),
        parameters: (0..values.len()).map(parameter).collect(),
        rms: rms_of(&columns),
        columns,
        covariance,
        left_over: errors.left_over(),
        identifiability,
        starts,
        gradient,
        evaluations: searches + model.evaluations,
    })
}

fn is_temperature(task: &NetworkFitTask<'_>, varied: Varied) -> bool {
    task.network.parameters()[varied.parameter.index()].ty.absolute
}

/// What counts as the size of each parameter, in SI units.
fn sizes(task: &NetworkFitTask<'_>, own: &[f64]) -> Vec<f64> {
    let size = |(varied, own): (&Varied, &f64)| {
        if is_temperature(task, *varied) {
            return TEMPERATURE;
        }
        let (low, high) = varied.bounds;
        let all = [own.abs(), varied.prior.unwrap_or(0.0), high - low];
        all.into_iter().find(|size| size.is_finite() && *size > 0.0).unwrap_or(1.0)
    };
    task.parameters.iter().zip(own).map(size).collect()
}

fn check(task: &NetworkFitTask<'_>) -> Result<(), NetworkFitError> {
    if task.parameters.is_empty() {
        return Err(NetworkFitError::NoParameter);
    }
    for run in &task.runs {
        let span = (
            run.times.first().copied().unwrap_or(f64::NAN),
            run.times.last().copied().unwrap_or(f64::NAN),
        );
        let start = run.settings.start;
        if !(span.0 >= start && span.1 > start) {
            return Err(NetworkFitError::Times { record: run.name.clone(), span, start });
        }
    }
    let columns = task.runs.iter().flat_map(|run| &run.columns);
    let values = columns.flat_map(|column| &column.values).filter(|value| !value.is_nan()).count();
    if values == 0 {
        return Err(NetworkFitError::NoData);
    }
    let priors = task.parameters.iter().filter(|varied| varied.prior.is_some()).count();
    if values + priors < task.parameters.len() {
        return Err(NetworkFitError::TooFew {
            values: values + priors,
            parameters: task.parameters.len(),
        });
    }
    let outside = |varied: &Varied| {
        let own = task.network.parameter_value(varied.parameter);
        !(varied.bounds.0 <= own && own <= varied.bounds.1)
    };
    match task.parameters.iter().position(outside) {
        Some(parameter) => Err(NetworkFitError::StartOutside { parameter }),
        None => Ok(()),
    }
}

/// What the residuals and their derivatives where the search ended tell of the parameters.
fn told_apart(
    task: &NetworkFitTask<'_>,
    (at_end, sizes): (&Evaluated, &[f64]),
    model: &mut Model<'_>,
    gradient: &Gradient,
) -> Option<Identifiability> {
    let types: Vec<_> =
        task.parameters.iter().map(|v| task.network.parameters()[v.parameter.index()].ty).collect();
    // in units of its own value a parameter is seen as its logarithm, unless it drifted to nearly
    // nothing
    let scale = |i: usize| match at_end.values[i].abs() {
        size if size > SMALL * sizes[i] && !types[i].absolute => size,
        _ if types[i].absolute => sizes[i],
        _ => SMALL * sizes[i],
    };
    let scales: Vec<f64> = (0..types.len()).map(scale).collect();
    let place = Place {
        jacobian: &at_end.jacobian,
        values: &at_end.values,
        scales: &scales,
        accuracy: if *gradient == Gradient::Exact { EXACT } else { DIFFERENCES },
        addable: &|i, j| types[i] == types[j] && !types[i].absolute,
    };
    identify(&place, &mut |values| model.at(values).ok().map(|found| found.residuals.clone()))
}

fn rms_of(columns: &[ColumnMisfit]) -> f64 {
    let squares: f64 = columns.iter().map(|c| c.rms * c.rms * c.samples as f64).sum();
    let samples: usize = columns.iter().map(|c| c.samples).sum();
    (squares / samples.max(1) as f64).sqrt()
}
