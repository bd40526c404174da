//! Why a network is not reduced.

use lptn_reduce::ReduceError;
use lptn_solve::ResponseError;
use lptn_units::Problem as _;

use crate::failure::{Failure, told};
use crate::input::{Input, quoted};
use crate::operating_point::place;

/// Most nodes that are named if no port is given.
const MOST_NAMES: usize = 8;

/// Failure of an option about the run, if the netlist has none.
pub(super) fn no_run(input: &Input, option: &str) -> Failure {
    let message = format!("{} has no [run], which {option} is about", input.text.name);
    Failure::refused(
        "run::no_run",
        message,
        "add these lines, or leave the option out:\n\n[run]\nstop = \"25 min\"",
    )
}

/// Failure if no port is named. The first node that a source heats is the likely one.
pub(super) fn no_port(input: &Input) -> Failure {
    let network = &input.netlist.network;
    let heated = network.sources().first().and_then(|source| source.into.first());
    let likely = heated.map_or("NODE", |(node, _)| &network.nodes()[node.index()].name);
    let names: Vec<String> =
        network.nodes().iter().take(MOST_NAMES).map(|node| node.name.clone()).collect();
    let more = if network.nodes().len() > MOST_NAMES { ", .." } else { "" };
    let message = format!("{}: no port is named", input.text.name);
    let file = input.typed().unwrap_or_else(|| "-".into());
    let help = format!(
        "write `lptn reduce {file} --port {}`; its nodes are {}{more}",
        quoted(likely),
        names.join(", ")
    );
    Failure::refused("reduce::no_port", message, help)
}

/// The failure of an option that is about whole runs, for a question about one state.
pub fn not_near_a_state(option: &str) -> Failure {
    let message =
        format!("{option} is about whole runs, and --at about small disturbances of a state");
    let help = "leave one of them out; R_eq, C_eq, T_ref and Q_N of the table make a netlist by \
        hand, if it is to stay near that state";
    Failure::refused("reduce::near", message, help)
}

/// A failure with its place in the file or on the command line.
pub(super) fn failed(input: &Input, port: &str, error: &ReduceError) -> Failure {
    let network = &input.netlist.network;
    let at = match error {
        ReduceError::BoundaryPort { .. } => {
            network.item(port).ok().and_then(|item| input.netlist.source_map.name(item))
        }
        ReduceError::NoGround { names } => names.first().and_then(|name| input.node_place(name)),
        ReduceError::Input(error) => input.place_of(error),
        ReduceError::Response(ResponseError::Linearised(error)) => place(input, error),
        _ => None,
    };
    let example = network
        .nodes()
        .first()
        .filter(|_| matches!(error, ReduceError::UnknownPort(_)) && error.help().is_none());
    let help = example.map(|node| format!("name a node, for example `{}`", node.name));
    input.refused(error.class().into(), told(error).at(at, "").help(help))
}
