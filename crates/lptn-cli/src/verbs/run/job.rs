//! What a run is to do, and why it cannot.

use std::path::PathBuf;

use lptn_analysis::{Answer, RunAnalysis};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::End;
use lptn_solve::{
    RecordedNodes, Selection, Solution, SteadyError, SteadyState, TransientError, Window,
};
use lptn_units::Unit;

use super::args::RunArgs;
use crate::console::Console;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input};
use lptn_answer::refused::{no_run, run_failed, time_of_run};
use lptn_answer::run::{observed, record, shown};
use lptn_answer::{balance, select};
use lptn_report::{Clock, Format};

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
        let asked = self.asked(system, steady).map_err(|error| run_failed(self.input, &error))?;
        observed(self.input, (system, &asked), &console.listening())
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
