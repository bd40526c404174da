//! Times at which a comparison in an input changes: known beforehand, so that no step crosses them.

use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::value::{Evaluation, Value, slot};
use lptn_units::{Degree, Program};

impl Network {
    /// The times inside `(start, stop)` in s at which the truth of a comparison of `t` changes, ascending.
    ///
    /// A comparison is linear in `t` (the builder refuses others), so its two sides meet at most once.
    ///
    /// # Errors
    /// [`InputError`] if a side of a comparison cannot be evaluated.
    pub fn breakpoints(&self, start: f64, stop: f64) -> Result<Vec<f64>, InputError> {
        let mut scope = self.evaluation();
        let mut times = Vec::new();
        for (item, field, value) in self.inputs() {
            let Value::Expression(program) = value else { continue };
            for comparison in program.comparisons() {
                let time = crossing(comparison, &mut scope, (start, stop)).map_err(|problem| InputError {
                    item,
                    field,
                    name: self.name_of(item).to_owned(),
                    problem,
                })?;
                times.extend(time);
            }
        }
        times.sort_unstable_by(f64::total_cmp);
        // two that differ by rounding only are one
        let margin = margin(start, stop);
        times.dedup_by(|a, b| (*a - *b).abs() <= margin);
        Ok(times)
    }
}

/// Where a difference that is linear in time is zero strictly inside the interval.
fn crossing(
    difference: &Program,
    scope: &mut Evaluation,
    (start, stop): (f64, f64),
) -> Result<Option<f64>, InputProblem> {
    if difference.degree_in(slot::TIME) == Degree::Constant {
        return Ok(None);
    }
    let at_start = scope.evaluate(difference, start).map_err(InputProblem::Evaluation)?;
    let at_stop = scope.evaluate(difference, stop).map_err(InputProblem::Evaluation)?;
    let time = start + (stop - start) * (at_start / (at_start - at_stop));
    let margin = margin(start, stop);
    Ok((time > start + margin && time < stop - margin).then_some(time))
}

/// Times closer than this are one: rounding, and what no step could be taken between.
fn margin(start: f64, stop: f64) -> f64 {
    (1e-12 * (stop - start)).max(64.0 * f64::EPSILON * start.abs().max(stop.abs()))
}

impl Network {
    /// The inputs whose course over time is not known to be a straight line between breakpoints, as functions of
    /// time: an integrator has to look at them often enough to see what they do.
    pub fn curved_inputs(&self) -> impl Iterator<Item = &Value> {
        let curved = |value: &&Value| match value {
            Value::Constant(_) | Value::Product(_) => false,
            Value::Expression(program) => program.degree_in(slot::TIME) == Degree::Nonlinear,
        };
        self.inputs().map(|(_, _, value)| value).filter(curved)
    }
}
