//! Messages on a run on stderr, and its exit code.

use lptn_answer::exit::Exit;
use lptn_answer::input::quoted;
use lptn_answer::run::RunAnswer;
use lptn_answer::select;
use lptn_report::{Format, WIDTH, duration, labelled, words};
use lptn_solve::{RunStatus, Solution};

use crate::console::Console;
use crate::files::Folder;
use crate::files::names::{EVENTS, MANIFEST, RESULT, STATE};
use crate::verdict;

/// Prints notes and warnings next to the result.
pub(crate) fn beside(answer: &RunAnswer, folder: Option<&Folder>, console: &Console) {
    if let Some(folder) = folder {
        wrote(answer, folder, console);
    }
    if console.verbose {
        console.note(&labelled("work   ", &work(&answer.solution), WIDTH).join("\n"));
    }
    let netlist = &answer.task.input.netlist;
    if let Some(hidden) = select::hidden(netlist).filter(|_| !answer.task.chosen) {
        console.note(&hidden);
    }
    if answer.task.format != Format::Table {
        console.warn(&netlist.files, &answer.bounds());
    }
    console.warn(&netlist.files, &answer.found());
    if answer.task.format == Format::Table && answer.solution.end() == RunStatus::Reached {
        if let Some(folder) = folder {
            console.next(&format!("lptn plot {}", quoted(&folder.path().display().to_string())));
        }
        answer.next().iter().for_each(|command| console.next(command));
    }
}

fn wrote(answer: &RunAnswer, folder: &Folder, console: &Console) {
    let path = folder.path().join(RESULT);
    let took = duration(answer.wall_time, 2);
    let rows = answer.table.rows();
    let windows = if answer.solution.windows().is_empty() { "" } else { ", windows.csv" };
    let reports = if answer.solution.reports_over_time().is_empty() { "" } else { ", reports.csv" };
    let bands = if answer.uncertainty().is_some() { ", uncertainty.csv, ranking.csv" } else { "" };
    let files =
        format!("{}{bands}, {EVENTS}{windows}{reports}, {STATE}, {MANIFEST}", path.display());
    let mut pieces = words(&files);
    pieces.push(format!("({rows} rows, solved in {took})"));
    console.note(&labelled("wrote  ", &pieces, WIDTH).join("\n"));
}

/// The exit code, after saying why it is not 0.
pub(crate) fn conclude(answer: &RunAnswer, files: bool, console: &Console) -> Exit {
    let kept = if files {
        "the rows up to then are whole, and marked in the manifest"
    } else {
        "the rows up to then are whole"
    };
    if let Some(failure) = answer.failed() {
        match (&answer.failure, answer.ended_early()) {
            (None, Some(message)) => console.message(&format!("{message}: {kept}")),
            (broken_off, _) => {
                console.report(&failure.files, &failure.diagnostics);
                let said = broken_off.iter().map(|_| format!("failed: {kept}"));
                said.for_each(|said| console.message(&said));
            }
        }
        return failure.exit;
    }
    verdict::conclude(&answer.judgement(&answer.limits()), console)
}

/// Counters of the integrator.
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
