//! Checks of a network's structure: nodes that can be solved for, islands that are tied to
//! something.

use crate::build_error::BuildError;
use crate::error::BuildErrorKind;
use crate::id::{End, NodeId};
use crate::parts::Parts;

pub(crate) fn structure(parts: &Parts, errors: &mut Vec<BuildError>) {
    // two boundaries with a path between them are a network: only the heat that passes is computed
    if parts.nodes.is_empty() && parts.conductors.is_empty() {
        errors.push(BuildError { kind: BuildErrorKind::Empty, name: String::new() });
    }
    let stores = stores_heat(parts);
    nodes(parts, &stores, errors);
    islands(parts, &stores, errors);
}

/// True for each node that has a capacity, given directly or by its parts.
fn stores_heat(parts: &Parts) -> Vec<bool> {
    let mut stores: Vec<bool> = parts.nodes.iter().map(|n| n.capacity.is_some()).collect();
    for part in &parts.capacitors {
        stores[part.node.index()] = true;
    }
    stores
}

fn nodes(parts: &Parts, stores: &[bool], errors: &mut Vec<BuildError>) {
    for (i, node) in parts.nodes.iter().enumerate() {
        let id = NodeId::from_len(i);
        if parts.state_at(id).is_some() {
            continue; // its rate and start are checked with the numbers
        }
        let kind = match (stores[i], node.massless) {
            (false, false) => BuildErrorKind::NoCapacity { node: id },
            (true, true) => BuildErrorKind::MasslessWithCapacity { node: id },
            (true, false) if node.initial.is_none() => {
                BuildErrorKind::NoInitialTemperature { node: id }
            }
            _ => continue,
        };
        errors.push(BuildError { kind, name: node.name.clone() });
    }
}

/// Sets of connected massless nodes that reach neither a capacity nor a boundary.
fn islands(parts: &Parts, stores: &[bool], errors: &mut Vec<BuildError>) {
    let islands = Islands::of(parts);
    let mut tied = vec![false; parts.nodes.len()];
    for (i, &stores) in stores.iter().enumerate() {
        // a node that wrongly has no capacity is reported as that, not as an island
        let is_state = parts.state_at(NodeId::from_len(i)).is_some();
        tied[islands.root(i)] |= stores || is_state || !parts.nodes[i].massless;
    }
    for node in islands.grounded(parts) {
        tied[islands.root(node)] = true;
    }
    for members in islands.groups().into_iter().filter(|m| !tied[islands.root(m[0])]) {
        let names: Vec<String> = members.iter().map(|&i| parts.nodes[i].name.clone()).collect();
        let nodes = members.into_iter().map(NodeId::from_len).collect();
        let name = names[0].clone();
        errors.push(BuildError { kind: BuildErrorKind::FloatingIsland { nodes, names }, name });
    }
}

/// Connected components of the nodes (boundaries do not connect), each known by its first node.
pub(crate) struct Islands {
    root: Vec<usize>,
}

impl Islands {
    pub(crate) fn of(parts: &Parts) -> Self {
        let mut parent: Vec<usize> = (0..parts.nodes.len()).collect();
        for conductor in &parts.conductors {
            if let (End::Node(a), End::Node(b)) = (conductor.from, conductor.to) {
                let (a, b) = (find(&mut parent, a.index()), find(&mut parent, b.index()));
                parent[a.max(b)] = a.min(b);
            }
        }
        let root = (0..parent.len()).map(|i| find(&mut parent, i)).collect();
        Self { root }
    }

    pub(crate) fn root(&self, node: usize) -> usize {
        self.root[node]
    }

    /// The members of each component, in order; no component is empty.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); self.root.len()];
        for (node, &root) in self.root.iter().enumerate() {
            groups[root].push(node);
        }
        groups.retain(|group| !group.is_empty());
        groups
    }

    /// The nodes that have a path straight to a boundary.
    pub(crate) fn grounded<'a>(&self, parts: &'a Parts) -> impl Iterator<Item = usize> + use<'a> {
        parts.conductors.iter().filter_map(|c| match (c.from, c.to) {
            (End::Node(node), End::Boundary(_)) | (End::Boundary(_), End::Node(node)) => {
                Some(node.index())
            }
            _ => None,
        })
    }
}

fn find(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
