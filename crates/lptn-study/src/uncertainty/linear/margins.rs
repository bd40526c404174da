//! How the margins of limits change with the parameters.

use lptn_assembly::ThermalSystem;
use lptn_network::{LimitId, OutputTimes};
use lptn_solve::{
    Gradient, LimitSeen, RecordedNodes, SensitiveRun, Solution, Transient, limit_margins_at,
    sensitive_run,
};

use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::input::Uncertain;
use crate::uncertainty::linear::line::{Line, ids, joined};
use crate::uncertainty::task::UncertaintyTask;

/// The part of a standard deviation over which the expression of a limit is differentiated. Its
/// temperatures are moved along their sensitivities, so that the limit of a temperature is exact to
/// rounding; what bends within a thousandth of a standard deviation is wrong in the seventh digit.
const PART: f64 = 1e-3;

/// For each limit what one standard deviation more of each parameter adds to its margin, in SI
/// units.
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
            line.run.margin(input.parameter, limit.limit).unwrap_or(f64::NAN) * input.deviation
        };
        let all =
            |limit: &LimitSeen| line.inputs.iter().map(|input| of_runs(limit, input)).collect();
        return Ok(seen.iter().map(all).collect());
    }
    let ends = [task.run.start, task.run.stop];
    let output = OutputTimes::At(joined(&ends, seen.iter().map(|limit| limit.worst_at)));
    let settings =
        Transient { output, record: RecordedNodes::All, watch: Vec::new(), ..task.watched() };
    let run = sensitive_run(task.network, &settings, &ids(line.inputs))?;
    let all = |limit: &LimitSeen| {
        let of_mean = task.network.limits()[limit.limit.index()].of_mean;
        let one = |input: &Uncertain| match of_mean {
            true => of_runs(task, (limit, input)),
            false => match of_expression(task, &run, (limit, input))? {
                Some(effect) => Ok(effect),
                None => of_runs(task, (limit, input)),
            },
        };
        line.inputs.iter().map(one).collect()
    };
    seen.iter().map(all).collect()
}

/// Half the difference of a margin between runs with the parameter one standard deviation to both
/// sides: a mean has no moment at which it is least, and at a bend the moment moves too.
fn of_runs(
    task: &UncertaintyTask<'_>,
    (limit, input): (&LimitSeen, &Uncertain),
) -> Result<f64, UncertaintyError> {
    let moved = |change: f64| -> Result<f64, UncertaintyError> {
        let mut parameters = task.parameters.clone();
        parameters.set(input.parameter, input.value + change);
        let system = ThermalSystem::of(task.network, &parameters)?;
        let settings = Transient { watch: Vec::new(), ..task.watched() };
        let solution = settings.solve(&system).map_err(Box::new)?;
        Ok(solution.limits()[limit.limit.index()].margin)
    };
    Ok(0.5 * (moved(input.deviation)? - moved(-input.deviation)?))
}

/// A margin bends where its slopes to both sides differ by more than this share.
const BENT: f64 = 0.05;

/// What is less than this beside 1 and the margin is rounding.
const ROUNDING: f64 = 1e-10;

/// The margin at the time at which it is least, with the parameter and the temperatures moved to
/// both sides; `None` where it bends there, as `min(a.T, b.T)` where both are equal.
fn of_expression(
    task: &UncertaintyTask<'_>,
    run: &SensitiveRun,
    (limit, input): (&LimitSeen, &Uncertain),
) -> Result<Option<f64>, UncertaintyError> {
    let times = run.solution.times();
    let distance = |place: &usize| (times[*place] - limit.worst_at).abs();
    let place = (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    let slopes: Vec<f64> = task
        .network
        .node_ids()
        .map(|node| run.sensitivity(input.parameter, node).map_or(0.0, |slopes| slopes[place]))
        .collect();
    let moved = |change: f64| {
        let mut parameters = task.parameters.clone();
        parameters.set(input.parameter, input.value + change);
        let temperatures: Vec<f64> = run
            .solution
            .row(place)
            .iter()
            .zip(&slopes)
            .map(|(t, slope)| t + slope * change)
            .collect();
        margin(task, &parameters, (limit.limit, times[place]), &temperatures)
    };
    let change = PART * input.deviation;
    let (low, here, high) = (moved(-change)?, moved(0.0)?, moved(change)?);
    let bends = (high + low - 2.0 * here).abs();
    let straight = bends <= BENT * (high - low).abs() + ROUNDING * (1.0 + here.abs());
    Ok(straight.then_some((high - low) / (2.0 * PART)))
}

fn margin(
    task: &UncertaintyTask<'_>,
    parameters: &lptn_network::Parameters,
    (limit, time): (LimitId, f64),
    temperatures: &[f64],
) -> Result<f64, UncertaintyError> {
    let system = ThermalSystem::of(task.network, parameters)?;
    Ok(limit_margins_at(&system, time, temperatures)?[limit.index()])
}
