//! Cells, surfaces and the conductors of a path to a face, as parts of a whole.
//!
//! Cells, surfaces and the parts of a path to a face are ordinary nodes and conductors that know
//! their whole (`Network::whole`). Columns, balances, errors and places refer to the whole.

use crate::build_error::BuildError;
use crate::id::{ConductorId, FacePathId, Item, NodeId};
use crate::parts::Parts;
use crate::parts::grid::{FacePath, Inner};

fn whole_of(inner: &[Inner], index: u32) -> Option<Item> {
    let place = inner.partition_point(|part| part.end <= index);
    inner.get(place).filter(|part| part.first <= index).map(|part| part.whole)
}

impl Parts {
    /// The grid or joint that a cell, a surface or a path is a part of.
    pub(crate) fn whole(&self, item: Item) -> Option<Item> {
        match item {
            Item::Node(id) => whole_of(&self.inner_nodes, id.0),
            Item::Conductor(id) => whole_of(&self.inner_conductors, id.0),
            _ => None,
        }
    }

    /// The joints of more than one conductor; the others are known by their conductor.
    pub(crate) fn shared_face_paths(&self) -> impl Iterator<Item = FacePathId> + '_ {
        let shared = |(_, joint): &(usize, &FacePath)| {
            joint.conductors().next().is_some_and(|id| self.whole(Item::Conductor(id)).is_some())
        };
        self.face_paths.iter().enumerate().filter(shared).map(|(i, _)| FacePathId::from_len(i))
    }

    /// True if a node and the one before it belong to one grid and have the same values: a result
    /// for one is valid for the other, except for capacitors.
    pub(crate) fn is_like_the_last_node(&self, index: usize) -> bool {
        let whole = |i: usize| self.whole(Item::Node(NodeId::from_len(i)));
        let Some(last) = index.checked_sub(1) else { return false };
        whole(index).is_some()
            && whole(index) == whole(last)
            && self.nodes[last].is_same(&self.nodes[index])
    }

    /// The same for a conductor of a grid or joint.
    pub(crate) fn is_like_the_last_conductor(&self, index: usize) -> bool {
        let whole = |i: usize| self.whole(Item::Conductor(ConductorId::from_len(i)));
        let Some(last) = index.checked_sub(1) else { return false };
        whole(index).is_some()
            && whole(index) == whole(last)
            && self.conductors[last].law.is_same(&self.conductors[index].law)
    }

    /// True if no capacitor belongs to a node or to the one before it.
    pub(crate) fn has_no_capacitors(&self, index: usize) -> bool {
        self.capacitors
            .iter()
            .all(|part| part.node.index() != index && part.node.index() + 1 != index)
    }
}

/// Reports a problem of parts as one problem of the whole.
pub(crate) fn collapse(parts: &Parts, errors: &mut Vec<BuildError>) {
    let mut told: Vec<(Item, &'static str)> = Vec::new();
    errors.retain_mut(|error| {
        let Some(whole) = error.place().and_then(|(item, _)| parts.whole(item)) else {
            return true;
        };
        let key = (whole, error.code());
        error.name = parts.name_of(whole).into_owned();
        let new = !told.contains(&key);
        if new {
            told.push(key);
        }
        new
    });
}
