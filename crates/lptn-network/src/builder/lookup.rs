//! Contents of a builder up to now, by name and by number.

use std::borrow::Cow;

use crate::builder::NetworkBuilder;
use crate::id::{End, Item, NodeId, StateId};
use crate::value::Value;

impl NetworkBuilder {
    /// The item of this name among the nodes, boundaries and elements added up to now; the first, if
    /// several have it.
    pub fn item(&self, name: &str) -> Option<Item> {
        self.parts.item(name)
    }

    /// The node or boundary of this name.
    pub fn end(&self, name: &str) -> Option<End> {
        match self.item(name)? {
            Item::Node(id) => Some(End::Node(id)),
            Item::Boundary(id) => Some(End::Boundary(id)),
            _ => None,
        }
    }

    /// The state of this name.
    pub fn state_named(&self, name: &str) -> Option<StateId> {
        let place = self.parts.states.iter().position(|state| state.name == name)?;
        Some(StateId::from_len(place))
    }

    /// The names of all nodes, and of all boundaries unless `only_nodes`.
    pub fn end_names(&self, only_nodes: bool) -> impl Iterator<Item = &str> {
        let nodes = self.parts.nodes.iter().map(|node| node.name.as_str());
        let boundaries = self.parts.boundaries.iter().map(|boundary| boundary.name.as_str());
        nodes.chain(boundaries.filter(move |_| !only_nodes))
    }

    /// The name of something that was added.
    pub fn name(&self, item: impl Into<Item>) -> Cow<'_, str> {
        self.parts.name_of(item.into())
    }

    /// True if a table of this name was added.
    pub fn has_table(&self, name: &str) -> bool {
        matches!(self.parts.value_names.get(name), Some(Item::Table(_)))
    }

    /// True if it is a part of a grid or of a path to a face.
    pub fn is_part(&self, item: Item) -> bool {
        self.parts.whole(item).is_some()
    }

    /// Ids of the nodes added up to now.
    pub fn node_ids(&self) -> impl Iterator<Item = NodeId> + use<> {
        (0..self.parts.nodes.len()).map(NodeId::from_len)
    }

    /// True if the node was added without capacity.
    pub fn is_massless(&self, node: NodeId) -> bool {
        self.parts.nodes[node.index()].massless
    }

    /// Sets the temperature at the start in K: the start itself for a node with capacity, the first
    /// trial for a massless one.
    pub fn start_at(&mut self, node: NodeId, temperature: crate::Temperature) {
        let start = &mut self.parts.nodes[node.index()];
        match start.massless {
            true => start.body_mut().stood = Some(temperature.0),
            false => start.initial = Some(Value::Constant(temperature.0)),
        }
    }

    /// Number of nodes added up to now.
    pub fn node_count(&self) -> usize {
        self.parts.nodes.len()
    }

    /// Number of boundaries added up to now.
    pub fn boundary_count(&self) -> usize {
        self.parts.boundaries.len()
    }

    /// Number of conductors added up to now.
    pub fn conductor_count(&self) -> usize {
        self.parts.conductors.len()
    }

    /// Number of sources added up to now.
    pub fn source_count(&self) -> usize {
        self.parts.sources.len()
    }
}
