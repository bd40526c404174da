//! Completion of the names in the netlist of the command line, for shells that ask the program
//! itself: `source <(COMPLETE=bash lptn)`.

use std::path::PathBuf;

use clap::{Arg, Command};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use clap_complete::env::CompleteEnv;
use lptn_netlist::{Netlist, library};
use lptn_solve::Selection;

use crate::arguments;
use crate::input::Load as _;
use crate::options::Source;
use lptn_answer::input::Input;

/// Answers a shell that asks for completions, and then ends the program.
pub(crate) fn answer_shell(command: fn() -> Command) {
    let completion = CompleteEnv::with_factory(move || with_names(command()));
    let here = std::env::current_dir().ok();
    match completion.try_complete(arguments::all(), here.as_deref()) {
        Ok(false) => {}
        Ok(true) => std::process::exit(0),
        Err(error) => error.exit(),
    }
}

/// The same command with completion of the names that its options take.
fn with_names(command: Command) -> Command {
    let is = |verb: &str| command.get_name() == verb;
    let (materials, sweep, plan) = (is("materials"), is("sweep"), is("plan"));
    let command = command.mut_args(|arg| {
        let found: Option<fn() -> Vec<String>> = match arg.get_id().as_str() {
            "set" => Some(parameters),
            "case" => Some(cases),
            "select" => Some(columns),
            "answering" | "balance" | "keep" | "port" => Some(nodes),
            "fit" => Some(fits),
            "gearbox" => Some(gearboxes),
            "name" if materials => Some(substances),
            "name" if sweep => Some(sweeps),
            "name" if plan => Some(plans),
            _ => None,
        };
        match found {
            Some(names) => completed(arg, names),
            None => arg,
        }
    });
    command.mut_subcommands(with_names)
}

fn completed(arg: Arg, names: fn() -> Vec<String>) -> Arg {
    let candidates = move || names().into_iter().map(CompletionCandidate::new).collect();
    arg.add(ArgValueCandidates::new(candidates))
}

/// The first netlist among the words, if it can be read.
fn netlist() -> Option<Netlist> {
    let mut words = arguments::all().iter().map(PathBuf::from);
    let file = words.find(|word| word.extension().is_some_and(|end| end == "toml"))?;
    Some(Input::load(&Source::of(file)).ok()?.netlist)
}

fn parameters() -> Vec<String> {
    let parameters = netlist().map(|netlist| netlist.network.parameters().to_vec());
    parameters.unwrap_or_default().into_iter().map(|p| format!("{}=", p.name)).collect()
}

fn cases() -> Vec<String> {
    let cases = netlist().map(|netlist| netlist.studies.cases);
    cases.unwrap_or_default().into_iter().map(|case| case.name).collect()
}

fn columns() -> Vec<String> {
    netlist().map(|netlist| Selection::names(&netlist.network)).unwrap_or_default()
}

fn nodes() -> Vec<String> {
    let nodes = netlist().map(|netlist| netlist.network.nodes().to_vec());
    nodes.unwrap_or_default().into_iter().map(|node| node.name).collect()
}

fn gearboxes() -> Vec<String> {
    let gearboxes = netlist().map(|netlist| netlist.gearboxes().to_vec());
    gearboxes.unwrap_or_default().into_iter().map(|gearbox| gearbox.name).collect()
}

fn sweeps() -> Vec<String> {
    let sweeps = netlist().map(|netlist| netlist.studies.sweeps).unwrap_or_default();
    sweeps.into_iter().map(|study| study.name).collect()
}

fn plans() -> Vec<String> {
    let plans = netlist().map(|netlist| netlist.studies.plans).unwrap_or_default();
    plans.into_iter().map(|study| study.name).collect()
}

fn fits() -> Vec<String> {
    let fits = netlist().map(|netlist| netlist.studies.fits).unwrap_or_default();
    fits.into_iter().map(|study| study.name).collect()
}

fn substances() -> Vec<String> {
    library::materials().iter().chain(library::fluids()).map(|record| record.name.clone()).collect()
}
