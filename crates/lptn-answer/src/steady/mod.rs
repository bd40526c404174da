//! Steady states.

mod doubts;
mod page;

use std::sync::Arc;

use lptn_analysis::{LimitResult, Trusted};
use lptn_netlist::{Diagnostic, Files};
use lptn_report::{Clock, Format};
use lptn_solve::{Balance, SteadyColumns, SteadyError, SteadyState, Table, Uncertified};
use lptn_units::Unit;

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::limits::{Judgement, Verdict};
use crate::listener::{Listener, timed};
use crate::lumping::Detail;
use crate::refused::steady_failed;
use crate::{balance, proven, select, trust};

pub use doubts::{adiabatic, inputs_vary, others};

/// Asks for the steady state of a network.
#[derive(Clone, Debug)]
pub struct SteadyQuestion {
    /// Patterns of the columns, such as `*.T`; empty for all.
    pub select: Vec<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
    /// The node or boundary whose heat balance is shown.
    pub balance: Option<String>,
    /// The format that will be read.
    pub format: Format,
    /// Amount of detail in a table.
    pub detail: Detail,
    /// True if errors are bounded with proof.
    pub certify: bool,
}

impl Default for SteadyQuestion {
    fn default() -> Self {
        Self {
            select: Vec::new(),
            temperature_unit: None,
            balance: None,
            format: Format::Table,
            detail: Detail::Brief,
            certify: false,
        }
    }
}

/// A steady state.
#[derive(Debug)]
pub struct SteadyAnswer {
    /// The netlist.
    pub input: Arc<Input>,
    /// Temperatures, heat flows, and how far they can be trusted.
    pub steady: Trusted<SteadyState>,
    /// The selected columns, in the unit that is shown.
    pub table: Table,
    /// The unit of temperatures.
    pub unit: Unit,
    /// Results of the limits, in the order of the netlist.
    pub limits: Vec<LimitResult>,
    /// The heat balance that was requested.
    pub balance: Option<Balance>,
    /// True if no columns were selected.
    pub all: bool,
    /// True if large families are one row.
    fold: bool,
    /// Proven bounds on the error of each node in K, if they were requested.
    pub proven: Option<Result<Vec<f64>, Uncertified>>,
}

impl SteadyQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A unit, column or node that does not exist, and a network without a steady state.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<SteadyAnswer, Failure> {
        let netlist = &input.netlist;
        let selection = match self.select.as_slice() {
            [] => None,
            patterns => Some(select::of_option(netlist, patterns)?),
        };
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), netlist)?;
        let balance = balance::end(netlist, self.balance.as_deref(), self.format)?;
        let system = timed(listener, "assemble", || input.assemble())?;
        let start = netlist.run.as_ref().map_or(0.0, |run| run.start);
        let steady = timed(listener, "solve", || lptn_analysis::steady(&system, start));
        let steady = steady.map_err(|error| steady_failed(&input, &error))?;
        let network = &netlist.network;
        let unread = |error| steady_failed(&input, &SteadyError::Input(error));
        let limits = LimitResult::of_steady(network, &steady).map_err(unread)?;
        let columns = match &selection {
            Some(selection) => Arc::new(SteadyColumns::of(network, selection, &unit)),
            None => input.columns.of(netlist, &unit, || select::all(netlist)),
        };
        let table = columns.table(network, &steady).map_err(unread)?;
        let balance = balance.map(|of| steady.balance(network, of));
        let all = self.select.is_empty();
        let fold = all && self.detail < Detail::Verbose;
        let proven = self.certify.then(|| steady.proven_errors(&system));
        let limits = match &proven {
            Some(Ok(bounds)) => {
                LimitResult::with_proofs(limits, steady.proven_margins(&system, bounds))
            }
            _ => limits,
        };
        Ok(SteadyAnswer { steady, table, unit, limits, balance, all, fold, proven, input })
    }
}

impl Answer for SteadyAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.noted(), &self.beside()].concat()
    }

    fn reasons(&self) -> Vec<String> {
        Verdict::of(&self.judgement()).broken
    }

    fn exit(&self) -> Exit {
        if Verdict::of(&self.judgement()).holds() { Exit::Done } else { Exit::No }
    }
}

impl SteadyAnswer {
    /// The limits, and how they are shown.
    pub fn judgement(&self) -> Judgement<'_> {
        let (netlist, unit, limits) = (&self.input.netlist, &self.unit, &self.limits);
        Judgement { netlist, unit, clock: Clock::default(), limits, fold: self.fold }
    }

    /// Doubts that a table has as notes: inputs that change, other steady states.
    pub fn noted(&self) -> Vec<Diagnostic> {
        let (netlist, file) = (&self.input.netlist, self.input.typed());
        let vary = inputs_vary((netlist, file.as_deref()), &self.steady, &self.limits);
        let adiabatic = adiabatic(&netlist.network, &self.steady);
        let others = others(&netlist.network, &self.steady, &self.unit);
        let unproven =
            self.proven.iter().filter_map(|proven| Some(proven::doubt(proven.as_ref().err()?)));
        vary.into_iter().chain(adiabatic).chain(others).chain(unproven).collect()
    }

    /// Doubts in the numbers, which no table shows.
    pub fn beside(&self) -> Vec<Diagnostic> {
        trust::doubts(&self.input.netlist, &self.steady.trust, false)
    }
}
