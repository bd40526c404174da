//! `lptn sweep`

mod args;
mod asked;
mod figure;
mod front;
mod growing;
mod merge;
mod page;
mod parquet;
mod plan;
mod row;
mod shard;
mod tally;
mod work;

pub(crate) use args::SweepArgs;

use std::fs::File;
use std::io::{self, Write as _};
use std::time::Instant;

use args::SweepVerb;
use asked::Asked;
use growing::{Found, Growing, heading};
use lptn_report::Format;
use lptn_solve::available_threads;
use page::{Rows, View};
use tally::Tally;

use crate::console::Console;
use crate::files::Folder;
use crate::files::names::{PARQUET, SWEEP};
use crate::input::Load as _;
use crate::options::Source;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;

pub(crate) fn sweep(args: &SweepArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.verb {
        Some(SweepVerb::Plan(args)) => plan::plan(args, console),
        Some(SweepVerb::Merge(args)) => merge::merge(args, console),
        None => candidates(args, console),
    }
}

fn candidates(args: &SweepArgs, console: &Console) -> Result<Exit, Failure> {
    // without a verb there is a file
    let file = args.file.clone().unwrap_or_default();
    let source = Source { set: args.set.clone(), ..Source::of(file) };
    let input = console.phases.timed("read", || Input::load(&source))?;
    let asked = Asked::new(args, &input)?;
    let folder = match args.no_files {
        true => None,
        false => Some(Folder::prepare(asked.folder(args.output.clone()))?),
    };
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let threads = args.threads.unwrap_or_else(available_threads);
    let outcome = match &folder {
        Some(folder) => into_folder(&asked, (folder, args.resume), threads, console)?,
        None => without_files(&asked, args.format, threads, console)?,
    };
    show(args, &asked, (outcome, folder.as_ref()), console)
}

/// What came of a sweep.
struct Outcome {
    tally: Tally,
    interrupted: bool,
    rows: Rows,
}

fn tally_of(asked: &Asked<'_>) -> Tally {
    let axes = asked.axes();
    let (reports, front) = (asked.columns.len() - axes, asked.study().front);
    Tally::new((axes, reports), front, asked.range.end - asked.range.start)
}

fn into_folder(
    asked: &Asked<'_>,
    (folder, resume): (&Folder, bool),
    threads: usize,
    console: &Console,
) -> Result<Outcome, Failure> {
    let begun = Instant::now();
    let mut tally = tally_of(asked);
    let place = folder.path().join(SWEEP);
    let (mut growing, from) = match Found::of(folder, asked, resume)? {
        Found::Nothing => (Growing::begin(folder, asked)?, asked.range.start),
        Found::Rows => {
            let (growing, from) = Growing::go_on(folder, asked, &mut tally)?;
            console.note(&format!("goes on behind {} candidates", from - asked.range.start));
            (growing, from)
        }
        Found::Whole => {
            console.note(&format!("{} is there already, and whole", place.display()));
            page::read(asked, &place, &mut tally)?;
            return Ok(Outcome { tally, interrupted: false, rows: Rows::In(place) });
        }
    };
    let mut sink = |rows: &[u8]| growing.write(rows);
    let solve = || work::solve(asked, (from, threads), (&mut tally, &mut sink), console);
    let interrupted = console.phases.timed("solve", solve)?;
    if !interrupted {
        growing.finish(folder, asked, begun.elapsed().as_secs_f64())?;
    }
    console.results_in(folder.path());
    Ok(Outcome { tally, interrupted, rows: Rows::In(place) })
}

/// Rows go to stdout as they come, or into memory for JSON.
fn without_files(
    asked: &Asked<'_>,
    format: Format,
    threads: usize,
    console: &Console,
) -> Result<Outcome, Failure> {
    let mut tally = tally_of(asked);
    let mut kept = Vec::new();
    let (mut interrupted, from) = (false, asked.range.start);
    match format {
        Format::Csv => {
            console.write(|out| out.write_all(&heading(asked)))?;
            let mut sink = |rows: &[u8]| console.write(|out| out.write_all(rows));
            interrupted = work::solve(asked, (from, threads), (&mut tally, &mut sink), console)?;
        }
        _ => {
            let mut sink = |rows: &[u8]| {
                if format == Format::Json {
                    kept.extend_from_slice(rows);
                }
                Ok(())
            };
            interrupted |= work::solve(asked, (from, threads), (&mut tally, &mut sink), console)?;
        }
    }
    Ok(Outcome { tally, interrupted, rows: Rows::Kept(kept) })
}

fn show(
    args: &SweepArgs,
    asked: &Asked<'_>,
    (outcome, folder): (Outcome, Option<&Folder>),
    console: &Console,
) -> Result<Exit, Failure> {
    let Outcome { tally, interrupted, rows } = outcome;
    if interrupted {
        let done = tally.rows;
        let more = if folder.is_some() { ": add --resume to go on" } else { "" };
        console.message(&format!("interrupted behind {done} candidates{more}"));
        return Ok(Exit::Interrupted);
    }
    let csv_there = args.format == Format::Csv && folder.is_none();
    if let (Format::Csv, Rows::In(path)) = (args.format, &rows) {
        console.write(|out| io::copy(&mut File::open(path)?, out).map(drop))?;
    }
    let view = View { asked, tally: &tally, rows: &rows };
    if args.format != Format::Csv {
        console.page(&view, args.format)?;
    } else if !csv_there || console.plot.is_some() {
        view.pictures(console)?;
    }
    if let Some(folder) = folder {
        console.note(&format!("wrote  {}", folder.path().join(SWEEP).display()));
    }
    if let (Some(folder), true) = (folder, args.parquet) {
        parquet::write(folder, asked.ranged)?;
        console.note(&format!("wrote  {}", folder.path().join(PARQUET).display()));
    }
    if asked.shard.is_some() && folder.is_some() {
        let whole = folder.and_then(|folder| folder.path().parent());
        let whole = whole.map_or(String::new(), |whole| {
            lptn_answer::input::quoted(&whole.display().to_string())
        });
        console.next(&format!("lptn sweep merge {whole}"));
    }
    Ok(view.exit(console))
}
