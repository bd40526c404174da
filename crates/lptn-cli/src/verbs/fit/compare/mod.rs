//! `lptn fit compare`

mod args;
mod figure;
mod output;
mod page;
mod shown;
mod words;

pub(crate) use args::FitCompareArgs;

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use lptn_fit::choice::{Choice, ChoiceError, Contender, choose};
use lptn_fit::network::NetworkFitTask;
use lptn_netlist::{Diagnostic, FitStudy};
use lptn_report::plain;
use lptn_solve::available_threads;

use super::network::{Answer as Fit, STUDIES, doubts, record_place};
use crate::console::Console;
use crate::files::Folder;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use crate::verbs::compare::listed;
use lptn_answer::belief::Belief;
use lptn_answer::compare::{Variant, load, of_sets, too_many, used};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::{Input, quoted};

pub(crate) fn compare(args: &FitCompareArgs, console: &Console) -> Result<Exit, Failure> {
    let loaded = loaded(args)?;
    let candidates = candidates(&loaded, args)?;
    for one in &loaded {
        console.warn(&one.input.netlist.files, &one.input.netlist.warnings);
    }
    let threads = args.threads.unwrap_or_else(available_threads).max(1);
    let tasks = tasks(&candidates, args, threads)?;
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let choice = observed(&tasks, threads, console).map_err(|error| failed(&candidates, &error))?;
    let answer = Answer::new(candidates, choice);
    for (candidate, doubts) in answer.candidates.iter().zip(&answer.doubts) {
        console.warn(&candidate.input.netlist.files, doubts);
    }
    if let Some(folder) = &folder {
        output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.show(&answer, args.printed.format)?;
    if let Some(folder) = &folder {
        let first = folder.path().join(output::NAMES[0]);
        console.note(&format!("wrote  {}, {}", first.display(), output::NAMES[1..].join(", ")));
    }
    let best = &answer.candidates[answer.choice.best];
    if let (Some(file), Exit::Done) = (best.input.typed(), exit) {
        console.next(&format!("lptn fit network {file} {}", quoted(&best.study.name)));
    }
    Ok(exit)
}

/// A netlist with what a `--set` makes of it.
struct Loaded {
    path: PathBuf,
    label: String,
    input: Input,
}

/// A network that may be the one: a `[fit.NAME]` of a netlist.
#[derive(Clone)]
pub(crate) struct Candidate<'a> {
    pub(crate) name: String,
    pub(crate) input: &'a Input,
    pub(crate) study: &'a FitStudy,
}

/// Every file with every variant of it, or what is wrong with the first that cannot be read. A fit
/// begins with what its netlist itself says: what another one found may count the same records.
fn loaded(args: &FitCompareArgs) -> Result<Vec<Loaded>, Failure> {
    let variants: Vec<Variant> = of_sets(&args.set).ok_or_else(|| too_many("--set"))?;
    let files = listed(&args.files)?;
    let jobs: Vec<(&PathBuf, &Variant)> =
        files.iter().flat_map(|file| variants.iter().map(move |one| (file, one))).collect();
    let all: Vec<_> = jobs.iter().map(|(file, one)| load(file, one, &Belief::None)).collect();
    used(&args.set, &all)?;
    let one = |(job, loaded): (&(&PathBuf, &Variant), lptn_answer::compare::Loaded)| {
        let (path, label) = (job.0.clone(), job.1.label().to_owned());
        Ok(Loaded { path, label, input: loaded.input? })
    };
    jobs.iter().zip(all).map(one).collect()
}

fn candidates<'a>(
    loaded: &'a [Loaded],
    args: &FitCompareArgs,
) -> Result<Vec<Candidate<'a>>, Failure> {
    let mut found: Vec<(&Loaded, &FitStudy)> = Vec::new();
    for one in loaded {
        let fits = &one.input.netlist.studies.fits;
        let is_meant = |study: &&FitStudy| args.fit.is_empty() || args.fit.contains(&study.name);
        let before = found.len();
        found.extend(fits.iter().filter(is_meant).map(|study| (one, study)));
        if found.len() == before {
            let name = args.fit.first().map(String::as_str);
            STUDIES.find(&one.input, (fits, |study| &study.name), name)?;
        }
    }
    let unused = |name: &&String| found.iter().all(|(_, study)| study.name != **name);
    if let (Some(name), Some(one)) = (args.fit.iter().find(unused), loaded.first()) {
        let fits = &one.input.netlist.studies.fits;
        STUDIES.find(&one.input, (fits, |study| &study.name), Some(name))?;
    }
    let names = names(&found);
    let candidate = |((one, study), name): (&(&'a Loaded, &'a FitStudy), String)| {
        let input = &one.input;
        Candidate { name, input, study }
    };
    Ok(found.iter().zip(names).map(candidate).collect())
}

