//! Inputs that change with time, among those that a quantity of the results depends on.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::id::{BoundaryId, ConductorId, ControlId, End, Field, Item, NodeId, SignalId, SourceId};
use crate::network::Network;
use crate::parts::Parts;
use crate::parts::heat::HeatOf;
use crate::parts::layout::Holds;
use crate::parts::signal::Course;
use crate::value::Value;

/// Something that changes with time by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Changing {
    /// The value that changes; `None` if it is the quantity itself that reads the time or a signal.
    pub input: Option<(Item, Field)>,
    /// The signal that it follows; `None` if it reads `t`.
    pub signal: Option<SignalId>,
}

impl Changing {
    /// The item that a message names: the signal, or the item that reads `t`.
    pub fn item(&self) -> Option<Item> {
        self.signal.map(Item::Signal).or(self.input.map(|(item, _)| item))
    }
}

impl Network {
    /// The inputs that change with time and that a temperature or heat flow depends on, each once:
    /// a signal that nothing uses does not count, nor does one with the same value at all its
    /// points.
    pub fn changing_inputs(&self) -> Vec<Changing> {
        let mut walk = Walk::new(&self.parts);
        if walk.can_change(&[]) {
            walk.all_elements();
        }
        walk.found()
    }

    /// The inputs that change with time and that one of these values of the results depends on,
    /// each once. Changes beyond a boundary do not reach a node.
    pub fn changing_inputs_of(&self, values: &[&Value]) -> Vec<Changing> {
        let mut walk = Walk::new(&self.parts);
        if walk.can_change(values) {
            values.iter().for_each(|value| walk.take(None, value));
            walk.spread();
        }
        walk.found()
    }
}

/// Goes from quantities to all that they depend on.
struct Walk<'a> {
    parts: &'a Parts,
    /// Conductors and sources at each vertex; empty until the first is needed.
    around: Vec<Vec<Element>>,
    seen: BTreeSet<Element>,
    waiting: Vec<Element>,
    found: BTreeSet<Changing>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Element {
    Vertex(u32),
    Conductor(usize),
    Source(usize),
    Control(usize),
    Switch(usize),
}

impl<'a> Walk<'a> {
    fn new(parts: &'a Parts) -> Self {
        Self {
            parts,
            around: Vec::new(),
            seen: BTreeSet::new(),
            waiting: Vec::new(),
            found: BTreeSet::new(),
        }
    }

    /// True if anything changes at all; nearly always nothing does, and no path has to be followed.
    fn can_change(&self, values: &[&Value]) -> bool {
        let inputs = self.parts.inputs().map(|(_, _, value)| value);
        inputs.chain(values.iter().copied()).any(|value| self.parts.reads(value).time)
    }

    fn all_elements(&mut self) {
        let conductors = (0..self.parts.conductors.len()).map(Element::Conductor);
        let sources = (0..self.parts.sources.len()).map(Element::Source);
        self.waiting = conductors.chain(sources).collect();
        self.seen = self.waiting.iter().copied().collect();
        self.spread();
    }

    fn found(self) -> Vec<Changing> {
        self.found.into_iter().collect()
    }

    fn spread(&mut self) {
        while let Some(element) = self.waiting.pop() {
            self.visit(element);
        }
    }

    fn go(&mut self, element: Element) {
        if self.seen.insert(element) {
            self.waiting.push(element);
        }
    }

    fn go_to(&mut self, end: End) {
        self.go(Element::Vertex(self.parts.vertex(end)));
    }

    fn visit(&mut self, element: Element) {
        let parts = self.parts;
        match element {
            Element::Vertex(vertex) => self.vertex(vertex as usize),
            Element::Conductor(i) => {
                let (item, conductor) =
                    (Item::Conductor(ConductorId::from_len(i)), &parts.conductors[i]);
                for (field, value) in conductor.law.parts() {
                    self.take(Some((item, field)), value);
                }
                [conductor.from, conductor.to].into_iter().for_each(|end| self.go_to(end));
            }
            Element::Source(i) => {
                let (item, source) = (Item::Source(SourceId::from_len(i)), &parts.sources[i]);
                for (field, value) in source.law.parts() {
                    self.take(Some((item, field)), value);
                }
                source.into.iter().for_each(|&(node, _)| self.go_to(node.into()));
            }
            Element::Control(i) => {
                let item = Item::Control(ControlId::from_len(i));
                for (_, field, value) in parts.thresholds().filter(|(of, _, _)| *of == item) {
                    self.take(Some((item, field)), value);
                }
                parts.controls[i]
                    .thermostat
                    .iter()
                    .for_each(|thermostat| self.go_to(thermostat.sense));
            }
            Element::Switch(i) => {
                let switch = &parts.switches[i];
                let difference = Value::Expression(Arc::clone(&switch.difference));
                self.take(Some((switch.item, switch.field)), &difference);
            }
        }
    }

