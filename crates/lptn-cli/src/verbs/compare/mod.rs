//! `lptn compare`

mod args;
mod doubts;
mod figure;
mod page;
mod variants;

pub(crate) use args::CompareArgs;
pub(crate) use variants::{Variant, of_sets};

use std::path::{Path, PathBuf};

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files, Netlist};
use lptn_report::{Format, plain};
use lptn_solve::Progress;
use lptn_solve::{available_threads, in_parallel};
use lptn_study::{Candidate, CompareError, CompareRow, order};
use lptn_units::Unit;

use crate::console::Console;
use crate::files;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressOfAll;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input, quoted};
use lptn_answer::steady::others;
use lptn_answer::words::unverified;
use lptn_answer::{bound, trust};

pub(crate) fn compare(args: &CompareArgs, console: &Console) -> Result<Exit, Failure> {
    let files = listed(&args.files)?;
    let threads = args.threads.unwrap_or_else(available_threads);
    let jobs = jobs(args, &files)?;
    let belief = args.posterior.as_deref().map_or(Belief::Named, Belief::Shared);
    let loaded = in_parallel(&jobs, threads, |(file, variant)| load(file, variant, &belief));
    used(&args.set, &loaded)?;
    believed(args, &loaded)?;
    let mut done = evaluate_all(&loaded, (args.periodic, threads), console);
    let unsure = if args.uncertainty { doubtful(&loaded, &mut done, threads) } else { Vec::new() };
    let unit = unit(args, &loaded)?;
    let candidates: Vec<_> = done.iter().map(|outcome| outcome.as_ref().ok()).collect();
    let places = order(&candidates, args.sort);
    let mut outcomes: Vec<_> = loaded.into_iter().zip(done).map(Some).collect();
    let sorted = places.into_iter().filter_map(|place| outcomes[place].take());
    let comparison = Comparison::of(sorted, unit);
    comparison.report(console);
    console.warn(&Files::new(), &unsure);
    console.show(&comparison, args.printed.format)?;
    let answer = page::answer(&comparison);
    if comparison.rows.iter().filter_map(CompareRow::candidate).count() > 1
        && args.printed.format == Format::Table
        && jobs.iter().all(|(_, variant)| variant.label.is_empty())
    {
        let read = comparison.rows.iter().filter(|row| row.candidate().is_some());
        let names: Vec<String> = read.map(|row| quoted(&row.file)).collect();
        console.next(&format!("lptn plot {}", names.join(" ")));
    }
    match comparison.exit() {
        Exit::Done => console.note(&answer),
        _ => console.message(&answer),
    }
    Ok(comparison.exit())
}

/// Every file once, folders as their netlists in alphabetical order.
pub(crate) fn listed(given: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files: Vec<PathBuf> = Vec::new();
    for path in given {
        let found = if path.is_dir() { folder(path)? } else { vec![path.clone()] };
        let new: Vec<PathBuf> = found.into_iter().filter(|file| !files.contains(file)).collect();
        files.extend(new);
    }
    Ok(files)
}

fn folder(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let found = files::of_folder(path, "toml", "name the netlists one by one")?;
    if found.is_empty() {
        let message = format!("there is no netlist in the folder {}", path.display());
        let problem = Diagnostic::error("input::cannot_read", message);
        return Err(Failure::new(Exit::Input, problem.help("netlists end with .toml")));
    }
    Ok(found)
}

/// Every file with every variant of it.
fn jobs(args: &CompareArgs, files: &[PathBuf]) -> Result<Vec<(PathBuf, Variant)>, Failure> {
    let sets = of_sets(&args.set).ok_or_else(|| too_many("--set"))?;
    let mut jobs = Vec::new();
    for file in files {
        let all = variants::with_parts(file, &args.parts, &sets)?;
        let all = all.ok_or_else(|| too_many("--parts"))?;
        let all = if args.cases { variants::in_cases(file, &all) } else { all };
        jobs.extend(all.into_iter().map(|variant| (file.clone(), variant)));
    }
    Ok(jobs)
}