/// What tells the candidates from each other: file, fit and what is set, each where it differs.
fn names(found: &[(&Loaded, &FitStudy)]) -> Vec<String> {
    let stem = |path: &Path| {
        path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    };
    let differ = |of: &dyn Fn(&(&Loaded, &FitStudy)) -> String| {
        found.iter().any(|one| of(one) != of(&found[0]))
    };
    let of_path = |one: &(&Loaded, &FitStudy)| one.0.path.display().to_string();
    let of_stem = |one: &(&Loaded, &FitStudy)| stem(&one.0.path);
    let (by_path, by_label) = (differ(&of_path), differ(&|one| one.0.label.clone()));
    let twice = |one: &(&Loaded, &FitStudy)| {
        let mut others = found.iter().filter(|other| of_stem(other) == of_stem(one));
        others.any(|other| other.0.path != one.0.path)
    };
    let several = |one: &(&Loaded, &FitStudy)| {
        found.iter().filter(|other| std::ptr::eq(other.0, one.0)).count() > 1
    };
    let name = |one: &(&Loaded, &FitStudy)| {
        let file = if twice(one) { of_path(one) } else { of_stem(one) };
        let parts = [
            (by_path, file),
            (several(one) || !(by_path || by_label), one.1.name.clone()),
            (by_label, one.0.label.clone()),
        ];
        let parts: Vec<String> =
            parts.into_iter().filter(|(tells, _)| *tells).map(|(_, part)| part).collect();
        plain(&parts.join(", "))
    };
    found.iter().map(name).collect()
}

fn tasks<'a>(
    candidates: &[Candidate<'a>],
    args: &FitCompareArgs,
    threads: usize,
) -> Result<Vec<Contender<'a>>, Failure> {
    let task = |one: &Candidate<'a>| {
        let mut task =
            NetworkFitTask::of(&one.input.netlist, one.study, threads).map_err(|error| {
                let place = record_place(one.study, &error).unwrap_or(&one.study.span);
                one.input.failure(&error, Some(place.clone()))
            })?;
        task.more_starts = args.starts.map_or(task.more_starts, usize::from);
        Ok(Contender { name: one.name.clone(), task })
    };
    candidates.iter().map(task).collect()
}

/// The choice, with its progress, until Ctrl-C.
fn observed<'a>(
    tasks: &[Contender<'a>],
    threads: usize,
    console: &Console,
) -> Result<Choice<'a>, ChoiceError> {
    let interrupt = Interrupt::listen();
    let line = Mutex::new(ProgressLine::new(console.quiet));
    let outcome = choose(tasks, threads, &|stage, step| {
        // no run waits for the line: the next step says more
        if let Ok(mut line) = line.try_lock() {
            line.update_of(&stage.to_string(), step);
        }
        interrupt.control()
    });
    line.into_inner().unwrap_or_else(PoisonError::into_inner).clear();
    outcome
}

/// What is wrong, at the fit that is at fault.
fn failed(candidates: &[Candidate<'_>], error: &ChoiceError) -> Failure {
    let one = error.contender().and_then(|name| candidates.iter().find(|one| one.name == name));
    match one {
        Some(one) => one.input.failure(error, Some(one.study.span.clone())),
        None => {
            let exit = lptn_units::Problem::class(error).into();
            Failure::new(exit, told(error))
        }
    }
}

/// What records say of the candidates.
pub(crate) struct Answer<'a> {
    pub(crate) candidates: Vec<Candidate<'a>>,
    pub(crate) choice: Choice<'a>,
    /// The fit of each candidate to all records.
    pub(crate) fits: Vec<Fit<'a>>,
    /// What is doubtful of each.
    pub(crate) doubts: Vec<Vec<Diagnostic>>,
}

impl<'a> Answer<'a> {
    fn new(candidates: Vec<Candidate<'a>>, choice: Choice<'a>) -> Self {
        let both = candidates.iter().zip(&choice.contenders);
        let fit = |(one, judged): (&Candidate<'a>, &lptn_fit::choice::Judged<'a>)| {
            Fit::new((one.input, one.study), judged.task.clone(), judged.fit.clone())
        };
        let fits: Vec<Fit<'a>> = both.map(fit).collect();
        let mut answer = Self { candidates, choice, fits, doubts: Vec::new() };
        answer.doubts = (0..answer.fits.len()).map(|i| answer.doubts_of(i)).collect();
        answer
    }

    /// Of one candidate: those of its fit, and those of what it says of unseen records. That one
    /// which is worse misses the records, each in its own way, is what was asked, and that intervals
    /// count slow drift is seen by their width.
    fn doubts_of(&self, i: usize) -> Vec<Diagnostic> {
        let name = &self.candidates[i].name;
        let named = |doubt: Diagnostic| Diagnostic {
            message: format!("{name}: {}", doubt.message),
            ..doubt
        };
        let worse = self.choice.is_told(i);
        let matters = |doubt: &Diagnostic| match doubt.code {
            "fit::misfit" | "fit::records_differ" => !worse,
            code => code != "fit::slow_drift",
        };
        let of_fit = doubts(&self.fits[i]).into_iter().filter(matters).map(named);
        of_fit.chain(words::doubts(self, i)).collect()
    }
}
