//! `lptn steady --periodic`

mod page;

use std::time::Instant;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::{Item, OutputTimes};
use lptn_report::{Clock, duration};
use lptn_solve::{
    CycleMethod, Lumping, Periodic, PeriodicError, Table, Transient, Window, WindowSeen,
};
use lptn_study::SiValue;
use lptn_units::{Dimension, Problem as _, Type};
use serde_json::{Map, Value, json};

use super::SteadyArgs;
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::Folder;
use crate::files::names::{MANIFEST, RESULT, WINDOWS};
use crate::input::{self, Input};
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use crate::verbs::run::job::{Job, NoSteady, explain, record};
use crate::verbs::run::outcome::Outcome;
use crate::{balance, scale, select, sense};

/// The name of the window over the cycle.
const CYCLE: &str = "cycle";

/// The tolerance in K where there is no `[run]`.
const TOLERANCE: f64 = 1e-5;

/// A row is written at least so often in a cycle.
const LEAST_ROWS: f64 = 20.0;

pub(crate) fn periodic(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    let input = console.phases.timed("read", || Input::load(&args.source))?;
    let netlist = &input.netlist;
    let job = Job {
        settings: settings(args, &input)?,
        selection: select::of_option(netlist, &args.shown.select)?,
        chosen: !args.shown.select.is_empty(),
        unit: input::temperature_unit(args.shown.scale.temperature_unit.as_deref(), netlist)?,
        clock: Clock::default(),
        format: args.shown.format,
        balance: balance::end(netlist, args.balance.as_deref(), args.shown.format)?,
        input: &input,
        set: &args.source.set,
        at: Vec::new(),
        whole: console.reports(),
    };
    let phases = &console.phases;
    let system = phases.timed("assemble", || input.assemble())?;
    let folder = args.cycle.output.clone().map(Folder::prepare).transpose()?;
    console.warn(&netlist.files, &netlist.warnings);
    let begun = Instant::now();
    let found = phases.timed("integrate", || find(&job, &system, console))?;
    let wall_time = begun.elapsed().as_secs_f64();
    let solution = found.solution.clone();
    let lumping = Lumping::of_run(&solution);
    let (failure, uncertainty) = (None, None);
    let steady = Err(NoSteady::Inputs);
    let table = Table::of_solution(&solution, &job.selection, &job.unit);
    let outcome = Outcome {
        job,
        steady,
        solution,
        lumping,
        failure,
        wall_time,
        phases: phases.seconds(),
        uncertainty,
        table,
        detail: console.detail,
    };
    let view = View { outcome: &outcome, found: &found };
    if let Some(folder) = &folder {
        outcome.write(folder)?;
        console.results_in(folder.path());
    }
    console.show(&view, args.shown.format)?;
    console.warn(&netlist.files, &sense::of_run(netlist, &outcome.solution));
    if let Some(folder) = &folder {
        let path = folder.path().join(RESULT);
        console.note(&format!("wrote  {}, {WINDOWS}, {MANIFEST}", path.display()));
    }
    Ok(view.conclude(console))
}

/// Those of the cycle.
fn settings(args: &SteadyArgs, input: &Input) -> Result<RunSettings, Failure> {
    let run = input.netlist.run.as_ref();
    let start = run.map_or(0.0, |run| run.start);
    let period = period(args, input)?;
    let output = match run.map(|run| &run.output) {
        Some(OutputTimes::Every(every)) if *every <= period / LEAST_ROWS => {
            OutputTimes::Every(*every)
        }
        _ => OutputTimes::Every(period / OutputTimes::USUAL_INTERVALS),
    };
    let tolerance = match &args.cycle.tolerance {
        Some(text) => input::tolerance(text)?,
        None => run.map_or(TOLERANCE, |run| run.tolerance),
    };
    let (select, windows) = (Vec::new(), Vec::new());
    let integrator = run.map_or_else(Default::default, |run| run.integrator);
    let held = run.map_or_else(Vec::new, |run| run.held.clone());
    Ok(RunSettings {
        start,
        stop: start + period,
        output,
        select,
        windows,
        tolerance,
        integrator,
        held,
    })
}

/// The period that was given, or that of the repeated signals, in s.
fn period(args: &SteadyArgs, input: &Input) -> Result<f64, Failure> {
    let Some(text) = &args.cycle.period else { return period_of_signals(input) };
    let what = (Dimension::TIME, "periodic::period", "\"10 min\"");
    Ok(input::positive("--period", text, what)?.value)
}

