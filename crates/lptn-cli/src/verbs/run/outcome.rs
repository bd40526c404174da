//! What came of a run: files, the result on stdout, messages on stderr, the exit code.

use std::borrow::Cow;

use lptn_analysis::{Answer, LimitResult};
use lptn_answer::{bound, gaps};
use lptn_netlist::Diagnostic;
use lptn_network::Parameter;
use lptn_report::{Format, WIDTH, duration, labelled, words, write_csv, write_rows};
use lptn_solve::{Lumping, Method, RunStatus, Solution, SteadyState, Table};
use lptn_study::{
    FileHash, LedgerRecord, Manifest, ParameterRecord, RunEnd, SiValue, StatisticsRecord, Sundials,
};
use serde_json::{Map, Value};

use super::job::{Job, NoSteady};
use super::uncertainty::{Study, elsewhere, files as uncertain};
use super::{events, next, state, windows};
use crate::console::{Console, Detail};
use crate::files;
use crate::files::Folder;
use crate::files::names::{EVENTS, MANIFEST, RANKING, RESULT, STATE, UNCERTAINTY, WINDOWS};
use crate::verdict;
use lptn_answer::about;
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::quoted;
use lptn_answer::limits;
use lptn_answer::select;
use lptn_answer::words::unverified_names;
use lptn_answer::{lumping, ranges, scale, trust};

/// What came of it.
pub(crate) struct Outcome<'a> {
    pub(crate) job: Job<'a>,
    pub(crate) steady: Result<SteadyState, NoSteady>,
    pub(crate) solution: Answer<Solution>,
    /// How far its nodes are lumps.
    pub(crate) lumping: Lumping,
    /// Why the run broke off.
    pub(crate) failure: Option<Diagnostic>,
    pub(crate) wall_time: f64,
    /// How long its parts took, in s.
    pub(crate) phases: Vec<(&'static str, f64)>,
    /// How sure it is, where that was asked.
    pub(crate) uncertainty: Option<Result<Study, Failure>>,
    /// The selected columns, in the unit that is shown.
    pub(crate) table: Table,
    /// Whether more is told of the solver.
    pub(crate) detail: Detail,
}

