//! The state that is drawn: where the network settles, or a time of its run.

use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::Network;
use lptn_report::duration;
use lptn_solve::{RunStatus, Snapshot, Solution, SteadyState, Transient};
use lptn_units::Unit;

use super::args::GraphArgs;
use crate::console::Console;
use crate::doubts::{adiabatic, inputs_vary, others};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::verbs::run::job::{no_run, observed, time_of_run};
use crate::verbs::run::outcome::{does_not_close, doubts};
use crate::verbs::steady::failed;

/// The time that is asked for, else the steady state.
pub(super) fn state(
    args: &GraphArgs,
    (input, unit, console): (&Input, &Unit, &Console),
) -> Result<Snapshot, Failure> {
    match &args.at {
        Some(text) => at(text, input, console),
        None => Ok(steady(input, unit, console)?.state),
    }
}

/// The steady state, with what to know before it is believed.
fn steady(input: &Input, unit: &Unit, console: &Console) -> Result<SteadyState, Failure> {
    let netlist = &input.netlist;
    let network: &Network = &netlist.network;
    let system = input.assemble()?;
    let start = netlist.run.as_ref().map_or(0.0, |run: &RunSettings| run.start);
    let steady = SteadyState::solve(&system, start).map_err(|error| failed(input, &error))?;
    let vary = inputs_vary(input, &steady, &[]);
    let doubts = [vary, adiabatic(network, &steady), others(network, &steady, unit)];
    let doubts: Vec<Diagnostic> = doubts.into_iter().flatten().collect();
    console.warn(&netlist.files, &doubts);
    Ok(steady)
}

/// The row of the run at or before a time.
fn at(text: &str, input: &Input, console: &Console) -> Result<Snapshot, Failure> {
    let settings = input.netlist.run.as_ref().ok_or_else(|| no_run(input))?;
    let time = time_of_run(text, settings)?;
    let system = input.assemble()?;
    let transient = Transient::of(system.network(), settings);
    let (solution, broken) = observed(input, (&system, &transient), console)?;
    check(input, &solution, broken)?;
    console.warn(&input.netlist.files, &doubts(&solution));
    let row = solution.row_at(time).unwrap_or(0);
    let found = solution.snapshot(row).ok_or_else(|| {
        let message = format!("the heat flows at {} cannot be computed again", duration(time, 6));
        Failure::new(Exit::Failed, Diagnostic::error("graph::no_state", message))
    })?;
    let (asked, shown) = (duration(time, 6), duration(found.time, 6));
    if asked != shown {
        console.note(&format!("at     {shown}, the row before {asked}"));
    }
    Ok(found)
}

/// A run that did not reach its stop, or whose books do not close, is not drawn.
fn check(input: &Input, solution: &Solution, broken: Option<Diagnostic>) -> Result<(), Failure> {
    if let Some(problem) = broken {
        return Err(input.refused(Exit::Failed, problem));
    }
    if let RunStatus::Interrupted(time) = solution.end() {
        let message = format!("the run was interrupted at {}", duration(time, 4));
        let problem = Diagnostic::error("run::interrupted", message);
        return Err(Failure::new(Exit::Interrupted, problem));
    }
    match solution.ledger().closes() {
        true => Ok(()),
        false => Err(input.refused(Exit::Failed, does_not_close(solution))),
    }
}
