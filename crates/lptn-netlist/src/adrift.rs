//! Unconnected parts: nodes without a path to a boundary, boundaries that nothing touches.

use lptn_data::Diagnostic;
use lptn_network::{End, Item, Network, list_of, list_of_names};

use crate::source_map::SourceMap;

/// The warnings. A boundary that an expression or a control reads is not idle; `is_read` knows the
/// boundaries of expressions.
pub(crate) fn warnings(
    network: &Network,
    map: &SourceMap,
    is_read: &dyn Fn(&str) -> bool,
) -> impl Iterator<Item = Diagnostic> {
    [ungrounded(network, map), idle(network, map, is_read)].into_iter().flatten()
}

/// Nodes without a path to a boundary: a path may have been forgotten.
fn ungrounded(network: &Network, map: &SourceMap) -> Option<Diagnostic> {
    let nodes: Vec<_> = network.ungrounded().into_iter().flatten().collect();
    let first = *nodes.first()?;
    let names: Vec<String> =
        nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
    let message = format!("no path leads to a boundary from {}", list_of_names(&names));
    let warning = Diagnostic::warning("network::no_boundary", message).help(
        "add a path if heat is to get out; without one the energy at the start decides the steady \
         state",
    );
    Some(warning.at(map.name(Item::Node(first)), ""))
}

fn idle(network: &Network, map: &SourceMap, is_read: &dyn Fn(&str) -> bool) -> Option<Diagnostic> {
    let mut touched = vec![false; network.boundaries().len()];
    let ends = network.conductors().iter().flat_map(|conductor| [conductor.from, conductor.to]);
    let sensed = network.control_ids().filter_map(|id| Some(network.thermostat(id)?.sense));
    for end in ends.chain(sensed) {
        if let End::Boundary(id) = end {
            touched[id.index()] = true;
        }
    }
    let idle: Vec<_> = network
        .boundary_ids()
        .filter(|id| !touched[id.index()] && !is_read(&network.boundaries()[id.index()].name))
        .collect();
    let first = *idle.first()?;
    let names: Vec<String> =
        idle.iter().map(|id| network.boundaries()[id.index()].name.clone()).collect();
    let noun = if names.len() == 1 { "boundary" } else { "boundaries" };
    let message = format!("nothing touches {noun} {}", list_of(&names, "boundaries"));
    let warning = Diagnostic::warning("network::idle_boundary", message)
        .help("end a path there, or remove it; a path that leads elsewhere may be the cause");
    Some(warning.at(map.name(Item::Boundary(first)), ""))
}
