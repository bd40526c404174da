//! Networks whose form excludes a second solution of the balances.
//!
//! A Jacobian that is an M-matrix everywhere excludes a second steady state; the signs of its
//! entries follow from the form of the network. Otherwise the network is followed from its start
//! with constant inputs (`transient/rest.rs` of `lptn-solve`).

use lptn_network::{ConductorFlow, End, Network};

use crate::system::ThermalSystem;

/// Relative excess of the outflow of a node over its inflow that still counts as rounding.
const SAME: f64 = 1e-12;

impl ThermalSystem {
    /// True if the flow is known to be monotone: with fixed inputs and positions of controls,
    /// warming one node never cools another, and takes from the node itself at least the heat that
    /// the others receive. The balances of the whole network, or of some nodes with the others
    /// fixed, then have at most one solution: the negative Jacobian is an M-matrix
    /// everywhere, hence a P-matrix, and a map whose Jacobian is that on a rectangle takes no value
    /// twice (D. Gale and H. Nikaido, Math. Annalen 159 (1965) 81, theorem 4).
    ///
    /// Known are constant conductances and exchange areas, heat transfer coefficients that rise
    /// with `|dT|`, heat that falls with its node's temperature, and constant streams of which no
    /// node gives more than it gets. `false` for everything else, and if a balance really has
    /// several solutions.
    pub fn is_monotone(&self) -> bool {
        self.is_linear() || elements_are_monotone(self.network())
    }
}

fn elements_are_monotone(network: &Network) -> bool {
    let sources = network.source_ids().all(|id| {
        let reads = network.source_variables(id);
        reads.is_empty() || network.source_falls(id)
    });
    let mut gets = vec![(0.0, 0.0); network.nodes().len()];
    let mut conductor = |(conductor, id): (&lptn_network::Conductor, _)| match network.flow(id) {
        ConductorFlow::Conductance(_) | ConductorFlow::Radiation(_) => true,
        ConductorFlow::Stream(rate) => {
            let (from, to) = if rate < 0.0 {
                (conductor.to, conductor.from)
            } else {
                (conductor.from, conductor.to)
            };
            if let End::Node(node) = from {
                gets[node.index()].1 += rate.abs();
            }
            if let End::Node(node) = to {
                gets[node.index()].0 += rate.abs();
            }
            true
        }
        ConductorFlow::Variable => network.heat_rises(id),
    };
    sources
        && network.conductors().iter().zip(network.conductor_ids()).all(&mut conductor)
        && gets.into_iter().all(|(inward, outward)| outward <= inward * (1.0 + SAME))
}
