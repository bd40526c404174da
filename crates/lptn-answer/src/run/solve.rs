//! Requested runs.

use std::sync::Arc;

use lptn_analysis::{RunAnalysis, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_netlist::Diagnostic;
use lptn_report::Format;
use lptn_solve::{
    Drawn, Lumping, RecordedNodes, RunStatus, Solution, SteadyState, Table, TransientError, Window,
};

use super::answer::RunAnswer;
use super::observed::{observed, record, shown};
use super::task::{NoSteady, RunQuestion, RunTask};
use super::uncertainty;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::{Listener, Stopwatch, timed};
use crate::refused::run_failed;

impl RunQuestion {
    /// Asks a netlist.
    /// A run that ends early is an answer with a failure: see [`RunAnswer::failed`].
    ///
    /// # Errors
    /// A question that does not fit the netlist, and a run that cannot start.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<RunAnswer, Failure> {
        let task = self.of(input)?;
        let system = task.input.assemble()?;
        task.answer(&system, listener)
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
        let begun = Stopwatch::start();
        let solved =
            timed(listener, "integrate", || self.solve(system, steady.as_ref().ok(), listener));
        let (solution, failure) = solved?;
        // bands of a run that broke off would be those of another one
        let whole = matches!(solution.end(), RunStatus::Reached);
        let asked = self.uncertainty.as_ref().filter(|_| uncertainty::IS_BUILT && whole);
        let uncertainty = asked
            .map(|asked| asked.study((&self.input, &self.settings, &self.selection), listener));
        let wall_time = begun.seconds();
        let (lumping, table) = timed(listener, "results", || {
            let table = Table::of_solution(&solution, &self.selection, &self.unit).with_bounds(
                &solution,
                &self.selection,
                &self.unit,
            );
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
    ) -> Result<(Trusted<Solution>, Option<Diagnostic>), Failure> {
        let asked = self.asked(system, steady).map_err(|error| run_failed(&self.input, &error))?;
        observed(&self.input, (system, &asked), listener)
    }

    /// The columns and times of its pictures.
    pub(crate) fn drawn(&self) -> Drawn {
        let days = self.settings.stop - self.settings.start > self.view.days_from;
        Drawn { of: self.selection.clone(), span: self.view.span, days }
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
        let mut run = match self.certify {
            true => run.certified(self.selection.clone()),
            false => run,
        };
        if self.picture {
            run = run.drawing(self.drawn());
        }
        if self.format == Format::Table {
            let selection = Some(&self.selection).filter(|_| self.chosen);
            let shown = shown(system.network(), selection, steady);
            run = run.towards((system, &shown), steady).map_err(TransientError::Start)?;
            record = record.and(shown);
        }
        let window = |window: &lptn_netlist::WindowSettings| {
            let of = self.selection.clone().and_reports(system.network().reports_over_time());
            Window { name: window.name.clone(), from: window.from, to: window.to, of }
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