pub(crate) fn too_many(option: &str) -> Failure {
    let message = format!("`{option}` makes more than {} variants", variants::MOST);
    let problem = Diagnostic::error("compare::too_many", message);
    Failure::new(Exit::Input, problem.help("give fewer values, or compare in several steps"))
}

/// A candidate's file, and its netlist or what is wrong with it.
pub(crate) struct Loaded {
    file: String,
    pub(crate) input: Result<Input, Failure>,
    /// For each `--set` whether this candidate has the parameter.
    has: Vec<bool>,
}

pub(crate) fn load(file: &Path, variant: &Variant, belief: &Belief<'_>) -> Loaded {
    let (set, case) = (&variant.set, variant.case.clone());
    let source = Source { case, ..Source::of(file.to_owned()) };
    let name = match variant.label.as_str() {
        "" => file.display().to_string(),
        label => format!("{} ({label})", file.display()),
    };
    let mut input = match Input::load_from(&source, belief) {
        Ok(input) => input,
        Err(failure) => {
            return Loaded { file: name, input: Err(failure), has: vec![false; set.len()] };
        }
    };
    let network = &input.netlist.network;
    // a text without `=` is for `set` to refuse
    let has_it = |text: &String| {
        text.split_once('=').is_none_or(|(left, _)| network.parameter(left.trim()).is_ok())
    };
    let has: Vec<bool> = set.iter().map(has_it).collect();
    let own: Vec<String> =
        set.iter().zip(&has).filter(|(_, has)| **has).map(|(text, _)| text.clone()).collect();
    let outcome = input.netlist.set(&own);
    Loaded { file: name, input: outcome.map(|()| input).map_err(Failure::from), has }
}

/// Without a run a candidate is looked at once: what comes later is not seen.
fn inputs_vary(netlist: &Netlist, name: &str) -> Option<Diagnostic> {
    let network = &netlist.network;
    let judged: Vec<_> =
        network.limits().iter().flat_map(|limit| [&limit.of, &limit.value]).collect();
    let changes =
        || !network.changing_inputs().is_empty() || !network.changing_inputs_of(&judged).is_empty();
    let vary = netlist.run.is_none() && changes();
    let message = format!(
        "{name}: the inputs change with time; without a [run] they are taken at 0 s, and no limit \
         is judged that depends on them"
    );
    vary.then(|| {
        Diagnostic::warning("steady::inputs_vary", message).help("add a [run] to compare over time")
    })
}

/// Why a candidate whose signals repeat themselves has no settled cycle.
fn unsettled(file: &str, found: &Candidate) -> Option<Diagnostic> {
    let reason = found.settled.as_ref()?.as_ref().err()?;
    let message = format!("{file}: the column `settled` is empty: {reason}");
    Some(Diagnostic::warning(reason.code(), message).help(reason.help()))
}

/// A `--set` that no candidate can use is a mistake, unless a candidate that could not be read may
/// be meant.
pub(crate) fn used(set: &[String], loaded: &[Loaded]) -> Result<(), Failure> {
    let all_read = loaded.iter().all(|one| one.input.is_ok());
    let idle = (0..set.len()).find(|&i| loaded.iter().all(|one| !one.has[i]));
    let (Some(i), true) = (idle, all_read) else { return Ok(()) };
    let name = set[i].split('=').next().unwrap_or_default().trim();
    let message = format!("no candidate has a parameter `{name}`");
    let mut names: Vec<&str> = loaded
        .iter()
        .filter_map(|one| one.input.as_ref().ok())
        .flat_map(|input| input.netlist.network.parameters())
        .map(|parameter| parameter.name.as_str())
        .collect();
    names.sort_unstable();
    let problem = Diagnostic::error("netlist::unknown_parameter", message);
    let near = lptn_units::suggest(name, names.into_iter());
    let problem = problem.help(near.map(|near| format!("did you mean `{near}`?")));
    Err(Failure::new(Exit::Input, problem))
}

