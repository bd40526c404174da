//! Identifiability of the parameters at the end of a search.

use lptn_solve::Gradient;

use crate::network::identify::{Identifiability, identify};
use crate::network::model::{Evaluated, Model};
use crate::network::task::NetworkFitTask;
use crate::network::undetermined::Place;
use crate::network::unknown::Unknown;

/// The size of a temperature as a parameter, in K: its zero is arbitrary.
const TEMPERATURE: f64 = 10.0;

/// A value below this part of a parameter's size does not measure it.
const SMALL: f64 = 0.1;

/// Relative accuracy of derivatives: those that come with runs at a tolerance of 1e-7 K, and
/// differences.
const EXACT: f64 = 1e-6;
pub(crate) const DIFFERENCES: f64 = 1e-4;

/// Size of an unknown in SI units.
fn size(unknown: &Unknown) -> f64 {
    if unknown.ty.absolute {
        return TEMPERATURE;
    }
    let (low, high) = unknown.bounds;
    let all = [unknown.own.abs(), unknown.prior.unwrap_or(0.0), high - low];
    all.into_iter().find(|size| size.is_finite() && *size > 0.0).unwrap_or(1.0)
}

/// Relative accuracy of derivatives of this kind.
pub(crate) fn accuracy(gradient: Gradient) -> f64 {
    if gradient == Gradient::Exact { EXACT } else { DIFFERENCES }
}

/// Identifiability of the parameters by the residuals and derivatives at the end of the search.
pub(crate) fn told_apart(
    (task, unknowns): (&NetworkFitTask, &[Unknown]),
    (at_end, accuracy): (&Evaluated, f64),
    model: &mut Model<'_>,
) -> Option<Identifiability> {
    // in units of its value a parameter counts as its logarithm, unless it drifted to nearly
    // nothing
    let scale = |(unknown, value): (&Unknown, &f64)| match (size(unknown), value.abs()) {
        // an almost unknown offset is not larger than the readings
        (size, _) if unknown.is_shift() => {
            let read = unknown.sensor().map_or(f64::INFINITY, |sensor| task.largest_of(sensor));
            if read > 0.0 { size.min(read) } else { size }
        }
        (size, value) if value > SMALL * size => value,
        (size, _) => SMALL * size,
    };
    let scales: Vec<f64> = unknowns.iter().zip(&at_end.values).map(scale).collect();
    let place = Place {
        jacobian: &at_end.jacobian,
        values: &at_end.values,
        scales: &scales,
        accuracy,
        addable: &|i, j| unknowns[i].ty == unknowns[j].ty && !unknowns[i].ty.absolute,
    };
    identify(&place, &mut |values| model.at(values).ok().map(|found| found.residuals.clone()))
}
