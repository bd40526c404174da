//! Changes of the margins of limits with the parameters.

use lptn_assembly::ThermalSystem;
use lptn_solve::{Gradient, LimitSeen, Proceed, RecordedNodes, Solution, on_both_sides, own_side};

use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::input::Uncertain;
use crate::uncertainty::linear::line::{Line, ids, joined};
use crate::uncertainty::task::UncertaintyTask;

/// The part of a standard deviation over which the expression of a limit is differentiated. Its
/// temperatures are moved along their sensitivities, so that the limit of a temperature is exact to
/// rounding; an expression that bends within this part is wrong in the seventh digit.
const PART: f64 = 1e-3;

/// For each limit the change of its margin, in SI units, with one standard deviation more of each
/// parameter.
pub(super) fn effects(
    task: &UncertaintyTask<'_>,
    line: &Line<'_>,
    solution: &Solution,
) -> Result<Vec<Vec<f64>>, UncertaintyError> {
    let seen = solution.limits();
    if seen.is_empty() {
        return Ok(Vec::new());
    }
    if line.run.gradient != Gradient::Exact {
        let of_runs = |limit: &LimitSeen, input: &Uncertain| {
            line.run.margin(input.parameter, limit.limit).unwrap_or(f64::NAN) * input.deviation()
        };
        let all =
            |limit: &LimitSeen| line.inputs.iter().map(|input| of_runs(limit, input)).collect();
        return Ok(seen.iter().map(all).collect());
    }
    let ends = (task.run.start(), task.run.stop());
    let worst = on_both_sides(seen.iter().map(|limit| limit.worst_at), ends);
    let times = joined(&[ends.0, ends.1], worst.into_iter());
    let run = task.run.clone().bare().at(times).keeping(RecordedNodes::All);
    let run = run.with_slopes((task.network, &ids(line.inputs)), &|_| Proceed::Continue)?;
    let all = |limit: &LimitSeen| {
        let margin = |row: usize| run.margin_in_row(limit.limit, row).unwrap_or(f64::NAN);
        let worst = (limit.worst_at, limit.margin);
        let row = own_side((run.solution.times(), margin), worst, ends);
        let of_moments = task.network.limits()[limit.limit.index()].is_of_moments();
        let one = |input: &Uncertain| {
            let by = PART * input.deviation();
            let slope = match of_moments {
                false => None,
                true => run.margin_slope_in_row((input.parameter, by), (limit.limit, row))?,
            };
            slope.map_or_else(|| of_runs(task, (limit, input)), |s| Ok(s * input.deviation()))
        };
        line.inputs.iter().map(one).collect()
    };
    seen.iter().map(all).collect()
}

/// Half the difference of a margin between runs with the parameter one standard deviation to both
/// sides: a number over time has no moment at which it is least, and at a bend the moment moves too.
fn of_runs(
    task: &UncertaintyTask<'_>,
    (limit, input): (&LimitSeen, &Uncertain),
) -> Result<f64, UncertaintyError> {
    let moved = |change: f64| -> Result<f64, UncertaintyError> {
        let mut parameters = task.parameters.clone();
        parameters.set(input.parameter, input.value + change);
        let system = ThermalSystem::of(task.network, &parameters)?;
        let run = task.watched().watching([]);
        let solution = run.solve(&system, &mut |_| Proceed::Continue)?;
        Ok(solution.limits()[limit.limit.index()].margin)
    };
    Ok(0.5 * (moved(input.deviation())? - moved(-input.deviation())?))
}
