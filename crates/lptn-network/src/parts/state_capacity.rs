//! Capacities that follow states, such as that of a tank whose mass changes.

use std::collections::BTreeSet;

use crate::id::{CapacitorId, End, Item, NodeId};
use crate::parts::Parts;
use crate::value::Value;

/// A node whose capacity follows states. Its temperature obeys `C dT/dt = q` with the capacity at
/// the moment: mass that comes in by a stream brings its heat, mass that leaves has the temperature
/// of the node.
#[derive(Clone, Debug)]
pub struct StateCapacity {
    /// The node.
    pub node: NodeId,
    /// The nodes of the states that its capacity reads, ascending.
    pub states: Vec<NodeId>,
    /// The slots of these.
    pub(crate) slots: Vec<u32>,
    /// The capacities in J/K that add up to it.
    pub(crate) parts: Vec<(Item, Value)>,
}

impl Parts {
    /// True if a value reads states, and no other temperature. A state with a balance or with samples
    /// has no rate: it does not count.
    pub(crate) fn follows_states(&self, value: &Value) -> bool {
        let reads = self.reads(value);
        let is_state = |end: &End| {
            let End::Node(node) = end else { return false };
            self.state_at(*node).is_some_and(|id| {
                let state = &self.states[id.index()];
                !state.balanced && state.every.is_none()
            })
        };
        let others = reads.own || reads.link || reads.temperatures.is_empty();
        !others && reads.temperatures.iter().all(is_state)
    }

    /// The nodes whose capacity follows states, ascending.
    pub(crate) fn state_capacities(&self) -> Vec<StateCapacity> {
        if self.states.is_empty() {
            return Vec::new();
        }
        let own = self.nodes.iter().enumerate().filter_map(|(i, node)| {
            let id = NodeId::from_len(i);
            Some((id, Item::Node(id), node.capacity.as_ref()?))
        });
        let capacitors = self.capacitors.iter().enumerate().map(|(i, part)| {
            (part.node, Item::Capacitor(CapacitorId::from_len(i)), &part.capacity)
        });
        let all: Vec<(NodeId, Item, &Value)> = own.chain(capacitors).collect();
        let following = all.iter().filter(|(.., value)| self.follows_states(value));
        let following: BTreeSet<NodeId> = following.map(|(node, ..)| *node).collect();
        let one = |node: NodeId| {
            let parts = all.iter().filter(|part| part.0 == node);
            self.state_capacity(node, parts.map(|(_, item, value)| (*item, (*value).clone())))
        };
        following.into_iter().map(one).collect()
    }

    fn state_capacity(
        &self,
        node: NodeId,
        parts: impl Iterator<Item = (Item, Value)>,
    ) -> StateCapacity {
        let parts: Vec<(Item, Value)> = parts.collect();
        let read = parts.iter().flat_map(|(_, value)| self.reads(value).temperatures);
        let states: BTreeSet<NodeId> = read.filter_map(node_of).collect();
        let slots = states.iter().map(|id| self.layout.temperature(End::Node(*id))).collect();
        StateCapacity { node, states: states.into_iter().collect(), slots, parts }
    }
}

fn node_of(end: End) -> Option<NodeId> {
    match end {
        End::Node(id) => Some(id),
        End::Boundary(_) => None,
    }
}