/// A posterior that no candidate can use is a mistake, unless a candidate that could not be read may
/// be meant.
fn believed(args: &CompareArgs, loaded: &[Loaded]) -> Result<(), Failure> {
    let Some(file) = &args.posterior else { return Ok(()) };
    let idle = |one: &Loaded| one.input.as_ref().is_ok_and(|i| i.netlist.posterior().is_none());
    if !loaded.iter().all(idle) {
        return Ok(());
    }
    let message = format!("no candidate has a parameter of {}", file.display());
    let help = "use the `posterior.json` of a fit that varies parameters of these netlists";
    Err(Failure::new(Exit::Input, Diagnostic::error("posterior::nothing", message).help(help)))
}

/// Why a candidate has no results, as far as it was not already known when it was read.
enum NoResult {
    NotRead,
    Failure(Failure),
}

/// Every candidate, with progress on a terminal; after Ctrl-C those that were finished by then.
fn evaluate_all(
    loaded: &[Loaded],
    (periodic, threads): (bool, usize),
    console: &Console,
) -> Vec<Result<Candidate, NoResult>> {
    let interrupt = Interrupt::listen();
    let progress = ProgressOfAll::new(console.quiet, loaded.len(), "candidates");
    let numbered: Vec<(usize, &Loaded)> = loaded.iter().enumerate().collect();
    let done = in_parallel(&numbered, threads, |&(number, loaded)| {
        let show = &mut |step| progress.update(number, step);
        let outcome = evaluate((loaded, periodic), &interrupt, show);
        progress.finished(number);
        outcome
    });
    progress.clear();
    done
}

fn evaluate(
    (loaded, periodic): (&Loaded, bool),
    interrupt: &Interrupt,
    show: &mut dyn FnMut(Progress),
) -> Result<Candidate, NoResult> {
    let input = loaded.input.as_ref().map_err(|_| NoResult::NotRead)?;
    let system: ThermalSystem = input.assemble().map_err(NoResult::Failure)?;
    let run = input.netlist.run.as_ref();
    let found = if interrupt.pressed() {
        Err(CompareError::Interrupted(run.map_or(0.0, |run| run.start)))
    } else {
        let observer = &mut |step| {
            show(step);
            interrupt.control()
        };
        match periodic {
            true => Candidate::settled_observed(&system, run, observer),
            false => Candidate::evaluate_observed(&system, run, observer),
        }
    };
    found.map_err(|error| {
        let place = error.input().and_then(|error| input.place_of(error));
        NoResult::Failure(input.failure(&error, place))
    })
}

/// How sure every candidate is, as far as that can be known.
fn doubtful(
    loaded: &[Loaded],
    done: &mut [Result<Candidate, NoResult>],
    threads: usize,
) -> Vec<Diagnostic> {
    let pairs: Vec<(&Loaded, Option<Candidate>)> = loaded
        .iter()
        .zip(done.iter())
        .map(|(one, done)| (one, done.as_ref().ok().cloned()))
        .collect();
    let found = in_parallel(&pairs, threads, |(one, candidate)| {
        let (Ok(input), Some(mut candidate)) = (&one.input, candidate.clone()) else { return None };
        let warning = doubts::look(input, &mut candidate, &one.file);
        Some((candidate, warning))
    });
    let mut warnings = Vec::new();
    for (done, found) in done.iter_mut().zip(found) {
        if let Some((candidate, warning)) = found {
            *done = Ok(candidate);
            warnings.extend(warning);
        }
    }
    warnings
}

/// The unit for temperatures: that of the command line, or of the first candidate that was read.
fn unit(args: &CompareArgs, loaded: &[Loaded]) -> Result<Unit, Failure> {
    let first = loaded.iter().find_map(|one| one.input.as_ref().ok());
    match (first, args.scale.temperature_unit.as_deref()) {
        (Some(input), text) => input::temperature_unit(text, &input.netlist),
        (None, text) => {
            let text = text.unwrap_or("degC");
            Unit::parse(text).map_err(|error| input::wrong_unit("--temperature-unit", text, &error))
        }
    }
}

