//! The cycle at which a network with repeating inputs settles.

mod page;

use std::sync::Arc;

use lptn_analysis::{CycleError, RunAnalysis, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files, RunSettings};
use lptn_network::{Item, OutputTimes};
use lptn_report::{Clock, Format};
use lptn_solve::{
    ColumnSeen, CycleMethod, Lumping, Periodic, PeriodicError, Table, Window, WindowSeen,
};
use lptn_study::SiValue;
use lptn_units::{Problem as _, Type};
use serde_json::{Map, Value, json};

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::{Listener, Stopwatch, timed};
use crate::lumping::Detail;
use crate::refused::{explain, unanswered};
use crate::run::{NoSteady, RunAnswer, RunTask, View, record};
use crate::{balance, period, proven, scale, select, trust};

/// The name of the window over the cycle.
const CYCLE: &str = "cycle";

/// Least number of rows per cycle: fewer draw its curves as polygons.
const LEAST_ROWS: f64 = OutputTimes::USUAL_INTERVALS;

/// The settled cycle of a netlist.
#[derive(Clone, Debug)]
pub struct CycleQuestion {
    /// The period, such as `10 min`; `None` for that of the repeated signals.
    pub period: Option<String>,
    /// The tolerance, such as `1e-7K`; `None` for that of the netlist.
    pub tolerance: Option<String>,
    /// Patterns of the columns, such as `*.T`; empty for all.
    pub select: Vec<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
    /// The node or boundary whose heat balance is shown.
    pub balance: Option<String>,
    /// The format that will be read.
    pub format: Format,
    /// True if a report is wanted.
    pub report: bool,
    /// Amount of detail in a table.
    pub detail: Detail,
    /// True if errors are bounded with proof.
    pub certify: bool,
}

/// A settled cycle that is ready to be searched.
#[derive(Clone, Debug)]
pub struct CycleTask(RunTask);

/// A settled cycle.
#[derive(Debug)]
pub struct CycleAnswer {
    /// One period of it as a run.
    pub run: RunAnswer,
    /// Result of the search.
    pub found: Periodic,
}

impl CycleQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A question that does not fit the netlist, and a network without a settled cycle.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<CycleAnswer, Failure> {
        let task = self.of(input)?;
        let system = task.0.input.assemble()?;
        task.answer(&system, listener)
    }

    /// Checks the question for a netlist.
    ///
    /// # Errors
    /// A period that is not known, and a unit, column or node that does not exist.
    pub fn of(&self, input: Arc<Input>) -> Result<CycleTask, Failure> {
        let netlist = &input.netlist;
        let settings = self.settings(&input)?;
        let selection = select::of_option(netlist, &self.select)?;
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), netlist)?;
        let balance = balance::end(netlist, self.balance.as_deref(), self.format)?;
        Ok(CycleTask(RunTask {
            settings,
            selection,
            chosen: !self.select.is_empty(),
            unit,
            clock: Clock::default(),
            format: self.format,
            balance,
            at: Vec::new(),
            report: self.report,
            picture: true,
            view: View::of_page(),
            detail: self.detail,
            uncertainty: None,
            certify: self.certify,
            input,
        }))
    }

    /// Those of the cycle.
    fn settings(&self, input: &Input) -> Result<RunSettings, Failure> {
        let run = input.netlist.run.as_ref();
        let period = period::of_cycle(input, self.period.as_deref())?;
        let cycle = RunSettings::cycle(run, period);
        let output = match run.map(|run| &run.output) {
            Some(OutputTimes::Every(every)) if *every <= period / LEAST_ROWS => {
                OutputTimes::Every(*every)
            }
            _ => cycle.output.clone(),
        };
        let tolerance = match &self.tolerance {
            Some(text) => input::tolerance(text)?,
            None => cycle.tolerance,
        };
        Ok(RunSettings { output, tolerance, ..cycle })
    }
}

impl CycleTask {
    /// Searches the cycle.
    ///
    /// # Errors
    /// A network without one, a run that fails, and an interruption.
    pub fn answer(
        self,
        system: &ThermalSystem,
        listener: &dyn Listener,
    ) -> Result<CycleAnswer, Failure> {
        let Self(task) = self;
        let begun = Stopwatch::start();
        let found = timed(listener, "integrate", || find(&task, system, listener))?;
        let wall_time = begun.seconds();
        let solution = Trusted { result: found.solution.clone(), trust: found.trust };
        let run = RunAnswer {
            lumping: Lumping::of_run(&solution),
            table: Table::of_solution(&solution, &task.selection, &task.unit).with_bounds(
                &solution,
                &task.selection,
                &task.unit,
            ),
            task,
            steady: Err(NoSteady::Inputs),
            solution,
            failure: None,
            wall_time,
            uncertainty: None,
        };
        Ok(CycleAnswer { run, found: found.result })
    }
}

