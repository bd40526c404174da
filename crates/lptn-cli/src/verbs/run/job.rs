//! What a run is to do, and why it cannot.

use std::path::PathBuf;

use lptn_analysis::{Answer, RunAnalysis, RunError};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, RunSettings, Span};
use lptn_network::{End, InputError, InputProblem, Item, Network, NodeId};
use lptn_solve::{
    RecordedNodes, Selection, Solution, SteadyError, SteadyState, StopReason, TransientError,
    Window,
};
use lptn_units::{Dimension, Problem as _, Type, Unit};

use super::args::RunArgs;
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input};
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use crate::{balance, select};
use lptn_answer::families;
use lptn_answer::words::MOST_NODES;
use lptn_report::{Clock, Format, duration};

/// Why there is no steady state to show.
#[derive(Debug)]
pub(crate) enum NoSteady {
    /// Nobody asks for it.
    NotShown,
    /// The inputs change with time.
    Inputs,
    /// The network has none.
    Network(SteadyError),
}

/// What is to be done.
pub(crate) struct Job<'a> {
    pub(crate) input: &'a Input,
    pub(crate) settings: RunSettings,
    pub(crate) selection: Selection,
    /// Whether columns were asked for by name.
    pub(crate) chosen: bool,
    pub(crate) unit: Unit,
    pub(crate) clock: Clock,
    pub(crate) format: Format,
    pub(crate) balance: Option<End>,
    /// Times in s at which the report draws the network.
    pub(crate) at: Vec<f64>,
    /// Whether every node is recorded, whatever is selected.
    pub(crate) whole: bool,
    /// What was set on the command line.
    pub(crate) set: &'a [String],
}

impl<'a> Job<'a> {
    pub(crate) fn new(args: &'a RunArgs, input: &'a Input) -> Result<Self, Failure> {
        let netlist = &input.netlist;
        let mut settings = netlist.run.clone().ok_or_else(|| no_run(input))?;
        if let Some(text) = &args.tolerance {
            settings.tolerance = input::tolerance(text)?;
        }
        let selection = select::of_run(netlist, &args.shown.select)?;
        let unit = input::temperature_unit(args.shown.scale.temperature_unit.as_deref(), netlist)?;
        let chosen = !(args.shown.select.is_empty() && settings.select.is_empty());
        let format = args.shown.format;
        let balance = balance::end(netlist, args.balance.as_deref(), format)?;
        let at = args.at.iter().map(|text| time_of_run(text, &settings));
        let at = at.collect::<Result<_, _>>()?;
        let whole = false;
        Ok(Self {
            at,
            whole,
            input,
            settings,
            selection,
            chosen,
            unit,
            clock: Clock(args.time_scale.time_unit),
            format,
            balance,
            set: &input.set,
        })
    }

    pub(crate) fn folder(&self, args: &RunArgs) -> PathBuf {
        args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&self.input.text.stem))
    }

    /// Runs to the stop, to the first failure or to Ctrl-C.
    pub(crate) fn solve(
        &self,
        system: &ThermalSystem,
        steady: Option<&SteadyState>,
        console: &Console,
    ) -> Result<(Answer<Solution>, Option<Diagnostic>), Failure> {
        let asked = self.asked(system, steady).map_err(|error| failed(self.input, &error))?;
        observed(self.input, (system, &asked), console)
    }

    fn asked(
        &self,
        system: &ThermalSystem,
        steady: Option<&SteadyState>,
    ) -> Result<RunAnalysis, TransientError> {
        let run = RunAnalysis::of(system.network(), &self.settings);
        let mut record = record(system.network(), &self.selection);
        if self.whole {
            record = RecordedNodes::All;
        }
        let mut run = run;
        if self.format == Format::Table {
            let selection = Some(&self.selection).filter(|_| self.chosen);
            let shown = shown(system.network(), selection, steady);
            run = run.towards((system, &shown), steady).map_err(TransientError::Start)?;
            record = record.and(shown);
        }
        let window = |window: &lptn_netlist::WindowSettings| {
            let (name, of) = (window.name.clone(), self.selection.clone());
            Window { name, from: window.from, to: window.to, of }
        };
        let windows = self.settings.windows.iter().map(window).collect();
        Ok(run.keeping(record).over(windows).balancing(self.balance))
    }
}

/// What is kept for these columns. Whether nodes with a length are lumps is judged in every row
/// where heat flows are asked for, which takes all temperatures.
pub(crate) fn record(network: &Network, selection: &Selection) -> RecordedNodes {
    let is_lump = |id| network.length(id).is_some();
    if selection.has_heat() && network.node_ids().any(is_lump) {
        return RecordedNodes::All;
    }
    selection.record()
}