fn period_of_signals(input: &Input) -> Result<f64, Failure> {
    const HELP: &str = "say after which time all inputs repeat themselves: --period \"10 min\"";
    let network = &input.netlist.network;
    let problem = match network.repeat_period() {
        Ok(Some(period)) => return Ok(period),
        Ok(None) if network.has_time_dependent_inputs() => Diagnostic::error(
            "periodic::no_period",
            "no signal is repeated, so the period is not known",
        )
        .help(HELP),
        Ok(None) => {
            Diagnostic::error("periodic::no_period", "nothing changes with time: there is no cycle")
                .help("leave --periodic out")
        }
        Err(none) => {
            let [first, second] = &none.names;
            let [a, b] = none.periods.map(|period| duration(period, 6));
            let message = format!(
                "`{second}` repeats itself every {b} and `{first}` every {a}: they have no period \
                 in common"
            );
            let problem = Diagnostic::error("periodic::no_common_period", message);
            let place = input.netlist.source_map.name(Item::Signal(none.signals[1]));
            problem.help("change one of the periods, or look at `lptn run`").at(place, "")
        }
    };
    Err(input.refused(Exit::Input, problem))
}

fn find(job: &Job<'_>, system: &ThermalSystem, console: &Console) -> Result<Periodic, Failure> {
    let RunSettings { start, stop, .. } = job.settings;
    let window = Window { name: CYCLE.into(), from: start, to: stop, of: job.selection.clone() };
    let transient = Transient {
        record: record(system.network(), &job.selection),
        windows: vec![window],
        balance: job.balance,
        ..lptn_solve::Transient::of(system.network(), &job.settings)
    };
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let found = Periodic::find_observed(system, &transient, &mut |progress| {
        line.update(progress);
        interrupt.control()
    });
    line.clear();
    found.map_err(|error| failed(job.input, &error))
}

fn failed(input: &Input, error: &PeriodicError) -> Failure {
    let map = &input.netlist.source_map;
    let place = match error {
        PeriodicError::NotPeriodic(found) => {
            map.get(found.item, found.field).or_else(|| map.name(found.item))
        }
        PeriodicError::NoBalance { nodes, .. } => {
            nodes.first().and_then(|&node| map.name(Item::Node(node)))
        }
        PeriodicError::Cycle(cause) => {
            return input.refused(error.class().into(), explain(input, cause));
        }
        error => error.input().and_then(|error| input.place_of(error)),
    };
    input.failure(error, place)
}

/// A periodic state and how it is shown.
pub(crate) struct View<'a> {
    pub(crate) outcome: &'a Outcome<'a>,
    pub(crate) found: &'a Periodic,
}

impl View<'_> {
    /// What was seen of the columns over the cycle.
    pub(crate) fn cycle(&self) -> Option<&WindowSeen> {
        self.found.solution.windows().first()
    }

    pub(crate) fn period(&self) -> f64 {
        self.outcome.job.settings.stop - self.outcome.job.settings.start
    }

    /// Time constant of the slowest part in s.
    pub(crate) fn slowest(&self) -> Option<f64> {
        let rho = self.found.multiplier.filter(|rho| *rho > 0.0 && *rho < 1.0)?;
        Some(-self.period() / rho.ln())
    }

    /// The first row of every column, in the unit that is shown.
    fn starts(&self) -> impl Iterator<Item = f64> + '_ {
        self.outcome
            .table
            .columns()
            .iter()
            .skip(1)
            .map(|c| c.values.first().copied().unwrap_or(f64::NAN))
    }

    /// By column: start, mean, extremes and swing, temperatures in the unit that is shown.
    fn members(&self) -> Map<String, Value> {
        let unit = &self.outcome.job.unit;
        let seconds = |time: f64| SiValue::new(time, "s");
        let columns = self.cycle().into_iter().flat_map(|cycle| &cycle.columns).zip(self.starts());
        let member = |(seen, start): (&lptn_solve::ColumnSeen, f64)| {
            let scalar = |value: f64| scale::scalar(value, seen.ty, unit);
            let swing = Type::of(seen.ty.dimension);
            let start = if seen.ty.absolute { unit.to_si(start) } else { start };
            let member = json!({
                "start": scalar(start),
                "mean": scalar(seen.mean),
                "min": scalar(seen.min.0),
                "min_at": seconds(seen.min.1),
                "max": scalar(seen.max.0),
                "max_at": seconds(seen.max.1),
                "swing": scale::scalar(seen.max.0 - seen.min.0, swing, unit),
            });
            (seen.name.clone(), member)
        };
        columns.map(member).collect()
    }

    fn search(&self) -> Value {
        let found = self.found;
        let kelvin = |value: f64| scale::of_difference(value, &self.outcome.job.unit);
        json!({
            "method": match found.method {
                CycleMethod::Modes => "modes",
                CycleMethod::Shooting => "shooting",
                CycleMethod::Stateless => "stateless",
            },
            "cycles": found.cycles,
            "steps": found.steps,
            "flow_evaluations": found.flow_evaluations,
            "residual": kelvin(found.residual),
            "error": kelvin(found.error),
            "multiplier": found.multiplier,
            "time_constant": self.slowest().map(|tau| SiValue::new(tau, "s")),
        })
    }

    fn conclude(&self, console: &Console) -> Exit {
        self.outcome.judge(console)
    }
}
