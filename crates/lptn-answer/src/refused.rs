//! Why a run or a steady state has no answer, at its place in the netlist.

use lptn_analysis::RunError;
use lptn_netlist::{Diagnostic, RunSettings, Span};
use lptn_network::{InputError, InputProblem, Item};
use lptn_report::duration;
use lptn_solve::{SteadyError, TransientError};
use lptn_units::{Dimension, Problem as _, Type};

use crate::failure::{Failure, told};
use crate::input::{self, Input};

/// A run without an answer.
pub fn unanswered(input: &Input, error: &RunError) -> Failure {
    match error {
        RunError::Failed(error) => run_failed(input, error),
        error @ RunError::Interrupted { .. } => input.failure(error, None),
    }
}

/// The problem that broke a run off, at the place of the input that caused it.
pub fn explain(input: &Input, error: &TransientError) -> Diagnostic {
    let map = &input.netlist.source_map;
    let place = error.place();
    let place = place.and_then(|(item, field)| map.get(item, field).or_else(|| map.name(item)));
    let place = place.or_else(|| input.node_place(error.node()?));
    told(error).at(place, "").also(other_threshold(input, error), "off")
}

/// A run that cannot start, or of which nothing is shown.
pub fn run_failed(input: &Input, error: &TransientError) -> Failure {
    input.refused(error.class().into(), explain(input, error))
}

/// The other of two thresholds that crossed: the error names one.
fn other_threshold(input: &Input, error: &TransientError) -> Option<Span> {
    let InputError { item, problem: InputProblem::ThresholdsCrossed { .. }, .. } = error.input()?
    else {
        return None;
    };
    let Item::Control(id) = *item else { return None };
    let thermostat = input.netlist.network.thermostat(id)?;
    input.netlist.source_map.get(*item, thermostat.acts.fields()[1])
}

/// Failure of a netlist without a `[run]`.
pub fn no_run(input: &Input) -> Failure {
    Failure::refused(
        "run::no_run",
        format!("{} has no [run], so its duration is not known", input.text.name),
        "add these lines, or use `lptn steady`:\n\n[run]\nstop = \"25 min\"",
    )
}

/// A time of the run that `--at` names, in s.
pub fn time_of_run(text: &str, settings: &RunSettings) -> Result<f64, Failure> {
    let time = input::quantity("--at", text, Type::of(Dimension::TIME))?.value;
    if (settings.start..=settings.stop).contains(&time) {
        return Ok(time);
    }
    let [start, stop] = [settings.start, settings.stop].map(|time| duration(time, 6));
    let message = format!("--at {text} is outside of the run, which goes from {start} to {stop}");
    let help = format!("name a time from {start} to {stop}, or give [run] another `stop`");
    Err(Failure::refused("run::time", message, help))
}

/// A network without a steady state.
pub fn steady_failed(input: &Input, error: &SteadyError) -> Failure {
    let place = match error {
        SteadyError::NoBoundary { nodes, .. } => {
            nodes.first().and_then(|&node| input.netlist.source_map.name(Item::Node(node)))
        }
        SteadyError::Unsolved(unsolved) if unsolved.input().is_none() => {
            input.node_place(unsolved.node())
        }
        SteadyError::BelowAbsoluteZero { name, .. } | SteadyError::Runaway { node: name, .. } => {
            input.node_place(name)
        }
        error => error.input().and_then(|error| input.place_of(error)),
    };
    input.failure(error, place)
}