/// Runs to the stop, to the first failure or to Ctrl-C, and shows how far it is.
pub(crate) fn observed(
    input: &Input,
    (system, run): (&ThermalSystem, &RunAnalysis),
    console: &Console,
) -> Result<(Answer<Solution>, Option<Diagnostic>), Failure> {
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let outcome = run.solve(system, &mut |progress| {
        line.update(progress);
        interrupt.control()
    });
    line.clear();
    let error = match outcome {
        Ok(answer) => return Ok((answer, None)),
        Err(error) => error,
    };
    match error.into_part() {
        // nothing was computed, and nothing could be: the question does not fit the network
        Ok((_, Some(error))) if switches_nothing(&error) => Err(failed(input, &error)),
        // the rows are shown; the verdict asks their energy balance
        Ok((part, error)) => Ok((part, error.map(|error| explain(input, &error)))),
        Err(error) => Err(unanswered(input, &error)),
    }
}

/// A run without an answer.
pub(crate) fn unanswered(input: &Input, error: &RunError) -> Failure {
    match error {
        RunError::Failed(error) => failed(input, error),
        error @ RunError::Interrupted { .. } => input.failure(error, None),
    }
}

fn switches_nothing(error: &TransientError) -> bool {
    matches!(error, TransientError::Stopped { reason: StopReason::NothingSwitches, .. })
}

/// A time of the run that `--at` names, in s.
pub(crate) fn time_of_run(text: &str, settings: &RunSettings) -> Result<f64, Failure> {
    let time = input::quantity("--at", text, Type::of(Dimension::TIME))?.value;
    if (settings.start..=settings.stop).contains(&time) {
        return Ok(time);
    }
    let [start, stop] = [settings.start, settings.stop].map(|time| duration(time, 6));
    let message = format!("--at {text} is outside of the run, which goes from {start} to {stop}");
    let help = format!("name a time from {start} to {stop}, or give [run] another `stop`");
    Err(Failure::new(Exit::Input, Diagnostic::error("run::time", message).help(help)))
}

/// What broke a run off, with the place of the input that did.
pub(crate) fn explain(input: &Input, error: &TransientError) -> Diagnostic {
    let map = &input.netlist.source_map;
    let place = error.place();
    let place = place.and_then(|(item, field)| map.get(item, field).or_else(|| map.name(item)));
    let place = place.or_else(|| input.node_place(error.node()?));
    told(error).at(place, "").also(other_threshold(input, error), "off")
}

/// A run that cannot be begun, or that no part is shown of.
pub(crate) fn failed(input: &Input, error: &TransientError) -> Failure {
    input.refused(error.class().into(), explain(input, error))
}

/// Of thresholds that crossed over: the one that is not said to be at fault.
fn other_threshold(input: &Input, error: &TransientError) -> Option<Span> {
    let InputError { item, problem: InputProblem::ThresholdsCrossed { .. }, .. } = error.input()?
    else {
        return None;
    };
    let Item::Control(id) = *item else { return None };
    let thermostat = input.netlist.network.thermostat(id)?;
    input.netlist.source_map.get(*item, thermostat.acts.fields()[1])
}

pub(crate) fn no_run(input: &Input) -> Failure {
    let problem = Diagnostic::error(
        "run::no_run",
        format!("{} has no [run]: how long is it to run?", input.text.name),
    )
    .help("add these lines, or look at `lptn steady`:\n\n[run]\nstop = \"25 min\"");
    Failure::new(Exit::Input, problem)
}

/// So many nodes are watched where families make few rows of them.
const MOST_WATCHED: usize = 500;

/// The nodes that a table shows: those selected, in the order of the file; unless any is, all but
/// the cells of grids. Of too many the hottest in steady state, hottest first; where there is none,
/// the first ones.
pub(crate) fn shown(
    network: &Network,
    selection: Option<&Selection>,
    steady: Option<&SteadyState>,
) -> Vec<NodeId> {
    let mut nodes: Vec<NodeId> = selection.into_iter().flat_map(Selection::nodes).collect();
    if nodes.is_empty() {
        nodes = network.outer_nodes().collect();
    }
    let name = |id: &NodeId| (network.nodes()[id.index()].name.clone(), 0);
    let rows = |nodes: &[NodeId]| families::folded(nodes.to_vec(), true, name, |_| 0.0).len();
    let few = nodes.len() <= MOST_WATCHED && rows(&nodes) <= MOST_NODES;
    if nodes.len() > MOST_NODES && !few {
        if let Some(steady) = steady {
            let at = |id: &NodeId| steady.temperatures[id.index()];
            nodes.sort_by(|a, b| at(b).total_cmp(&at(a)));
        }
        nodes.truncate(MOST_NODES);
    }
    nodes
}
