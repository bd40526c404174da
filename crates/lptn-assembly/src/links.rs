//! Constant conductances: between unknowns, to boundaries and between boundaries.

use lptn_network::{ConductorFlow, Network};

use crate::eliminate::Link;

/// The constant conductances by vertex.
pub(crate) fn constant_links(network: &Network) -> Vec<Link> {
    let vertex = |end| u32::try_from(network.vertex(end)).expect("ids are 32 bits wide");
    // nearly all of a large network are among them
    let mut links = Vec::with_capacity(network.conductors().len());
    for (c, id) in network.conductors().iter().zip(network.conductor_ids()) {
        if let ConductorFlow::Conductance(g) = network.flow(id) {
            links.push(Link { a: vertex(c.from), b: vertex(c.to), g });
        }
    }
    links
}

/// Links between unknowns, from an unknown to a boundary, between boundaries. `kept` is sorted by
/// vertex and so are they: the numbers of unknowns only grow with those of nodes within states and
/// within algebraic ones.
pub(crate) fn sorted(mut kept: Vec<Link>, number: &[u32]) -> (Vec<Link>, Vec<Link>, Vec<Link>) {
    let (mut ties, mut bridges) = (Vec::new(), Vec::new());
    // most of them are links, which stay where they are
    kept.retain_mut(|link| {
        let Link { a, b, g } = *link;
        match (number[a as usize], number[b as usize]) {
            (u32::MAX, u32::MAX) => bridges.push(Link { a, b, g }),
            (a, u32::MAX) => ties.push(Link { a, b, g }),
            (u32::MAX, b) => ties.push(Link { a: b, b: a, g }),
            (a, b) => {
                *link = Link { a, b, g };
                return true;
            }
        }
        false
    });
    kept.shrink_to_fit();
    ties.shrink_to_fit();
    (kept, ties, bridges)
}
