//! The parts of a network, before any number is computed from them.
//!
//! Lists end after the last element that needs an entry (`flows`, `conductor_dependence`,
//! `enthalpy`). Beyond that entry the law is its number, so a linear network has empty lists. Rare
//! fields of a node are in a separate allocation (`Body`, reached by `Deref`); the cells of a grid
//! share it.

pub(crate) mod control;
pub(crate) mod dependence;
pub(crate) mod element;
pub(crate) mod face;
pub(crate) mod face_stream;
pub(crate) mod functional;
pub(crate) mod grid;
pub(crate) mod grid_names;
mod grid_parts;
pub(crate) mod grid_value;
pub(crate) mod heat;
pub(crate) mod hold;
mod holding;
mod inside;
pub(crate) mod label;
pub(crate) mod layout;
pub(crate) mod named;
pub(crate) mod named_value;
pub(crate) mod overlap;
pub(crate) mod patch;
mod patch_area;
pub(crate) mod pipe;
pub(crate) mod placement;
pub(crate) mod reads;
pub(crate) mod result;
pub(crate) mod rings;
pub(crate) mod shape;
pub(crate) mod signal;
pub(crate) mod state;
pub(crate) mod state_capacity;
pub(crate) mod substance;
pub(crate) mod switch;
pub(crate) mod watched;
pub(crate) mod whole;

use std::borrow::Cow;
use std::sync::Arc;

use foldhash::HashMap;
use lptn_units::TableSymbol;

use crate::along::Along;
use crate::id::{
    BoundaryId, ConductorId, ControlId, Field, Item, NodeId, ParameterId, SignalId, SourceId,
    StateId,
};
use crate::name_index::NameIndex;
use crate::parts::control::Control;
use crate::parts::dependence::{Dependence, OfConductor};
use crate::parts::element::{Boundary, Capacitor, Conductor, Node, Parameter, Source};
use crate::parts::face_stream::FaceStream;
use crate::parts::grid::{FacePath, Grid, Inner};
use crate::parts::label::{CONDUCTOR, Label, parsed};
use crate::parts::layout::Layout;
use crate::parts::named_value::NamedValue;
use crate::parts::pipe::PipePart;
use crate::parts::result::{Limit, Report};
use crate::parts::signal::Course;
use crate::parts::state::State;
use crate::parts::substance::{Fluid, Material};
use crate::parts::switch::Switch;
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
    pub(crate) reports: Vec<Report>,
    pub(crate) controls: Vec<Control>,
    pub(crate) switches: Vec<Switch>,
    /// In the order of their nodes.
    pub(crate) states: Vec<State>,
    pub(crate) named_values: Vec<NamedValue>,
    pub(crate) pipes: Vec<PipePart>,
    pub(crate) materials: Vec<Material>,
    pub(crate) fluids: Vec<Fluid>,
    pub(crate) grids: Vec<Grid>,
    pub(crate) face_paths: Vec<FacePath>,
    pub(crate) face_streams: Vec<FaceStream>,
    /// The nodes and conductors that are parts of grids and joints, in order.
    pub(crate) inner_nodes: Vec<Inner>,
    pub(crate) inner_conductors: Vec<Inner>,
    /// Tables by name, in the order of addition.
    pub(crate) tables: Vec<(String, TableSymbol)>,
    /// The signals are here, with the slots of everything that expressions may name.
    pub(crate) layout: Arc<Layout>,
    /// The temperatures that each conductor depends on, up to the last one that depends on any.
    pub(crate) conductor_dependence: Vec<OfConductor>,
    pub(crate) more_dependences: Vec<Dependence>,
    /// For each conductor the property of which it takes the mean along its path, if that reads no
    /// parameter; up to the last conductor that takes one at all.
    pub(crate) along: Vec<Option<Arc<Along>>>,
    /// For each source the temperatures it depends on.
    pub(crate) source_dependence: Vec<Dependence>,
    /// For each control the temperatures that its thresholds depend on.
    pub(crate) control_dependence: Vec<Dependence>,
    /// Nodes, boundaries and elements share one name space.
    pub(crate) names: NameIndex,
    /// The first conductor without its own name, and its number.
    pub(crate) numbered_conductors: Option<(usize, u32)>,
    /// The first source without its own name, and its number.
    pub(crate) numbered_sources: Option<(usize, u32)>,
    pub(crate) parameter_names: HashMap<String, ParameterId>,
    /// Parameters, signals and tables share another.
    pub(crate) value_names: HashMap<String, Item>,
}

impl Parts {
    /// The state that a node contains.
    pub(crate) fn state_at(&self, node: NodeId) -> Option<StateId> {
        let place = self.states.binary_search_by_key(&node, |state| state.node).ok()?;
        Some(StateId::from_len(place))
    }

    /// The state that a source changes.
    pub(crate) fn state_of(&self, source: SourceId) -> Option<StateId> {
        let place = self.states.iter().position(|state| state.source == Some(source))?;
        Some(StateId::from_len(place))
    }

    /// The item and field that an author wrote: the rate of a state in place of a heat.
    pub(crate) fn as_written(&self, item: Item, field: Field) -> (Item, Field) {
        match item {
            Item::Source(source) => match self.state_of(source) {
                Some(state) => (Item::State(state), self.states[state.index()].law()),
                None => (item, field),
            },
            _ => (item, field),
        }
    }

    /// The item of this name among nodes, boundaries and elements.
    pub(crate) fn item(&self, name: &str) -> Option<Item> {
        self.indexed(name).or_else(|| self.inside_a_grid(name)).or_else(|| self.numbered(name))
    }

