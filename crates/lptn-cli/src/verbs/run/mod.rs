//! `lptn run`

mod args;
pub(crate) mod live;
pub(crate) mod messages;
pub(crate) mod uncertainty;

use std::path::PathBuf;
use std::sync::Arc;

use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::run::RunAnswer;
use lptn_report::{write_csv, write_rows};

pub(crate) use args::RunArgs;

use crate::console::Console;
use crate::files::names::{
    EVENTS, MANIFEST, RANKING, REPORTS, RESULT, STATE, UNCERTAINTY, WINDOWS,
};
use crate::files::{Folder, environment};
use crate::input::Load as _;

pub(crate) fn run(args: &RunArgs, console: &Console) -> Result<Exit, Failure> {
    live::check(args)?;
    let belief = Belief::of(args.uncertainty.posterior.as_deref());
    let load = || Input::load_run(&args.source, &args.times, &belief);
    let input = console.phases.timed("read", load)?;
    let (answer, folder) = answer(args, input, console)?;
    if let Some(folder) = &folder {
        console.phases.timed("write", || write(&answer, folder, console))?;
        console.results_in(folder.path());
    }
    console.page(&answer, answer.task.format)?;
    live::page(args, &answer, console);
    messages::beside(&answer, folder.as_ref(), console);
    Ok(messages::conclude(&answer, folder.is_some(), console))
}

/// Runs a netlist; gives the folder for its files.
pub(crate) fn answer(
    args: &RunArgs,
    input: Input,
    console: &Console,
) -> Result<(RunAnswer, Option<Folder>), Failure> {
    let task = args.question(console).of(Arc::new(input))?;
    let input = Arc::clone(&task.input);
    let system = console.phases.timed("assemble", || input.assemble())?;
    let out = || PathBuf::from("out").join(&input.text.stem);
    let folder = || Folder::prepare(args.output.clone().unwrap_or_else(out));
    let folder = (!args.no_files).then(folder).transpose()?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    Ok((task.answer(&system, &console.listening())?, folder))
}

/// Writes the files: all of them take their places together, the manifest last.
pub(crate) fn write(answer: &RunAnswer, folder: &Folder, console: &Console) -> Result<(), Failure> {
    let mut files = folder.batch();
    files.write(RESULT, |out| write_csv(&answer.shown_table(), out))?;
    files.write(STATE, |out| answer.state().write(out))?;
    files.write(EVENTS, |out| write_rows(&answer.events(), out))?;
    if let Some(rows) = answer.windows() {
        files.write(WINDOWS, |out| write_rows(&rows, out))?;
    }
    if let Some(rows) = answer.reports_over_time() {
        files.write(REPORTS, |out| write_rows(&rows, out))?;
    }
    if let Some([bands, ranking]) = answer.uncertainties() {
        files.write(UNCERTAINTY, |out| write_csv(&bands, out))?;
        files.write(RANKING, |out| write_csv(&ranking, out))?;
    }
    let environment = environment(answer.wall_time, &console.phases.seconds());
    let manifest = answer.manifest(files.written().to_vec(), environment);
    files.write(MANIFEST, |out| out.write_all(manifest.text()?.as_bytes()))?;
    files.commit(&[EVENTS, WINDOWS, REPORTS, UNCERTAINTY, RANKING])
}