    fn vertex(&mut self, vertex: usize) {
        let Some(boundary) = vertex.checked_sub(self.parts.nodes.len()) else {
            if self.around.is_empty() {
                self.around = around(self.parts);
            }
            std::mem::take(&mut self.around[vertex])
                .into_iter()
                .for_each(|element| self.go(element));
            return;
        };
        let item = Item::Boundary(BoundaryId::from_len(boundary));
        let parts = self.parts;
        self.take(Some((item, Field::Temperature)), &parts.boundaries[boundary].temperature);
    }

    /// Takes in everything that a value reads.
    fn take(&mut self, input: Option<(Item, Field)>, value: &Value) {
        for slot in value.slots() {
            match self.parts.layout.holds(slot) {
                Holds::Time | Holds::FrozenTime => {
                    self.found.insert(Changing { input, signal: None });
                }
                Holds::Signal(id) | Holds::FrozenSignal(id) if self.parts.signal_changes(id) => {
                    self.found.insert(Changing { input, signal: Some(id) });
                }
                Holds::Temperature(end) => self.go_to(end),
                Holds::Heat(heat) => self.heat(heat),
                Holds::Control(id) => self.go(Element::Control(id.index())),
                Holds::Switch(id) => self.go(Element::Switch(id.index())),
                Holds::Grid(value) => {
                    let members = self.parts.grid_value_members(value);
                    members.into_iter().for_each(|node| self.go(Element::Vertex(node)));
                }
                Holds::Signal(_)
                | Holds::FrozenSignal(_)
                | Holds::Link
                | Holds::Own
                | Holds::Parameter(_) => {}
            }
        }
    }

    fn heat(&mut self, heat: HeatOf) {
        let parts = self.parts;
        match heat {
            HeatOf::Conductor(id)
            | HeatOf::ReceivedFrom(id)
            | HeatOf::ReceivedTo(id)
            | HeatOf::Told(Item::Conductor(id), _) => {
                self.go(Element::Conductor(id.index()));
            }
            HeatOf::Told(Item::Source(id), _) | HeatOf::Source(id) => {
                self.go(Element::Source(id.index()))
            }
            HeatOf::Boundary(id) => {
                let touches = |end: End| end == End::Boundary(id);
                let own = parts
                    .conductors
                    .iter()
                    .enumerate()
                    .filter(|(_, c)| touches(c.from) || touches(c.to));
                own.for_each(|(i, _)| self.go(Element::Conductor(i)));
            }
            HeatOf::Told(..) => {}
            HeatOf::FacePath(id) => {
                let all = parts.face_paths[id.index()].conductors();
                all.for_each(|id| self.go(Element::Conductor(id.index())));
            }
        }
    }
}

/// The conductors and sources at each node.
fn around(parts: &Parts) -> Vec<Vec<Element>> {
    let mut around = vec![Vec::new(); parts.nodes.len()];
    let mut at = |node: NodeId, element: Element| around[node.index()].push(element);
    for (i, conductor) in parts.conductors.iter().enumerate() {
        for end in [conductor.from, conductor.to] {
            if let End::Node(node) = end {
                at(node, Element::Conductor(i));
            }
        }
    }
    for (i, source) in parts.sources.iter().enumerate() {
        source.into.iter().for_each(|&(node, _)| at(node, Element::Source(i)));
    }
    around
}

impl Parts {
    /// True if a signal has more than one value over time.
    fn signal_changes(&self, id: SignalId) -> bool {
        let differ =
            |values: &[f64]| values.windows(2).any(|pair| pair[0].to_bits() != pair[1].to_bits());
        match &self.layout.signals()[id.index()].course {
            Course::Curve { points, .. } => differ(points.values()),
            Course::Steps { values, .. } => differ(values),
            // a signal reads only those before it
            Course::Expression(value) => {
                value.slots().into_iter().any(|slot| match self.layout.holds(slot) {
                    Holds::Time | Holds::FrozenTime => true,
                    Holds::Signal(of) | Holds::FrozenSignal(of) => self.signal_changes(of),
                    _ => false,
                })
            }
        }
    }
}
