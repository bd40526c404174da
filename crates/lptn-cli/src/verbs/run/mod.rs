//! `lptn run`

mod args;
mod events;
pub(crate) mod figure;
pub(crate) mod job;
mod next;
pub(crate) mod outcome;
pub(crate) mod page;
mod report;
mod state;
pub(crate) mod uncertainty;
mod windows;

pub(crate) use args::RunArgs;

use std::time::Instant;

use job::{Job, NoSteady};
use lptn_assembly::ThermalSystem;
use lptn_report::Format;
use lptn_solve::{Lumping, SteadyState, Table};
use outcome::Outcome;

use crate::console::Console;
use crate::files::Folder;
use crate::input::Load as _;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;

pub(crate) fn run(args: &RunArgs, console: &Console) -> Result<Exit, Failure> {
    let belief = Belief::of(args.uncertainty.posterior.as_deref());
    let mut input = console.phases.timed("read", || Input::load_from(&args.source, &belief))?;
    input.set_run_times(&args.times)?;
    let (result, folder) = outcome(args, &input, console)?;
    if let Some(folder) = &folder {
        console.phases.timed("write", || result.write(folder))?;
        console.results_in(folder.path());
    }
    console.show(&result, result.job.format)?;
    result.messages(folder.as_ref(), console);
    Ok(result.conclude(console, folder.is_some()))
}

/// Runs a netlist, and gives the folder that its files are to be written to.
pub(crate) fn outcome<'a>(
    args: &'a RunArgs,
    input: &'a Input,
    console: &Console,
) -> Result<(Outcome<'a>, Option<Folder>), Failure> {
    let job = Job { whole: console.reports(), ..Job::new(args, input)? };
    uncertainty::check(&args.uncertainty, input)?;
    let phases = &console.phases;
    let system = phases.timed("assemble", || input.assemble())?;
    let folder = (!args.no_files).then(|| Folder::prepare(job.folder(args))).transpose()?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    // only tables and reports show it
    let shown = job.format == Format::Table || console.reports();
    let steady = match shown {
        true => phases.timed("steady", || steady(&system, job.settings.start)),
        false => Err(NoSteady::NotShown),
    };
    let begun = Instant::now();
    let solved = phases.timed("integrate", || job.solve(&system, steady.as_ref().ok(), console));
    let (solution, failure) = solved?;
    // what broke off or was interrupted is not asked how sure it is
    let whole = matches!(solution.end(), lptn_solve::RunStatus::Reached);
    let uncertainty =
        if whole { uncertainty::study(&args.uncertainty, &job, console) } else { None };
    let wall_time = begun.elapsed().as_secs_f64();
    let (lumping, table) = phases.timed("results", || {
        let table = Table::of_solution(&solution, &job.selection, &job.unit);
        (Lumping::of_run(&solution), table)
    });
    let result = Outcome {
        job,
        steady,
        solution,
        lumping,
        failure,
        wall_time,
        phases: phases.seconds(),
        uncertainty,
        table,
        detail: console.detail,
    };
    Ok((result, folder))
}

fn steady(system: &ThermalSystem, start: f64) -> Result<SteadyState, NoSteady> {
    if !system.network().changing_inputs().is_empty() {
        return Err(NoSteady::Inputs);
    }
    Ok(lptn_analysis::steady(system, start).map_err(NoSteady::Network)?.result)
}
