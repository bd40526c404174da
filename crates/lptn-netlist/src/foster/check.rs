//! Checks that chains are in places where their impedance is valid.

use lptn_data::Diagnostic;
use lptn_network::{CapacitorId, ConductorId, End, Field, Item, Network, NodeId, SourceId};

use super::{Chain, FOSTER};
use crate::source_map::SourceMap;

/// Errors about the places of chains.
pub(crate) fn check(chains: &[Chain], network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let of = |chain: &Chain| chain.series(network, map).or_else(|| chain.entered(network, map));
    chains.iter().filter_map(of).collect()
}

impl Chain {
    /// Error if it does not end at a boundary: the parts after it would change its time constants.
    fn series(&self, network: &Network, map: &SourceMap) -> Option<Diagnostic> {
        let last = self.resistors.last().filter(|_| !self.series)?;
        let Ok(Item::Conductor(id)) = network.item(last) else { return None };
        let End::Node(node) = network.conductors()[id.index()].to else { return None };
        let name = &network.nodes()[node.index()].name;
        let message = format!("{} `{}` ends at node `{name}`", FOSTER.name, self.name);
        let problem = Diagnostic::error("netlist::foster_series", message);
        let problem = problem.at(map.get(Item::Conductor(id), Field::To), "not a boundary");
        Some(problem.help(
            "an R-tau table is valid against a boundary only: with `series = true` a ladder of the \
             same impedance stands for the body, exact in steady state and an estimate before",
        ))
    }

    /// Error if another element is joined to its inner nodes.
    fn entered(&self, network: &Network, map: &SourceMap) -> Option<Diagnostic> {
        let inner = self.nodes.iter().skip(1).filter_map(|name| node(network, name));
        let found = self.joined(network, &inner.collect::<Vec<NodeId>>())?;
        let message = format!("{} `{}` has no inner places for a path", FOSTER.name, self.name);
        let problem = Diagnostic::error("netlist::foster_inside", message);
        let problem = problem.at(map.get(found, Field::Name), "is joined to one");
        let help = format!("join it to `{}`, or write the chain as a ladder", self.name);
        Some(problem.help(help))
    }

    /// The first element that ends at one of these nodes and is not its own.
    fn joined(&self, network: &Network, inner: &[NodeId]) -> Option<Item> {
        let is_inner = |end: End| matches!(end, End::Node(node) if inner.contains(&node));
        let enters = |id: &ConductorId| {
            let path = &network.conductors()[id.index()];
            [path.from, path.to].into_iter().any(is_inner)
                && self.resistors.iter().all(|own| *own != path.name())
        };
        let heats = |id: &SourceId| {
            network.sources()[id.index()].into.iter().any(|(node, _)| inner.contains(node))
        };
        let adds = |id: &CapacitorId| inner.contains(&network.capacitors()[id.index()].node);
        let paths = network.conductor_ids().filter(enters).map(Item::Conductor);
        let sources = network.source_ids().filter(heats).map(Item::Source);
        let capacitors = network.capacitor_ids().filter(adds).map(Item::Capacitor);
        paths.chain(sources).chain(capacitors).next()
    }
}

fn node(network: &Network, name: &str) -> Option<NodeId> {
    match network.item(name) {
        Ok(Item::Node(id)) => Some(id),
        _ => None,
    }
}
