//! A requested run, checked in advance.

use std::sync::Arc;

use lptn_netlist::RunSettings;
use lptn_network::End;
use lptn_plot::LONG;
use lptn_report::{Clock, Format, TimeUnit};
use lptn_solve::{Selection, SteadyError};
use lptn_units::Unit;

use super::uncertainty::{self, UncertaintyQuestion};
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::lumping::Detail;
use crate::refused::{no_run, time_of_run};
use crate::{balance, select};

/// A run of a netlist, and the parts of it that are shown.
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
    /// True if a report is wanted: it needs every node and the steady state.
    pub report: bool,
    /// True if the run is drawn: its columns are read on both sides of jumps too.
    pub picture: bool,
    /// The part of it that is drawn.
    pub view: View,
    /// Amount of detail in a table.
    pub detail: Detail,
    /// The uncertainty of the results, if it is requested.
    pub uncertainty: Option<UncertaintyQuestion>,
    /// True if errors are bounded with proof.
    pub certify: bool,
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
            picture: false,
            view: View::default(),
            detail: Detail::Brief,
            uncertainty: None,
            certify: false,
        }
    }
}

/// The part of a run that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Its first and last time in s.
    pub span: (f64, f64),
    /// The run in s from which means of days are shown, which a report does by itself.
    pub days_from: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { span: (f64::NEG_INFINITY, f64::INFINITY), days_from: f64::INFINITY }
    }
}

impl View {
    /// The view of a page, which shows months by days.
    #[must_use]
    pub fn of_page() -> Self {
        Self { days_from: LONG, ..Self::default() }
    }
}

/// Why there is no steady state to show.
#[derive(Debug)]
pub enum NoSteady {
    /// It was not requested.
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
    /// True if columns were requested by name.
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
    /// True if a report is wanted.
    pub report: bool,
    /// True if it is drawn.
    pub picture: bool,
    /// The part of it that is drawn.
    pub view: View,
    /// Amount of detail in a table.
    pub detail: Detail,
    /// The uncertainty that is requested.
    pub uncertainty: Option<UncertaintyQuestion>,
    /// True if errors are bounded with proof.
    pub certify: bool,
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
        let Self { format, report, detail, certify, .. } = *self;
        let picture = self.picture || report;
        let page = if report { LONG } else { f64::INFINITY };
        let view = View { days_from: self.view.days_from.min(page), ..self.view };
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
            picture,
            view,
            detail,
            uncertainty,
            certify,
        })
    }
}
