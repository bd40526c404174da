//! `lptn compare`

mod args;

use std::path::{Path, PathBuf};

use lptn_answer::answer::Answer as _;
use lptn_answer::compare::{CompareAnswer, CompareQuestion};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::quoted;
use lptn_report::Format;
use lptn_study::CompareRow;

pub(crate) use args::CompareArgs;

use crate::arguments;
use crate::console::Console;
use crate::files;

pub(crate) fn compare(args: &CompareArgs, console: &Console) -> Result<Exit, Failure> {
    let question = CompareQuestion {
        files: listed(&args.files)?,
        set: args.set.clone(),
        posterior: args.posterior.clone(),
        uncertainty: args.uncertainty,
        parts: args.parts.clone(),
        csv: args.csv.options()?,
        cases: args.cases,
        periodic: args.periodic,
        sort: args.sort,
        temperature_unit: args.scale.temperature_unit.clone(),
        threads: args.threads,
        detail: console.detail,
        command: arguments::words(),
    };
    let answer = question.ask(&console.listening())?;
    report(&answer, console);
    console.page(&answer, args.printed.format)?;
    if args.printed.format == Format::Table {
        next(&answer, console);
    }
    match answer.exit() {
        Exit::Done => console.note(&answer.sentence()),
        _ => console.message(&answer.sentence()),
    }
    Ok(answer.exit())
}

/// Reports doubts, and the problems of candidates without results.
fn report(answer: &CompareAnswer, console: &Console) {
    console.warn(answer.files(), &answer.doubts());
    // the last line names those that were interrupted
    let problems = answer.failures.iter().filter(|failure| failure.exit != Exit::Interrupted);
    problems.for_each(|failure| console.report(&failure.files, &failure.diagnostics));
}

/// Files that can be drawn over each other.
fn next(answer: &CompareAnswer, console: &Console) {
    if answer.rows.iter().filter_map(CompareRow::candidate).count() > 1 && answer.is_of_files() {
        let read = answer.rows.iter().filter(|row| row.candidate().is_some());
        let names: Vec<String> = read.map(|row| quoted(&row.file)).collect();
        console.next(&format!("lptn plot {}", names.join(" ")));
    }
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
        return Err(Failure::refused("input::cannot_read", message, "netlists end with .toml"));
    }
    Ok(found)
}
