//! What the table of a run shows.

use lptn_netlist::RunSettings;
use lptn_network::{Network, NodeId};
use lptn_solve::{Lumping, Selection, Solution, SteadyState, Table};
use lptn_units::Unit;

use crate::limits::Judged;
use crate::run::NoSteady;
use crate::uncertainty::Study;

/// More nodes than this do not fit on a screen.
pub(crate) const MOST_NODES: usize = 30;

/// The nodes that a table shows: those selected, in the order of the file; unless any is, all but the cells of grids.
/// Of too many the hottest in steady state, hottest first; where there is none, the first ones.
pub(crate) fn shown(
    network: &Network,
    selection: Option<&Selection>,
    steady: Option<&SteadyState>,
) -> Vec<NodeId> {
    let mut nodes: Vec<NodeId> = selection.into_iter().flat_map(Selection::nodes).collect();
    if nodes.is_empty() {
        nodes = network.outer_nodes().collect();
    }
    if nodes.len() > MOST_NODES {
        if let Some(steady) = steady {
            let at = |id: &NodeId| steady.temperatures[id.index()];
            nodes.sort_by(|a, b| at(b).total_cmp(&at(a)));
        }
        nodes.truncate(MOST_NODES);
    }
    nodes
}

/// Everything that the text of a run is made of.
#[derive(Clone, Debug)]
pub(crate) struct View<'a> {
    pub(crate) title: &'a str,
    pub(crate) lumping: &'a Lumping,
    /// Where the temperatures at the start come from, if not from the netlist.
    pub(crate) origin: Option<String>,
    pub(crate) solution: &'a Solution,
    pub(crate) steady: Result<&'a SteadyState, &'a NoSteady>,
    pub(crate) unit: &'a Unit,
    pub(crate) settings: &'a RunSettings,
    pub(crate) limits: &'a [Judged],
    pub(crate) uncertainty: Option<&'a Study>,
    pub(crate) table: &'a Table,
    /// Whether columns were asked for by name.
    pub(crate) chosen: bool,
}

/// "1 node", "2 nodes".
pub(crate) fn count(n: usize, noun: &str) -> String {
    let ending = if n == 1 {
        ""
    } else if noun.ends_with('y') {
        "ies"
    } else {
        "s"
    };
    let noun = if n == 1 { noun } else { noun.strip_suffix('y').unwrap_or(noun) };
    format!("{n} {noun}{ending}")
}

/// "2 nodes, 2 boundaries, 3 paths, 1 source", and controls if there are any.
pub(crate) fn counts(network: &Network) -> String {
    let mut parts = vec![
        count(network.nodes().len(), "node"),
        count(network.boundaries().len(), "boundary"),
        count(network.conductors().len(), "path"),
        count(network.sources().len(), "source"),
    ];
    if !network.controls().is_empty() {
        parts.push(count(network.controls().len(), "control"));
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn nouns_agree_with_their_number() {
        assert_eq!(count(1, "boundary"), "1 boundary");
        assert_eq!(count(2, "boundary"), "2 boundaries");
        assert_eq!(count(0, "node"), "0 nodes");
    }
}
