//! `lptn steady --periodic`

mod page;

use std::time::Instant;

use lptn_analysis::{Answer, CycleError, RunAnalysis};
use lptn_assembly::ThermalSystem;
use lptn_netlist::RunSettings;
use lptn_network::{Item, OutputTimes};
use lptn_report::Clock;
use lptn_solve::{CycleMethod, Lumping, Periodic, PeriodicError, Table, Window, WindowSeen};
use lptn_study::SiValue;
use lptn_units::{Problem as _, Type};
use serde_json::{Map, Value, json};

use super::SteadyArgs;
use crate::console::Console;
use crate::files::Folder;
use crate::files::names::{MANIFEST, RESULT, WINDOWS};
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use crate::verbs::run::job::{Job, NoSteady};
use crate::verbs::run::outcome::Outcome;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input};
use lptn_answer::refused::{explain, unanswered};
use lptn_answer::run::record;
use lptn_answer::{balance, period, select};
use lptn_answer::{scale, trust};

/// The name of the window over the cycle.
const CYCLE: &str = "cycle";

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
        set: &input.set,
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
    let solution = Answer { result: found.solution.clone(), trust: found.trust.clone() };
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
    let view = View { outcome: &outcome, found: &found.result };
    if let Some(folder) = &folder {
        outcome.write(folder)?;
        console.results_in(folder.path());
    }
    console.show(&view, args.shown.format)?;
    console.warn(&netlist.files, &trust::doubts(netlist, &found.trust, true));
    if let Some(folder) = &folder {
        let path = folder.path().join(RESULT);
        console.note(&format!("wrote  {}, {WINDOWS}, {MANIFEST}", path.display()));
    }
    Ok(view.conclude(console))
}

/// Those of the cycle.
fn settings(args: &SteadyArgs, input: &Input) -> Result<RunSettings, Failure> {
    let run = input.netlist.run.as_ref();
    let period = period::of_cycle(input, args.cycle.period.as_deref())?;
    let cycle = RunSettings::cycle(run, period);
    let output = match run.map(|run| &run.output) {
        Some(OutputTimes::Every(every)) if *every <= period / LEAST_ROWS => {
            OutputTimes::Every(*every)
        }
        _ => cycle.output.clone(),
    };
    let tolerance = match &args.cycle.tolerance {
        Some(text) => input::tolerance(text)?,
        None => cycle.tolerance,
    };
    Ok(RunSettings { output, tolerance, ..cycle })
}

fn find(
    job: &Job<'_>,
    system: &ThermalSystem,
    console: &Console,
) -> Result<Answer<Periodic>, Failure> {
    let RunSettings { start, stop, .. } = job.settings;
    let window = Window { name: CYCLE.into(), from: start, to: stop, of: job.selection.clone() };
    let cycle = RunAnalysis::of(system.network(), &job.settings)
        .keeping(record(system.network(), &job.selection))
        .over(vec![window])
        .balancing(job.balance);
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let found = cycle.cycle(system, &mut |progress| {
        line.update(progress);
        interrupt.control()
    });
    line.clear();
    found.map_err(|error| match error {
        CycleError::Missing(error) => failed(job.input, &error),
        CycleError::Run(error) => unanswered(job.input, &error),
    })
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