/// The candidates in their order.
pub(crate) struct Comparison {
    pub(crate) rows: Vec<CompareRow>,
    pub(crate) unit: Unit,
    /// How each row ended; limits are not looked at.
    pub(crate) ends: Vec<Exit>,
    failures: Vec<Failure>,
    /// Of those that were read: what is probably not meant as it is written.
    warnings: Vec<(Files, Vec<Diagnostic>)>,
}

impl Comparison {
    fn of(
        outcomes: impl Iterator<Item = (Loaded, Result<Candidate, NoResult>)>,
        unit: Unit,
    ) -> Self {
        let (rows, ends, failures, warnings) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut comparison = Self { rows, unit, ends, failures, warnings };
        outcomes.for_each(|(loaded, outcome)| comparison.add(loaded, outcome));
        comparison
    }

    fn add(&mut self, loaded: Loaded, outcome: Result<Candidate, NoResult>) {
        let Loaded { file, input, .. } = loaded;
        let mut title = String::new();
        let mut failure = None;
        match input {
            Ok(input) => {
                title = input.netlist.network.title().map_or(String::new(), plain);
                let found = outcome.as_ref().ok();
                let beyond = found.map_or_else(Vec::new, |found| {
                    trust::doubts(&input.netlist, &found.trust, input.netlist.run.is_some())
                });
                let unbounded = found.and_then(|found| found.trust.unbounded.as_ref());
                let unbounded = bound::unbounded(&input.netlist.network, unbounded);
                let several = outcome.as_ref().ok().and_then(|found| found.several.as_ref());
                let several =
                    several.and_then(|steady| others(&input.netlist.network, steady, &self.unit));
                let of_file = |warning: Diagnostic| Diagnostic {
                    message: format!("{file}: {}", warning.message),
                    ..warning
                };
                let has_cycle = found.is_some_and(|found| matches!(found.settled, Some(Ok(_))));
                let vary = inputs_vary(&input.netlist, &file).filter(|_| !has_cycle);
                let no_cycle = found.and_then(|found| unsettled(&file, found));
                let unsure = unverified(&input.netlist.network).map(|text| {
                    let message = format!("{file}: {text}");
                    Diagnostic::warning("network::unverified_constants", message)
                });
                let own = input.netlist.warnings.into_iter();
                let warnings = own
                    .chain(vary)
                    .chain(beyond)
                    .chain(unbounded.map(of_file))
                    .chain(several.map(of_file))
                    .chain(no_cycle)
                    .chain(unsure)
                    .collect();
                self.warnings.push((input.netlist.files, warnings));
            }
            Err(not_read) => failure = Some(not_read),
        }
        let outcome = outcome.map_err(|no_result| match no_result {
            NoResult::NotRead => {}
            NoResult::Failure(reason) => failure = Some(reason),
        });
        self.ends.push(failure.as_ref().map_or(Exit::Done, |failure| failure.exit));
        let code = failure.as_ref().and_then(|failure| failure.diagnostics.first()).map(|d| d.code);
        self.failures.extend(failure);
        let outcome = outcome.map_err(|()| code.unwrap_or_default().to_owned());
        self.rows.push(CompareRow { file, title, outcome });
    }

    /// Warnings and what is wrong with the candidates that have no results.
    fn report(&self, console: &Console) {
        self.warnings.iter().for_each(|(files, warnings)| console.warn(files, warnings));
        // the last line names those that were interrupted
        let problems = self.failures.iter().filter(|failure| failure.exit != Exit::Interrupted);
        problems.for_each(|failure| console.report(&failure.files, &failure.diagnostics));
    }

    /// Ctrl-C goes before what could not be read, that before what failed, and that before a broken
    /// limit.
    pub(crate) fn exit(&self) -> Exit {
        if self.ends.contains(&Exit::Interrupted) {
            Exit::Interrupted
        } else if self.ends.contains(&Exit::Input) {
            Exit::Input
        } else if self.ends.contains(&Exit::Failed) {
            Exit::Failed
        } else if self.rows.iter().any(|row| row.status() == "broken") {
            Exit::No
        } else {
            Exit::Done
        }
    }
}
