//! Capacities that follow states, such as that of a tank whose mass changes.

use std::collections::BTreeSet;

use lptn_units::Scalar;

use crate::evaluation::{Evaluation, PASS};
use crate::id::{CapacitorId, End, Field, Item, NodeId};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::network::flow::seeded;
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
    slots: Vec<u32>,
    /// The capacities in J/K that add up to it.
    parts: Vec<(Item, Value)>,
}

impl Parts {
    /// True if a value reads states, and no other temperature. A state with a balance has no rate:
    /// it does not count.
    pub(crate) fn follows_states(&self, value: &Value) -> bool {
        let reads = self.reads(value);
        let is_state = |end: &End| {
            let End::Node(node) = end else { return false };
            self.state_at(*node).is_some_and(|id| !self.states[id.index()].balanced)
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

impl Network {
    /// The nodes whose capacity follows states, ascending.
    pub fn state_capacities(&self) -> &[StateCapacity] {
        &self.numbers.state_capacities
    }

    /// True if the capacity of a node changes during a run: with its temperature or with states.
    pub fn capacity_varies(&self, node: NodeId) -> bool {
        self.enthalpy(node).is_some() || self.capacity_of_states(node).is_some()
    }

    /// The capacity of a node, if it follows states.
    pub fn capacity_of_states(&self, node: NodeId) -> Option<&StateCapacity> {
        self.state_capacities().iter().find(|of| of.node == node)
    }

    /// The first node whose capacity changes during a run.
    pub fn first_varying_capacity(&self) -> Option<NodeId> {
        self.node_ids().find(|id| self.capacity_varies(*id))
    }

    /// The capacity in J/K at these temperatures of all nodes in K.
    ///
    /// # Errors
    /// [`InputError`] if it has no value or is not positive.
    pub fn capacity_at(
        &self,
        of: &StateCapacity,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        for (slot, node) in of.slots.iter().zip(&of.states) {
            scope.set(*slot, temperatures[node.index()]);
        }
        let mut sum = 0.0;
        for (item, value) in &of.parts {
            let capacity = value.at(scope);
            sum += self.positive(capacity.map_err(InputProblem::from), *item, scope)?;
        }
        Ok(sum)
    }

    /// The same; also writes its derivatives in J/K^2 by the temperatures of the nodes of
    /// [`StateCapacity::states`].
    ///
    /// # Errors
    /// As [`Network::capacity_at`].
    pub fn capacity_slopes(
        &self,
        of: &StateCapacity,
        scope: &mut Evaluation,
        temperatures: &[f64],
        slopes: &mut Vec<f64>,
    ) -> Result<f64, InputError> {
        slopes.clear();
        slopes.resize(of.states.len(), 0.0);
        for first in (0..of.states.len()).step_by(PASS) {
            for (item, value) in &of.parts {
                let (slots, stack) = scope.dual();
                for (k, (slot, node)) in of.slots.iter().zip(&of.states).enumerate() {
                    slots[*slot as usize] = seeded(temperatures[node.index()], k, first);
                }
                let dual = value.on(slots, stack).map_err(InputProblem::from);
                let dual = match dual {
                    Ok(dual) => {
                        self.positive(Ok(dual.value()), *item, scope)?;
                        dual
                    }
                    Err(problem) => {
                        return Err(self.failed(*item, (Field::Capacity, problem), scope));
                    }
                };
                let pass = slopes[first..].iter_mut().zip(dual.derivatives);
                pass.for_each(|(slope, own)| *slope += own);
            }
        }
        self.capacity_at(of, scope, temperatures)
    }

    /// A capacity, or the reason why it is none.
    fn positive(
        &self,
        capacity: Result<f64, InputProblem>,
        item: Item,
        scope: &Evaluation,
    ) -> Result<f64, InputError> {
        let problem = match capacity {
            Ok(value) if !value.is_finite() => InputProblem::NotFinite(value),
            Ok(value) if value <= 0.0 => InputProblem::NoCapacity(value),
            Ok(value) => return Ok(value),
            Err(problem) => problem,
        };
        Err(self.failed(item, (Field::Capacity, problem), scope))
    }
}
