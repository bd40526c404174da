//! A run that was asked for, checked before anything is computed.

use std::sync::Arc;
use std::time::Instant;

use lptn_analysis::{Answer, RunAnalysis};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::End;
use lptn_report::{Clock, Format, TimeUnit};
use lptn_solve::{
    Lumping, RecordedNodes, RunStatus, Selection, Solution, SteadyError, SteadyState, Table,
    TransientError, Window,
};
use lptn_units::Unit;

use super::answer::RunAnswer;
use super::observed::{observed, record, shown};
use super::uncertainty::{self, UncertaintyQuestion};
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::{Listener, timed};
use crate::lumping::Detail;
use crate::refused::{no_run, run_failed, time_of_run};
use crate::{balance, select};

/// A run of a netlist, and what is shown of it.
#[derive(Clone, Debug)]
pub struct RunQuestion {
    /// The tolerance, such as `1e-7K`; `None` for that of the netlist.
    pub tolerance: Option<String>,
    /// Patterns of the columns, such as `*.T`; empty for those of the netlist.
    pub select: Vec<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
    /// The unit of times; `None` chooses one for each time.
    pub time_unit: Option<TimeUnit>,
    /// The node or boundary whose heat balance is shown.
    pub balance: Option<String>,
    /// Times at which a report draws the network, such as `10min`.
    pub at: Vec<String>,
    /// The format that will be read: a table needs peaks and the steady state, rows do not.
    pub format: Format,
    /// Whether a report is wanted: it needs every node and the steady state.
    pub report: bool,
    /// How much a table shows.
    pub detail: Detail,
    /// The uncertainty of the results, if it is asked for.
    pub uncertainty: Option<UncertaintyQuestion>,
}

impl Default for RunQuestion {
    fn default() -> Self {
        Self {
            tolerance: None,
            select: Vec::new(),
            temperature_unit: None,
            time_unit: None,
            balance: None,
            at: Vec::new(),
            format: Format::Table,
            report: false,
            detail: Detail::Brief,
            uncertainty: None,
        }
    }
}

/// Why there is no steady state to show.
#[derive(Debug)]
pub enum NoSteady {
    /// Nobody asks for it.
    NotShown,
    /// The inputs change with time.
    Inputs,
    /// The network has none.
    Network(SteadyError),
}

/// A run that is ready to start.
#[derive(Clone, Debug)]
pub struct RunTask {
    /// The netlist.
    pub input: Arc<Input>,
    /// Start, stop, rows, tolerance and windows.
    pub settings: RunSettings,
    /// The columns.
    pub selection: Selection,
    /// Whether columns were asked for by name.
    pub chosen: bool,
    /// The unit of temperatures.
    pub unit: Unit,
    /// The unit of times.
    pub clock: Clock,
    /// The format that will be read.
    pub format: Format,
    /// The node or boundary whose heat balance is shown.
    pub balance: Option<End>,
    /// Times in s at which the report draws the network.
    pub at: Vec<f64>,
    /// Whether a report is wanted.
    pub report: bool,
    /// How much a table shows.
    pub detail: Detail,
    /// The uncertainty that is asked for.
    pub uncertainty: Option<UncertaintyQuestion>,
}

impl RunQuestion {
    /// Checks the question for a netlist.
    ///
    /// # Errors
    /// A netlist without a run, and a unit, column, node or time that does not exist.
    pub fn of(&self, input: Arc<Input>) -> Result<RunTask, Failure> {
        let netlist = &input.netlist;
        let mut settings = netlist.run.clone().ok_or_else(|| no_run(&input))?;
        if let Some(text) = &self.tolerance {
            settings.tolerance = input::tolerance(text)?;
        }
        let selection = select::of_run(netlist, &self.select)?;
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), netlist)?;
        let chosen = !(self.select.is_empty() && settings.select.is_empty());
        let balance = balance::end(netlist, self.balance.as_deref(), self.format)?;
        let at = self.at.iter().map(|text| time_of_run(text, &settings));
        let at = at.collect::<Result<_, _>>()?;
        uncertainty::check(self.uncertainty.as_ref(), &input)?;
        let (clock, uncertainty) = (Clock(self.time_unit), self.uncertainty.clone());
        let Self { format, report, detail, .. } = *self;
        Ok(RunTask {
            input,
            settings,
            selection,
            chosen,
            unit,
            clock,
            format,
            balance,
            at,
            report,
            detail,
            uncertainty,
        })
    }
}

impl RunTask {
    /// Runs to the stop, to the first failure or to an interruption. The rows up to then are whole:
    /// [`RunAnswer::failed`] gives the failure.
    ///
    /// # Errors
    /// A run that cannot start.
    pub fn answer(
        self,
        system: &ThermalSystem,
        listener: &dyn Listener,
    ) -> Result<RunAnswer, Failure> {
        // only tables and reports show it
        let steady = match self.format == Format::Table || self.report {
            true => timed(listener, "steady", || steady(system, self.settings.start)),
            false => Err(NoSteady::NotShown),
        };
        let begun = Instant::now();
        let solved =
            timed(listener, "integrate", || self.solve(system, steady.as_ref().ok(), listener));
        let (solution, failure) = solved?;
        // bands of a run that broke off would be those of another one
        let whole = matches!(solution.end(), RunStatus::Reached);
        let asked = self.uncertainty.as_ref().filter(|_| whole);
        let uncertainty = asked.map(|asked| asked.study(&self, listener));
        let wall_time = begun.elapsed().as_secs_f64();
        let (lumping, table) = timed(listener, "results", || {
            let table = Table::of_solution(&solution, &self.selection, &self.unit);
            (Lumping::of_run(&solution), table)
        });
        Ok(RunAnswer {
            task: self,
            steady,
            solution,
            lumping,
            failure,
            wall_time,
            uncertainty,
            table,
        })
    }

    fn solve(
        &self,
        system: &ThermalSystem,
        steady: Option<&SteadyState>,
        listener: &dyn Listener,
    ) -> Result<(Answer<Solution>, Option<Diagnostic>), Failure> {
        let asked = self.asked(system, steady).map_err(|error| run_failed(&self.input, &error))?;
        observed(&self.input, (system, &asked), listener)
    }

    fn asked(
        &self,
        system: &ThermalSystem,
        steady: Option<&SteadyState>,
    ) -> Result<RunAnalysis, TransientError> {
        let run = RunAnalysis::of(system.network(), &self.settings);
        let mut record = record(system.network(), &self.selection);
        if self.report {
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

fn steady(system: &ThermalSystem, start: f64) -> Result<SteadyState, NoSteady> {
    if !system.network().changing_inputs().is_empty() {
        return Err(NoSteady::Inputs);
    }
    Ok(lptn_analysis::steady(system, start).map_err(NoSteady::Network)?.result)
}