impl Outcome<'_> {
    /// Writes the files: all of them take their places together, the manifest last.
    pub(crate) fn write(&self, folder: &Folder) -> Result<(), Failure> {
        let mut files = folder.batch();
        files.write(RESULT, |out| write_csv(&self.shown_table(), out))?;
        let state = state::of(self.job.input, &self.solution);
        files.write(STATE, |out| state.write(out))?;
        let events = events::rows(&self.solution);
        files.write(EVENTS, |out| write_rows(&events, out))?;
        let seen = self.solution.windows();
        if !seen.is_empty() {
            let rows = windows::rows(seen, &self.job.unit);
            files.write(WINDOWS, |out| write_rows(&rows, out))?;
        }
        if let Some(study) = self.uncertainty() {
            let network = self.solution.network();
            let bands = self.bands(study);
            files.write(UNCERTAINTY, |out| write_csv(&bands, out))?;
            let ranking = uncertain::ranking(network, &study.found);
            files.write(RANKING, |out| write_csv(&ranking, out))?;
        }
        let manifest = self.manifest(files.written().to_vec());
        files.write(MANIFEST, |out| out.write_all(manifest.text()?.as_bytes()))?;
        files.commit(&[EVENTS, WINDOWS, UNCERTAINTY, RANKING])
    }

    pub(super) fn manifest(&self, results: Vec<FileHash>) -> Manifest {
        let settings = &self.job.settings;
        Manifest {
            format: 1,
            lptn: env!("CARGO_PKG_VERSION").to_owned(),
            sundials: Sundials::linked(),
            arguments: files::arguments(),
            inputs: about::hashes(&self.job.input.netlist),
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
            environment: files::environment(self.wall_time, &self.phases),
        }
    }

    fn parameters(&self) -> Map<String, Value> {
        let (network, set) = (self.solution.network(), self.job.set);
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

    /// How sure the result is, where that was asked and is known.
    pub(super) fn uncertainty(&self) -> Option<&Study> {
        self.uncertainty.as_ref()?.as_ref().ok()
    }

    /// How the limits fared.
    pub(crate) fn limits(&self) -> Vec<LimitResult> {
        self.solution.limits().iter().map(LimitResult::of_run).collect()
    }

    /// Where laws were not known.
    pub(crate) fn out_of_range(&self) -> Option<Vec<Value>> {
        ranges::members(self.solution.network(), self.solution.out_of_range(), true)
    }

    /// The ledger up to the time that was reached.
    pub(crate) fn ledger(&self) -> LedgerRecord {
        LedgerRecord::new(self.solution.network(), self.solution.ledger())
    }

    /// Why the run did not reach its stop.
    pub(super) fn ended_early(&self) -> Option<String> {
        match (self.solution.end(), &self.failure) {
            (_, Some(problem)) => Some(problem.message.clone()),
            (RunStatus::Interrupted(time), None) => {
                Some(format!("interrupted at {}", duration(time, 4)))
            }
            _ => None,
        }
    }

    /// What the rows show to be wrong with reports, and with nodes that are not lumps.
    pub(crate) fn found(&self) -> Vec<Diagnostic> {
        let netlist = &self.job.input.netlist;
        let certain = self.uncertainty().map_or_else(Vec::new, |_| elsewhere(netlist));
        let lumps = lumping::warnings(netlist, &self.lumping);
        let beyond = trust::doubts(netlist, &self.solution.trust, true);
        gaps(netlist, &self.table).into_iter().chain(beyond).chain(lumps).chain(certain).collect()
    }

    /// What a reader should know of the numbers; the table says it in its notes.
    pub(super) fn doubts(&self) -> Vec<Diagnostic> {
        bound::doubts(&self.solution)
    }

    /// The rows with their times in the unit that was asked for.
    pub(crate) fn shown_table(&self) -> Cow<'_, Table> {
        match self.job.clock.0 {
            None => Cow::Borrowed(&self.table),
            Some(_) => Cow::Owned(self.in_its_unit(self.table.clone())),
        }
    }

    fn in_its_unit(&self, table: Table) -> Table {
        match self.job.clock.0 {
            None => table,
            Some(unit) => table.with_times_in(unit.symbol(), unit.seconds()),
        }
    }

    /// The bands of a study, as rows.
    pub(crate) fn bands(&self, study: &Study) -> Table {
        let network = self.solution.network();
        self.in_its_unit(uncertain::bands(network, &study.found, &self.job.unit))
    }

    /// The limits, and how they are shown.
    pub(crate) fn judgement<'b>(&'b self, limits: &'b [LimitResult]) -> limits::Judgement<'b> {
        let (netlist, unit) = (&self.job.input.netlist, &self.job.unit);
        limits::Judgement { netlist, unit, clock: self.job.clock, limits }
    }

    /// Says which limits are broken, and gives the exit code.
    pub(crate) fn judge(&self, console: &Console) -> Exit {
        verdict::conclude(&self.judgement(&self.limits()), console)
    }

    /// Whether large families are shown as one row.
    pub(crate) fn folds(&self) -> bool {
        !self.job.chosen && self.detail < Detail::Verbose
    }

    /// What is worth knowing beside the result, on stderr.
    pub(crate) fn messages(&self, folder: Option<&Folder>, console: &Console) {
        if let Some(folder) = folder {
            let path = folder.path().join(RESULT);
            let took = duration(self.wall_time, 2);
            let rows = self.table.rows();
            let windows = if self.solution.windows().is_empty() { "" } else { ", windows.csv" };
            let bands =
                if self.uncertainty().is_some() { ", uncertainty.csv, ranking.csv" } else { "" };
            let files =
                format!("{}{bands}, {EVENTS}{windows}, {STATE}, {MANIFEST}", path.display());
            let mut pieces = words(&files);
            pieces.push(format!("({rows} rows, solved in {took})"));
            console.note(&labelled("wrote  ", &pieces, WIDTH).join("\n"));
        }
        if console.verbose {
            console.note(&labelled("work   ", &work(&self.solution), WIDTH).join("\n"));
        }
        if let Some(hidden) = select::hidden(&self.job.input.netlist).filter(|_| !self.job.chosen) {
            console.note(&hidden);
        }
        if self.job.format != Format::Table {
            console.warn(&self.job.input.netlist.files, &self.doubts());
        }
        console.warn(&self.job.input.netlist.files, &self.found());
        if self.job.format == Format::Table && self.solution.end() == RunStatus::Reached {
            if let Some(folder) = folder {
                console
                    .next(&format!("lptn plot {}", quoted(&folder.path().display().to_string())));
            }
            let limits = self.limits();
            let hot =
                limits.iter().find_map(|limit| limits::broken_node(limit, self.solution.network()));
            next::after_run(self.job.input, self.steady.is_ok(), hot)
                .iter()
                .for_each(|command| console.next(command));
        }
    }

    /// Why this is not a whole result, where it is not.
    pub(super) fn failed(&self) -> Option<Failure> {
        let at = |exit, problem| Failure::at(exit, self.job.input.netlist.files.clone(), problem);
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

    /// The exit code, after saying why it is not 0.
    pub(crate) fn conclude(&self, console: &Console, files: bool) -> Exit {
        let kept = if files {
            "the rows up to then are whole, and marked in the manifest"
        } else {
            "the rows up to then are whole"
        };
        if let Some(failure) = self.failed() {
            match (&self.failure, self.ended_early()) {
                (None, Some(message)) => console.message(&format!("{message}: {kept}")),
                (broken_off, _) => {
                    console.report(&failure.files, &failure.diagnostics);
                    let said = broken_off.iter().map(|_| format!("failed: {kept}"));
                    said.for_each(|said| console.message(&said));
                }
            }
            return failure.exit;
        }
        self.judge(console)
    }
}

/// What the integrator did.
fn work(solution: &Solution) -> Vec<String> {
    let done = solution.statistics();
    let repeated = done.error_test_failures + done.newton_failures;
    let counts = [
        (done.steps, "steps"),
        (repeated, "repeated"),
        (done.restarts, "restarts"),
        (done.flow_evaluations, "heat flows"),
        (done.jacobian_evaluations, "Jacobians"),
        (done.linear_setups, "set-ups"),
        (done.factorizations, "factorisations"),
        (done.linear_solves, "solves"),
        (done.linear_iterations, "iterations"),
    ];
    let counts = counts.iter().map(|(count, of)| format!("{count} {of},"));
    counts.chain([format!("{} numbers in the factors", done.fill)]).collect()
}
