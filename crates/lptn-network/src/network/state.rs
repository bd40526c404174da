//! States among the nodes and sources of a network.

use crate::evaluation::Evaluation;
use crate::id::{Field, Item, NodeId, SourceId, StateId, SwitchId};
use crate::network::Network;
use crate::parts::state::State;

impl Network {
    /// The state that a node contains; `None` for a body.
    pub fn state_at(&self, node: NodeId) -> Option<&State> {
        self.parts.state_at(node).map(|id| &self.states()[id.index()])
    }

    /// The state that a source changes; `None` for a source of heat.
    pub fn state_of(&self, source: SourceId) -> Option<&State> {
        self.parts.state_of(source).map(|id| &self.states()[id.index()])
    }

    /// The item and field that an author wrote: the rate of a state in place of a heat.
    pub fn as_written(&self, item: Item, field: Field) -> (Item, Field) {
        self.parts.as_written(item, field)
    }

    /// The state of this name.
    pub fn state(&self, name: &str) -> Option<StateId> {
        self.state_ids().find(|id| self.states()[id.index()].name == name)
    }

    /// True for a node that is a body or a junction, and no state.
    pub fn is_thermal(&self, node: NodeId) -> bool {
        self.parts.state_at(node).is_none()
    }

    /// The nodes that are bodies or junctions, and no states.
    pub fn thermal_nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.node_ids().filter(|id| self.is_thermal(*id))
    }

    /// The sources of heat: those that change no state.
    pub fn heat_sources(&self) -> impl Iterator<Item = SourceId> + '_ {
        self.source_ids().filter(|id| self.state_of(*id).is_none())
    }

    /// Sets the heat of the sources that change states to zero: they are in no balance.
    pub fn without_states(&self, sources: &mut [f64]) {
        let changing = self.states().iter().filter_map(|state| state.source);
        changing.for_each(|id| sources[id.index()] = 0.0);
    }

    /// The first node below 0 K; the node of a state may be.
    pub fn first_below_zero(&self, nodes: &[f64]) -> Option<usize> {
        let mut below = nodes.iter().enumerate().filter(|(_, t)| **t < 0.0).map(|(i, _)| i);
        below.find(|i| self.is_thermal(NodeId::from_len(*i)))
    }

    /// The value of a state at these temperatures of all nodes in K, in SI units: between its
    /// bounds, which its node passes by a small part of the tolerance.
    pub fn state_value(&self, id: StateId, nodes: &[f64]) -> f64 {
        let state = &self.states()[id.index()];
        let [least, most] = self.numbers.bounds[id.index()];
        state.value(nodes[state.node.index()]).max(least).min(most)
    }

    /// Sets the temperatures of all nodes and boundaries in K for results: states are between their
    /// bounds.
    pub fn place_temperatures(&self, scope: &mut Evaluation, nodes: &[f64], boundaries: &[f64]) {
        let mut inside: Option<Vec<f64>> = None;
        for (state, id) in self.states().iter().zip(self.state_ids()) {
            let (node, [least, most]) = (state.node.index(), self.state_bounds(id));
            let t = nodes[node];
            let bound = if t < least { Some(least) } else { Some(most).filter(|most| t > *most) };
            if let Some(bound) = bound {
                inside.get_or_insert_with(|| nodes.to_vec())[node] = bound;
            }
        }
        scope.set_temperatures(inside.as_deref().unwrap_or(nodes), boundaries);
    }

    /// Least and greatest temperature in K of the node of a state: its bounds.
    pub fn state_bounds(&self, id: StateId) -> [f64; 2] {
        let state = &self.states()[id.index()];
        self.numbers.bounds[id.index()].map(|bound| state.kelvin(bound))
    }

    /// The sampled states, each with the time between its samples in s.
    pub fn sampled_states(&self) -> impl Iterator<Item = (StateId, f64)> + '_ {
        self.state_ids().zip(&self.numbers.sampling).filter_map(|(id, every)| Some((id, (*every)?)))
    }

    /// The name of the first sampled state.
    pub fn first_sampled(&self) -> Option<String> {
        let (id, _) = self.sampled_states().next()?;
        Some(self.states()[id.index()].name.clone())
    }

    /// The values of all states, as [`Network::state_value`].
    pub fn state_values<'a>(&'a self, nodes: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.state_ids().map(|id| self.state_value(id, nodes))
    }

    /// The item and field of a switch, as an author wrote them: those of a state at a bound are the
    /// last of its comparisons.
    pub fn place_of_switch(&self, id: SwitchId) -> (Item, Field) {
        let switch = &self.switches()[id.index()];
        let (item, field) = self.as_written(switch.item, switch.field);
        let Item::State(state) = item else { return (item, field) };
        let behind = self.switches()[id.index() + 1..].iter();
        let behind = behind.filter(|other| other.item == switch.item).count();
        let [least, most] = &self.states()[state.index()].bounds;
        let bounds = [least.as_ref().map(|_| Field::Least), most.as_ref().map(|_| Field::Most)];
        let field = bounds.into_iter().flatten().nth(behind).unwrap_or(field);
        (item, field)
    }
}
