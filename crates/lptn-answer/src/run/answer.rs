//! A run as an answer: its tables, doubts, limits and manifest.

use std::borrow::Cow;

use lptn_analysis::{LimitResult, Trusted};
use lptn_netlist::{Diagnostic, Files, SavedState};
use lptn_network::Parameter;
use lptn_report::{Text, duration};
use lptn_solve::{Beyond, Lumping, Method, RunStatus, Solution, SteadyState, Table};
use lptn_study::{
    Environment, FileHash, LedgerRecord, Manifest, ParameterRecord, RunEnd, SiValue,
    StatisticsRecord, Sundials,
};
use serde_json::{Map, Value};

use super::task::{NoSteady, RunTask};
use super::uncertainty::{IS_BUILT, Study, elsewhere, files as uncertain};
use super::{events, next, state, windows};
use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::limits::{self, Verdict};
use crate::lumping::Detail;
use crate::words::unverified_names;
use crate::{about, bound, gaps, lumping, over_time, proven, ranges, scale, trust};

/// A run, as far as it came.
#[derive(Debug)]
pub struct RunAnswer {
    /// The checked question.
    pub task: RunTask,
    /// The steady state of the same inputs.
    pub steady: Result<SteadyState, NoSteady>,
    /// Temperatures, heat flows, energy balance, and how far they can be trusted.
    pub solution: Trusted<Solution>,
    /// Biot numbers and diffusion times of its nodes.
    pub lumping: Lumping,
    /// Why the run broke off.
    pub failure: Option<Diagnostic>,
    /// Duration of the integration in s.
    pub wall_time: f64,
    /// The uncertainty of the results, if it was requested.
    pub uncertainty: Option<Result<Study, Failure>>,
    /// The selected columns, in the unit that is shown.
    pub table: Table,
}

impl Answer for RunAnswer {
    fn files(&self) -> &Files {
        &self.task.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        let warnings = &self.task.input.netlist.warnings;
        [warnings.as_slice(), &self.bounds(), &self.found()].concat()
    }

    fn reasons(&self) -> Vec<String> {
        self.verdict().broken
    }

    fn exit(&self) -> Exit {
        match self.failed() {
            Some(failure) => failure.exit,
            None if self.verdict().holds() => Exit::Done,
            None => Exit::No,
        }
    }
}

impl RunAnswer {
    /// Record of the result: versions, inputs, parameters, counters, energy balance, limits.
    /// `results` are the files written, only `environment` changes from run to run.
    pub fn manifest(&self, results: Vec<FileHash>, environment: Environment) -> Manifest {
        let settings = &self.task.settings;
        Manifest {
            format: 1,
            lptn: env!("CARGO_PKG_VERSION").to_owned(),
            sundials: Sundials::linked(),
            arguments: self.task.input.command.clone(),
            inputs: about::hashes(&self.task.input.netlist),
            parameters: self.parameters(),
            start: SiValue::new(settings.start, "s"),
            stop: SiValue::new(settings.stop, "s"),
            tolerance: SiValue::new(settings.tolerance, "K"),
            integrator: self.solution.method().map(Method::name),
            end: RunEnd::of(&self.solution, settings.stop, self.ended_early()),
            statistics: StatisticsRecord::new(&self.solution),
            ledger: self.ledger(),
            limits: limits::members(self.solution.network(), &self.limits(), &scale::kelvin())
                .unwrap_or_default(),
            unverified_constants: unverified_names(self.solution.network()),
            out_of_range: self.out_of_range(),
            uncertainty: self.uncertainty().map(|study| {
                let of = (self.solution.network(), &scale::kelvin());
                Value::Object(uncertain::given(of, &study.found))
            }),
            results,
            environment,
        }
    }

