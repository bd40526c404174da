//! Elements whose laws are alike, evaluated together.
//!
//! Their heats are evaluated before those of the other elements, and are added in the order of the
//! elements, so that sums are the same to the last digit.

use lptn_network::{Alike, Network};

use crate::element::{Element, Kind};
use crate::outer::Outer;
use crate::positions::number;
use crate::workspace::Workspace;

/// Fewer are not worth the bookkeeping.
const LEAST: usize = 8;

/// All groups of a network.
#[derive(Clone, Debug, Default)]
pub(crate) struct Together {
    /// Groups that give heat to boundaries come first; `outer` is their number.
    groups: Vec<Group>,
    outer: usize,
}

#[derive(Clone, Debug)]
struct Group {
    alike: Alike,
    /// Positions of its elements.
    elements: Vec<u32>,
}

impl Together {
    /// Those of these elements, by their positions.
    pub(crate) fn of(
        network: &Network,
        (elements, outer): (&[Element], &Outer),
        positions: impl Iterator<Item = usize>,
    ) -> Self {
        let mut is_outer = vec![false; elements.len()];
        outer.elements.iter().for_each(|&i| is_outer[i as usize] = true);
        let (outside, inside): (Vec<usize>, Vec<usize>) = positions.partition(|&i| is_outer[i]);
        let mut groups = groups_of(network, elements, &outside);
        let outer = groups.len();
        groups.extend(groups_of(network, elements, &inside));
        Self { groups, outer }
    }

    /// The positions of all elements of its groups.
    pub(crate) fn elements(&self) -> impl Iterator<Item = u32> + '_ {
        self.groups.iter().flat_map(|group| &group.elements).copied()
    }

    /// Evaluates the heats of all groups, or of those that give heat to boundaries.
    pub(crate) fn evaluate(&self, work: &mut Workspace, elements: usize, only_outer: bool) {
        if self.groups.is_empty() {
            return;
        }
        work.together.resize(elements, f64::NAN);
        let count = if only_outer { self.outer } else { self.groups.len() };
        for Group { alike, elements } in &self.groups[..count] {
            let Workspace { scope, temperature, potentials, together, .. } = &mut *work;
            alike.heats(scope, temperature, potentials);
            for (&element, heat) in elements.iter().zip(&*potentials) {
                together[element as usize] = *heat;
            }
        }
    }
}

fn groups_of(network: &Network, elements: &[Element], positions: &[usize]) -> Vec<Group> {
    let mut element_of = vec![u32::MAX; network.conductors().len()];
    let mut ids = Vec::with_capacity(positions.len());
    for &i in positions {
        if let Kind::Conductor(id) = elements[i].kind {
            element_of[id.index()] = number(i);
            ids.push(id);
        }
    }
    let groups = network.alike(ids).into_iter().filter(|(_, members)| members.len() >= LEAST);
    let group = |(alike, members): (Alike, Vec<lptn_network::ConductorId>)| {
        let elements = members.iter().map(|id| element_of[id.index()]).collect();
        Group { alike, elements }
    };
    groups.map(group).collect()
}