fn find(
    task: &RunTask,
    system: &ThermalSystem,
    listener: &dyn Listener,
) -> Result<Trusted<Periodic>, Failure> {
    let RunSettings { start, stop, .. } = task.settings;
    let window = Window { name: CYCLE.into(), from: start, to: stop, of: task.selection.clone() };
    let cycle = RunAnalysis::of(system.network(), &task.settings)
        .keeping(record(system.network(), &task.selection))
        .over(vec![window])
        .drawing(task.drawn())
        .balancing(task.balance);
    let cycle = match task.certify {
        true => cycle.certified(task.selection.clone()),
        false => cycle,
    };
    listener.begin();
    let found = cycle.cycle(system, &mut |progress| listener.progress(progress));
    found.map_err(|error| match error {
        CycleError::Missing(error) => failed(&task.input, &error),
        CycleError::Run(error) => unanswered(&task.input, &error),
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

impl Answer for CycleAnswer {
    fn files(&self) -> &Files {
        self.run.files()
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.run.task.input.netlist.warnings.as_slice(), &self.beside()].concat()
    }

    fn reasons(&self) -> Vec<String> {
        self.run.verdict().broken
    }

    fn exit(&self) -> Exit {
        if self.run.verdict().holds() { Exit::Done } else { Exit::No }
    }
}

impl CycleAnswer {
    /// Means and extremes of the columns over the cycle.
    fn cycle(&self) -> Option<&WindowSeen> {
        self.found.solution.windows().first()
    }

    fn period(&self) -> f64 {
        self.run.task.settings.stop - self.run.task.settings.start
    }

    /// Time constant of the slowest part in s.
    fn slowest(&self) -> Option<f64> {
        let rho = self.found.multiplier.filter(|rho| *rho > 0.0 && *rho < 1.0)?;
        Some(-self.period() / rho.ln())
    }

    /// The first row of every column, in the unit that is shown.
    fn starts(&self) -> impl Iterator<Item = f64> + '_ {
        self.run
            .table
            .columns()
            .iter()
            .skip(1)
            .map(|c| c.values.first().copied().unwrap_or(f64::NAN))
    }

    /// By column: start, mean, extremes and swing, temperatures in the unit that is shown.
    fn members(&self) -> Map<String, Value> {
        let unit = &self.run.task.unit;
        let seconds = |time: f64| SiValue::new(time, "s");
        let columns = self.cycle().into_iter().flat_map(|cycle| &cycle.columns).zip(self.starts());
        let member = |(seen, start): (&ColumnSeen, f64)| {
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

    /// Possible error of the temperatures of the cycle in K: that of its start, and ten tolerances
    /// of the integration.
    pub fn error(&self) -> f64 {
        self.found.error + 10.0 * self.run.task.settings.tolerance
    }

    fn search(&self) -> Value {
        let found = &self.found;
        let kelvin = |value: f64| scale::of_difference(value, &self.run.task.unit);
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
            "start_error": kelvin(found.error),
            "error": kelvin(self.error()),
            "multiplier": found.multiplier,
            "time_constant": self.slowest().map(|tau| SiValue::new(tau, "s")),
        })
    }

    /// Doubts in the numbers.
    pub fn beside(&self) -> Vec<Diagnostic> {
        let doubts = trust::doubts(&self.run.task.input.netlist, &self.run.solution.trust, true);
        proven::unproven(&self.found.solution).into_iter().chain(doubts).collect()
    }

    /// A proven bound in K on the error of a column of temperatures at all times, and on those of
    /// its extremes; `None` if there is none.
    fn bound(&self, seen: &ColumnSeen) -> Option<f64> {
        let solution = &self.found.solution;
        let id = solution.network().node(seen.name.strip_suffix(".T")?).ok()?;
        let extremes = solution.extreme_bound(id, [seen.min.0, seen.max.0])?;
        Some(solution.largest_bound(id)?.max(extremes))
    }
}
