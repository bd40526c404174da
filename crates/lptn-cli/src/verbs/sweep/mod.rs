//! `lptn sweep`

mod args;
mod growing;
mod merge;
mod plan;

use std::fs::File;
use std::io::{self, Write as _};
use std::sync::Arc;
use std::time::Instant;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::sweep::{KeptRows, Rows, SweepAnswer, SweepAsked, SweepQuestion, Tally};
use lptn_report::{CsvLines, Format, Page as _};
use lptn_solve::available_threads;

use args::SweepVerb;
use growing::{Found, Growing};

pub(crate) use args::SweepArgs;

use crate::console::Console;
use crate::files::Folder;
use crate::files::names::SWEEP;
use crate::input::Load as _;
use crate::options::Source;

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
    let source = Source { file, set: args.set.clone(), case: args.case.clone() };
    let input = Arc::new(console.phases.timed("read", || Input::load(&source))?);
    let question = SweepQuestion {
        name: args.name.clone(),
        temperature_unit: args.scale.temperature_unit.clone(),
        shard: args.shard,
    };
    let asked = question.of(input)?;
    let folder = || Folder::prepare(asked.folder(args.output.clone()));
    let folder = (!args.no_files).then(folder).transpose()?;
    console.warn(&asked.input.netlist.files, &asked.input.netlist.warnings);
    let threads = args.threads.unwrap_or_else(available_threads);
    let (outcome, interrupted) = match &folder {
        Some(folder) => into_folder(&asked, (folder, args.resume), threads, console)?,
        None => without_files(&asked, args.format, threads, console)?,
    };
    let (tally, rows) = outcome;
    if interrupted {
        let more = if folder.is_some() { ": add --resume to go on" } else { "" };
        console.message(&format!("interrupted after {} candidates{more}", tally.rows));
        return Ok(Exit::Interrupted);
    }
    show(args, &SweepAnswer { asked, tally, rows }, folder.as_ref(), console)
}

/// Summary of the rows and the rows, and true if Ctrl-C ended the sweep.
type Outcome = ((Tally, Rows), bool);

fn into_folder(
    asked: &SweepAsked,
    (folder, resume): (&Folder, bool),
    threads: usize,
    console: &Console,
) -> Result<Outcome, Failure> {
    let begun = Instant::now();
    let mut tally = asked.tally();
    let place = folder.path().join(SWEEP);
    let (mut growing, from) = match Found::of(folder, asked, resume)? {
        Found::Nothing => (Growing::begin(folder, asked)?, asked.range.start),
        Found::Rows => {
            let (growing, from) = Growing::go_on(folder, asked, &mut tally)?;
            console.note(&format!("continues after {} candidates", from - asked.range.start));
            (growing, from)
        }
        Found::Whole => {
            console.note(&format!("{} is there already, and whole", place.display()));
            asked.read(&place, &mut tally)?;
            return Ok(((tally, Rows::In(place)), false));
        }
    };
    let mut sink = |lines: CsvLines| growing.write(&lines.into_bytes());
    let solve = || asked.solve((from, threads), (&mut tally, &mut sink), &console.listening());
    let interrupted = console.phases.timed("solve", solve)?;
    if !interrupted {
        growing.finish(folder, asked, begun.elapsed().as_secs_f64())?;
    }
    console.results_in(folder.path());
    Ok(((tally, Rows::In(place)), interrupted))
}

/// Rows go to stdout as they come, or into memory for JSON.
fn without_files(
    asked: &SweepAsked,
    format: Format,
    threads: usize,
    console: &Console,
) -> Result<Outcome, Failure> {
    let (mut tally, mut kept) = (asked.tally(), KeptRows::default());
    let (from, listening) = ((asked.range.start, threads), console.listening());
    let interrupted = match format {
        Format::Csv => {
            console.write(|out| out.write_all(&asked.heading()))?;
            let mut print = |lines: CsvLines| {
                let text = lines.into_bytes();
                console.write(|out| out.write_all(&text))
            };
            asked.solve(from, (&mut tally, &mut print), &listening)?
        }
        Format::Json => {
            let mut keep = |rows| {
                kept.append(rows);
                Ok(())
            };
            asked.solve(from, (&mut tally, &mut keep), &listening)?
        }
        Format::Table => asked.solve(from, (&mut tally, &mut |(): ()| Ok(())), &listening)?,
    };
    Ok(((tally, Rows::Kept(kept)), interrupted))
}

fn show(
    args: &SweepArgs,
    answer: &SweepAnswer,
    folder: Option<&Folder>,
    console: &Console,
) -> Result<Exit, Failure> {
    if let (Format::Csv, Rows::In(path)) = (args.format, &answer.rows) {
        console.write(|out| io::copy(&mut File::open(path)?, out).map(drop))?;
    }
    // rows are there already
    let printed = args.format == Format::Csv && folder.is_none();
    if args.format != Format::Csv {
        console.page(answer, args.format)?;
    } else if !printed || console.plot.is_some() {
        pictures(answer, console)?;
    }
    if let Some(folder) = folder {
        console.note(&format!("wrote  {}", folder.path().join(SWEEP).display()));
    }
    if let (Some(_), Some(folder)) = (answer.asked.shard, folder) {
        let whole = folder.path().parent();
        let whole = whole.map_or(String::new(), |whole| quoted(&whole.display().to_string()));
        console.next(&format!("lptn sweep merge {whole}"));
    }
    if answer.exit() == Exit::Failed {
        console.message("every candidate failed");
    }
    Ok(answer.exit())
}

/// Draws the requested pictures next to rows that are written separately.
fn pictures(answer: &SweepAnswer, console: &Console) -> Result<(), Failure> {
    if console.reports() {
        console.add_report(lptn_report::report_of(answer));
    }
    let drawing = console.plot.clone();
    drawing.map_or(Ok(()), |drawing| console.draw(&answer.figures(), &drawing))
}
