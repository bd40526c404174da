//! What a network is made of, before any number is computed from it.

use std::collections::HashMap;

use crate::element::{Boundary, Capacitor, Conductor, Node, Parameter, Source};
use crate::id::{BoundaryId, Field, Item, ParameterId, SourceId};
use crate::limit::Limit;
use crate::material::Material;
use crate::value::Value;

/// Everything that does not change when a parameter does.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parts {
    pub(crate) title: Option<String>,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) boundaries: Vec<Boundary>,
    pub(crate) capacitors: Vec<Capacitor>,
    pub(crate) conductors: Vec<Conductor>,
    pub(crate) sources: Vec<Source>,
    pub(crate) limits: Vec<Limit>,
    pub(crate) materials: Vec<Material>,
    /// Nodes, boundaries and elements share one name space.
    pub(crate) names: HashMap<String, Item>,
    pub(crate) parameter_names: HashMap<String, ParameterId>,
}

impl Parts {
    pub(crate) fn name_of(&self, item: Item) -> &str {
        match item {
            Item::Parameter(id) => &self.parameters[id.index()].name,
            Item::Node(id) => &self.nodes[id.index()].name,
            Item::Boundary(id) => &self.boundaries[id.index()].name,
            Item::Capacitor(id) => &self.capacitors[id.index()].name,
            Item::Conductor(id) => &self.conductors[id.index()].name,
            Item::Source(id) => &self.sources[id.index()].name,
            Item::Limit(id) => &self.limits[id.index()].name,
            Item::Material(id) => &self.materials[id.index()].name,
        }
    }

    pub(crate) fn inputs(&self) -> impl Iterator<Item = (Item, Field, &Value)> {
        let boundaries = self.boundaries.iter().enumerate();
        let sources = self.sources.iter().enumerate();
        boundaries
            .map(|(i, b)| (Item::Boundary(BoundaryId::from_len(i)), Field::Temperature, &b.temperature))
            .chain(sources.map(|(i, s)| (Item::Source(SourceId::from_len(i)), Field::Power, &s.power)))
    }
}
