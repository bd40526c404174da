//! `lptn report`: the page of a run that has been made.
//!
//! The run is repeated as its manifest says, and must give the same bytes.
//! If its files have changed, the page shows the content of the folder, and says so.

mod args;

use std::path::Path;

pub(crate) use args::ReportArgs;
use clap::Parser as _;
use lptn_netlist::Diagnostic;
use lptn_report::{Claim, Piece, Section, write_csv};
use lptn_solve::RunStatus;
use serde_json::Value;

use super::Verb;
use super::run::{self, RunArgs};
use crate::args::Args;
use crate::console::Console;
use crate::files::names::{MANIFEST, RESULT};
use crate::input::Load as _;
use lptn_answer::about;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::plot::{Columns, Source};

pub(crate) fn report(args: &ReportArgs, console: &Console) -> Result<Exit, Failure> {
    let folder = &args.folder;
    let source = Source::of_folder(folder, &Columns { families: true, ..Columns::default() })?;
    console.warn(&source.doubts.0, &source.doubts.1);
    let figure = source.figure;
    console.results_in(folder);
    let manifest = std::fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let manifest: Value = serde_json::from_str(&manifest).unwrap_or_default();
    let outcome = match changed(&manifest) {
        Some(why) => Err(why),
        None => again(&manifest, folder, console)?,
    };
    match outcome {
        Ok(same) => {
            let message = format!("{RESULT} differs from the result of its run now");
            let problem = Diagnostic::error("report::differs", message);
            let help = "it was written by another version of lptn, or changed since";
            if same { Ok(Exit::Done) } else { Err(Failure::new(Exit::No, problem.help(help))) }
        }
        Err(why) => {
            let mut report = about::of_command(&[], &crate::arguments::words());
            report.title.clone_from(&figure.title);
            console.message(&format!(
                "not run again: {why}; the page shows the files of the \
                folder"
            ));
            report.claims.push(Claim::open(format!("as it was written; not run again: {why}")));
            report.sections.insert(0, Section::of("", Piece::Figure(figure)));
            report.sections.extend(about::manifest(manifest));
            console.add_report(report);
            Ok(Exit::Done)
        }
    }
}

/// Why a run cannot be made again.
fn changed(manifest: &Value) -> Option<String> {
    let Some(inputs) = manifest["inputs"].as_array().filter(|inputs| !inputs.is_empty()) else {
        return Some(format!("no {MANIFEST} says how"));
    };
    if manifest["end"]["status"] == "interrupted" {
        return Some("it was interrupted".into());
    }
    inputs.iter().find_map(|input| {
        let name = input["name"].as_str()?;
        let Ok(bytes) = std::fs::read(name) else { return Some(format!("{name} is not here")) };
        let same = input["sha256"].as_str() == Some(&lptn_study::sha256(&bytes));
        (!same).then(|| format!("{name} has changed since"))
    })
}

/// Repeats a run, adds it to the report, and returns true if its bytes are the same.
/// The inner error is the reason why it is not a run.
fn again(
    manifest: &Value,
    folder: &Path,
    console: &Console,
) -> Result<Result<bool, String>, Failure> {
    let words = manifest["arguments"].as_array().map_or(&[][..], Vec::as_slice);
    let words = std::iter::once("lptn").chain(words.iter().filter_map(Value::as_str));
    let Ok(Args { verb: Some(Verb::Run(args)), .. }) = Args::try_parse_from(words) else {
        return Ok(Err("its command is not `lptn run`".into()));
    };
    let args = RunArgs { no_files: true, output: None, ..args };
    run::live::check(&args)?;
    let input = Input::load_run(&args.source, &args.times, &Belief::Named)?;
    let (outcome, _) = run::answer(&args, input, console)?;
    if matches!(outcome.solution.end(), RunStatus::Interrupted(_)) {
        let problem = Diagnostic::error("run::interrupted", "the run was interrupted");
        return Err(Failure::new(Exit::Interrupted, problem));
    }
    let mut bytes = Vec::new();
    let written = write_csv(&outcome.shown_table(), &mut bytes);
    let there = std::fs::read(folder.join(RESULT)).unwrap_or_default();
    let same = written.is_ok() && there == bytes;
    let mut report = lptn_report::report_of(&outcome);
    let text = match same {
        true => format!("run again: {RESULT} has the same bytes"),
        false => format!("run again: {RESULT} has other bytes"),
    };
    report.claims.insert(0, Claim::checked(same, text));
    console.warn(&outcome.task.input.netlist.files, &outcome.found());
    console.add_report(report);
    run::live::page(&args, &outcome, console);
    Ok(Ok(same))
}