    /// The same, if its name does not follow from that of a grid or from its number.
    pub(crate) fn indexed(&self, name: &str) -> Option<Item> {
        let is = |item: Item| match item {
            // found most often by far
            Item::Node(id) => self.nodes[id.index()].name == name,
            _ => self.name_of(item) == name,
        };
        self.names.find(name, is)
    }

    /// The names of all nodes, boundaries and elements.
    pub(crate) fn element_names(&self) -> Vec<Cow<'_, str>> {
        let nodes = self.nodes.iter().map(|node| Cow::from(&node.name));
        let boundaries = self.boundaries.iter().map(|boundary| Cow::from(&boundary.name));
        let capacitors = self.capacitors.iter().map(|capacitor| Cow::from(&capacitor.name));
        let conductors = self.conductors.iter().map(Conductor::name);
        let sources = self.sources.iter().map(Source::name);
        let limits = self.limits.iter().map(|limit| Cow::from(&limit.name));
        nodes
            .chain(boundaries)
            .chain(capacitors)
            .chain(conductors)
            .chain(sources)
            .chain(limits)
            .collect()
    }

    pub(crate) fn name_of(&self, item: Item) -> Cow<'_, str> {
        let name: &str = match item {
            Item::Parameter(id) => &self.parameters[id.index()].name,
            Item::Node(id) => &self.nodes[id.index()].name,
            Item::Boundary(id) => &self.boundaries[id.index()].name,
            Item::Capacitor(id) => &self.capacitors[id.index()].name,
            Item::Conductor(id) => return self.conductors[id.index()].name(),
            Item::Source(id) => return self.sources[id.index()].name(),
            Item::Limit(id) => &self.limits[id.index()].name,
            Item::Material(id) => &self.materials[id.index()].name,
            Item::Fluid(id) => &self.fluids[id.index()].name,
            Item::Signal(id) => &self.layout.signals()[id.index()].name,
            Item::Table(id) => &self.tables[id.index()].0,
            Item::Report(id) => &self.reports[id.index()].name,
            Item::Control(id) => &self.controls[id.index()].name,
            Item::Grid(id) => &self.grids[id.index()].name,
            Item::FacePath(id) => &self.face_paths[id.index()].name,
            Item::Patch(patch) => {
                return self.grids[patch.at.grid.index()].patch_name(patch).into();
            }
            Item::State(id) => &self.states[id.index()].name,
            Item::Value(id) => &self.named_values[id.index()].name,
        };
        name.into()
    }

    /// Every value that may depend on time: temperatures of boundaries, values of sources and of
    /// conductors, signals that are expressions, thresholds of controls.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = (Item, Field, &Value)> {
        let boundaries = self.boundaries.iter().enumerate();
        let sources = self.sources.iter().enumerate();
        let conductors =
            self.conductors.iter().enumerate().filter(|(_, conductor)| !conductor.law.is_number());
        let signals = self.layout.signals().iter().enumerate();
        boundaries
            .map(|(i, b)| {
                (Item::Boundary(BoundaryId::from_len(i)), Field::Temperature, &b.temperature)
            })
            .chain(sources.flat_map(|(i, s)| {
                let item = Item::Source(SourceId::from_len(i));
                s.law.parts().map(move |(field, value)| (item, field, value))
            }))
            .chain(conductors.flat_map(|(i, c)| {
                let item = Item::Conductor(ConductorId::from_len(i));
                c.law.parts().map(move |(field, value)| (item, field, value))
            }))
            .chain(signals.filter_map(|(i, s)| match &s.course {
                Course::Expression(value) => {
                    Some((Item::Signal(SignalId::from_len(i)), Field::Value, value))
                }
                _ => None,
            }))
            .chain(self.thresholds())
    }

    /// The thresholds of all controls.
    pub(crate) fn thresholds(&self) -> impl Iterator<Item = (Item, Field, &Value)> {
        let thermostats =
            self.controls.iter().enumerate().filter_map(|(i, c)| Some((i, c.thermostat.as_ref()?)));
        thermostats.flat_map(|(i, thermostat)| {
            let item = Item::Control(ControlId::from_len(i));
            let [on, off] = thermostat.acts.fields();
            [(item, on, &thermostat.on), (item, off, &thermostat.off)]
        })
    }
}

impl Parts {
    /// The conductor or source whose name is made of its number.
    pub(crate) fn numbered(&self, name: &str) -> Option<Item> {
        let (kind, number) = parsed(name)?;
        if kind == CONDUCTOR {
            let at = position(
                self.conductors.iter().map(|c| &c.label),
                self.numbered_conductors,
                number,
            )?;
            return Some(Item::Conductor(ConductorId::from_len(at)));
        }
        let at = position(self.sources.iter().map(|s| &s.label), self.numbered_sources, number)?;
        Some(Item::Source(SourceId::from_len(at)))
    }
}

/// Position of the label with this number. Usually each number is one more than the last, from the
/// one at `first`.
fn position<'a>(
    mut labels: impl ExactSizeIterator<Item = &'a Label> + Clone,
    first: Option<(usize, u32)>,
    number: u32,
) -> Option<usize> {
    let is = |label: &Label| matches!(label, Label::Number(other) if *other == number);
    let (first, at_first) = first?;
    let guess = first + number.checked_sub(at_first)? as usize;
    if labels.clone().nth(guess).is_some_and(is) { Some(guess) } else { labels.position(is) }
}
