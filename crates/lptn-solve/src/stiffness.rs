//! Ratio of the time constants of the nodes of a network.

use lptn_network::{ConductorFlow, End, Network, NodeId};

/// The nodes that follow their surroundings fastest and slowest, each with its own time constant C
/// / sum of G in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// The node with the smallest time constant.
    pub fastest: (NodeId, f64),
    /// The node with the largest time constant.
    pub slowest: (NodeId, f64),
}

impl Stiffness {
    /// Considers the nodes with a capacity and a path or stream of constant conductance; `None`
    /// without any.
    ///
    /// These are the time constants that each node would have if its neighbours kept their
    /// temperatures, the diagonal of the system, and not those of the network (its modes); but
    /// their ratio shows the difficulty for an explicit method.
    pub fn of(network: &Network) -> Option<Self> {
        let mut conductance = vec![0.0; network.nodes().len()];
        for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
            let (ends, size) = match network.flow(id) {
                // only the end that a stream flows into follows it
                ConductorFlow::Stream(rate) if rate < 0.0 => (vec![conductor.from], -rate),
                ConductorFlow::Stream(rate) => (vec![conductor.to], rate),
                _ => (vec![conductor.from, conductor.to], network.conductance(id).unwrap_or(0.0)),
            };
            for end in ends {
                if let End::Node(node) = end {
                    conductance[node.index()] += size;
                }
            }
        }
        let constant = |id: NodeId| (id, network.capacity(id) / conductance[id.index()]);
        let stores = |id: &NodeId| network.capacity(*id) > 0.0 && conductance[id.index()] > 0.0;
        let constants: Vec<(NodeId, f64)> =
            network.node_ids().filter(stores).map(constant).collect();
        let by_time = |a: &&(NodeId, f64), b: &&(NodeId, f64)| a.1.total_cmp(&b.1);
        let fastest = *constants.iter().min_by(by_time)?;
        Some(Self { fastest, slowest: *constants.iter().max_by(by_time)? })
    }

    /// The larger time constant over the smaller.
    pub fn ratio(&self) -> f64 {
        self.slowest.1 / self.fastest.1
    }
}