    /// The state at the end, for another run to start from.
    pub fn state(&self) -> SavedState<'_> {
        state::of(&self.task.input, &self.solution)
    }

    /// The rows of `events.csv`, the heading first.
    pub fn events(&self) -> Vec<Vec<String>> {
        events::rows(&self.solution)
    }

    /// The rows of `windows.csv`, the heading first; `None` without windows.
    pub fn windows(&self) -> Option<Vec<Vec<String>>> {
        let seen = self.solution.windows();
        (!seen.is_empty()).then(|| windows::rows(seen, &self.task.unit))
    }

    /// The rows of `reports.csv`, the heading first; `None` without numbers over time.
    pub fn reports_over_time(&self) -> Option<Vec<Vec<String>>> {
        let (solution, start) = (&self.solution, self.task.settings.start);
        let stop = match solution.end() {
            RunStatus::Reached => self.task.settings.stop,
            RunStatus::Interrupted(time) | RunStatus::Failed(time) => time,
        };
        let of = (solution.network(), solution.reports_over_time());
        over_time::rows(of, ((start, stop), solution.windows()), &self.task.unit)
    }

    /// A section with the numbers over time.
    pub(crate) fn over_time(&self, text: &mut Text, heading: &str) {
        let of = (self.solution.network(), self.solution.reports_over_time());
        over_time::section(text, of, (heading, &self.task.unit));
    }

    /// The rows of `uncertainty.csv` and of `ranking.csv`, if an uncertainty is known.
    pub fn uncertainties(&self) -> Option<[Table; 2]> {
        let study = self.uncertainty()?;
        let ranking = uncertain::ranking(self.solution.network(), &study.found);
        Some([self.bands(study), ranking])
    }

    fn parameters(&self) -> Map<String, Value> {
        let (network, set) = (self.solution.network(), &self.task.input.set);
        let set = |name: &str| {
            let mut assigned = set.iter().filter_map(|text| text.split_once('='));
            assigned.find(|(left, _)| left.trim() == name).map(|(_, right)| right.trim().to_owned())
        };
        let record = |(parameter, id): (&Parameter, _)| {
            let unit = parameter.ty.dimension.si_unit();
            let value = network.parameter_value(id);
            ParameterRecord { name: parameter.name.clone(), value, unit, set: set(&parameter.name) }
                .member()
        };
        network.parameters().iter().zip(network.parameter_ids()).map(record).collect()
    }

    /// The uncertainty of the results, if it was requested and is known.
    pub fn uncertainty(&self) -> Option<&Study> {
        self.uncertainty.as_ref().filter(|_| IS_BUILT)?.as_ref().ok()
    }

    /// Results of the limits, in the order of the netlist.
    pub fn limits(&self) -> Vec<LimitResult> {
        self.solution.limits().iter().map(LimitResult::of_run).collect()
    }

    /// Laws outside their ranges.
    pub(crate) fn out_of_range(&self) -> Option<Vec<Value>> {
        ranges::members(self.solution.network(), self.solution.out_of_range(), true)
    }

    /// The ledger up to the time that was reached.
    pub(crate) fn ledger(&self) -> LedgerRecord {
        LedgerRecord::new(self.solution.network(), self.solution.ledger())
    }

    /// Why the run did not reach its stop.
    pub fn ended_early(&self) -> Option<String> {
        match (self.solution.end(), &self.failure) {
            (_, Some(problem)) => Some(problem.message.clone()),
            (RunStatus::Interrupted(time), None) => {
                Some(format!("interrupted at {}", duration(time, 4)))
            }
            _ => None,
        }
    }

    /// Doubts that no table shows.
    /// Gaps in reports, implausible values, laws outside their ranges, nodes that are not lumps.
    pub fn found(&self) -> Vec<Diagnostic> {
        let netlist = &self.task.input.netlist;
        let certain = self.uncertainty().map_or_else(Vec::new, |_| elsewhere(netlist));
        let lumps = lumping::warnings(netlist, &self.lumping);
        let beyond = trust::doubts(netlist, &self.solution.trust, true);
        let steady = self.implausible_steady();
        let all = gaps(netlist, &self.table).into_iter().chain(beyond).chain(steady);
        all.chain(lumps).chain(certain).collect()
    }

    /// A steady state that no material stands, if the run itself is plausible.
    fn implausible_steady(&self) -> Option<Diagnostic> {
        let steady = self.steady.as_ref().ok().filter(|_| self.solution.trust.beyond.is_none())?;
        let beyond = Beyond::of_steady(self.solution.network(), steady)?;
        Some(trust::implausible(&self.task.input.netlist, &beyond, true))
    }

    /// Errors that are not bounded; a table has them in its notes.
    pub fn bounds(&self) -> Vec<Diagnostic> {
        let unproven = proven::unproven(&self.solution);
        let doubts = bound::doubts(&self.solution, proven::is(&self.solution));
        unproven.into_iter().chain(doubts).collect()
    }

    /// The rows with their times in the requested unit.
    pub fn shown_table(&self) -> Cow<'_, Table> {
        match self.task.clock.0 {
            None => Cow::Borrowed(&self.table),
            Some(_) => Cow::Owned(self.in_its_unit(self.table.clone())),
        }
    }

    fn in_its_unit(&self, table: Table) -> Table {
        match self.task.clock.0 {
            None => table,
            Some(unit) => table.with_times_in(unit.symbol(), unit.seconds()),
        }
    }

    /// The bands of a study, as rows.
    pub(super) fn bands(&self, study: &Study) -> Table {
        let network = self.solution.network();
        self.in_its_unit(uncertain::bands(network, &study.found, &self.task.unit))
    }

    /// The limits, and how they are shown.
    pub fn judgement<'b>(&'b self, limits: &'b [LimitResult]) -> limits::Judgement<'b> {
        let (netlist, unit) = (&self.task.input.netlist, &self.task.unit);
        limits::Judgement { netlist, unit, clock: self.task.clock, limits, fold: self.folds() }
    }

    /// The verdict on the limits.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(&self.judgement(&self.limits()))
    }

    /// True if large families are shown as one row.
    pub(crate) fn folds(&self) -> bool {
        !self.task.chosen && self.task.detail < Detail::Verbose
    }

    /// Commands to try next; none if the run did not reach its stop.
    pub fn next(&self) -> Option<String> {
        let reached = self.solution.end() == RunStatus::Reached;
        let limits = self.limits();
        let hot = |limit| limits::broken_node(limit, self.solution.network());
        let hot = limits.iter().find_map(hot);
        let next = || next::after_run(&self.task.input, self.steady.is_ok(), hot);
        reached.then(next).flatten()
    }

    /// The failure, if this is not a whole result.
    pub fn failed(&self) -> Option<Failure> {
        let at = |exit, problem| Failure::at(exit, self.task.input.netlist.files.clone(), problem);
        if let Some(problem) = &self.failure {
            return Some(at(Exit::Failed, problem.clone()));
        }
        if let Some(message) = self.ended_early() {
            return Some(at(Exit::Interrupted, Diagnostic::error("run::interrupted", message)));
        }
        if let Err(open) = self.solution.ledger().check() {
            return Some(at(Exit::Failed, told(&open)));
        }
        self.uncertainty.as_ref()?.as_ref().err().cloned()
    }
}
