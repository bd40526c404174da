//! Finds the dependences of values and elements.

use std::borrow::Cow;

use std::collections::BTreeMap;
use std::sync::Arc;

use lptn_laws::Carries;

use crate::along::Along;
use crate::id::{ConductorId, End, Item, SignalId};
use crate::parts::Parts;
use crate::parts::control::Control;
use crate::parts::dependence::{Dependence, OfConductor, Reads, Vertices};
use crate::parts::element::{Conductor, Source};
use crate::parts::layout::Holds;
use crate::slot;
use crate::value::Value;

impl Dependence {
    fn add(&mut self, parts: &Parts, end: End) {
        let vertex = parts.vertex(end);
        let position = self.vertices.iter().position(|&v| v == vertex).unwrap_or_else(|| {
            self.vertices.push(vertex);
            self.vertices.len() - 1
        });
        self.named.push((parts.layout.temperature(end), position));
    }
}

impl Parts {
    /// Position of an end among all vertices: nodes, then boundaries.
    pub(crate) fn vertex(&self, end: End) -> u32 {
        let index = match end {
            End::Node(id) => id.index(),
            End::Boundary(id) => self.nodes.len() + id.index(),
        };
        u32::try_from(index).expect("ids are 32 bits wide")
    }

    /// The slots that a value reads, also through signals that are expressions.
    pub(crate) fn reads(&self, value: &Value) -> Reads {
        let mut reads = Reads::default();
        if let Value::Constant(_) = value {
            return reads; // nearly all values of a large network
        }
        value.each_slot(&mut |slot| match self.layout.holds(slot) {
            Holds::Time | Holds::FrozenTime | Holds::Signal(_) | Holds::FrozenSignal(_) => {
                reads.time = true;
            }
            Holds::Link => reads.link = true,
            Holds::Own => reads.own = true,
            Holds::Temperature(end) => reads.temperatures.push(end),
            Holds::Control(_) | Holds::Switch(_) => reads.positions = true,
            Holds::Parameter(_) | Holds::Heat(_) | Holds::Grid(_) => {}
        });
        reads.temperatures.sort_unstable();
        reads.temperatures.dedup();
        reads
    }

    /// True if a value of an item reads a signal, through other signals too.
    pub(crate) fn uses_signal(&self, item: Item, signal: SignalId) -> bool {
        let own = self.inputs().filter(|(of, _, _)| *of == item).map(|(_, _, value)| value);
        let limit = match item {
            Item::Limit(id) => Some(self.limits[id.index()].sides()),
            _ => None,
        };
        self.watched(own.chain(limit.into_iter().flatten()).collect(), &[]).signals[signal.index()]
    }

    /// Marks the signals that a value reads itself.
    pub(crate) fn mark_signals(&self, value: &Value, used: &mut [bool]) {
        value.each_slot(&mut |slot| {
            if let Holds::Signal(id) | Holds::FrozenSignal(id) = self.layout.holds(slot) {
                used[id.index()] = true;
            }
        });
    }

    /// True if the heat of a conductor is more than a constant times a difference or a stream.
    pub(crate) fn is_variable(&self, conductor: &Conductor) -> bool {
        if conductor.law.is_number() {
            return false;
        }
        let fluid = conductor.law.fluid().map(|id| &self.fluids[id.index()].cp);
        conductor.law.formula().declaration().reads_ends
            || conductor.law.values().iter().chain(fluid).any(|v| !self.reads(v).is_constant())
    }

    /// The temperatures that a conductor was found to depend on; none for a constant one.
    pub(crate) fn dependence(&self, id: ConductorId) -> Cow<'_, Dependence> {
        match self.conductor_dependence.get(id.index()) {
            None | Some(OfConductor::Nothing) => Cow::default(),
            Some(OfConductor::Ends) => Cow::Owned(self.ends_of(&self.conductors[id.index()])),
            Some(OfConductor::More(at)) => Cow::Borrowed(&self.more_dependences[*at as usize]),
        }
    }

    fn ends_of(&self, conductor: &Conductor) -> Dependence {
        let ends = [conductor.from, conductor.to].map(|end| self.vertex(end));
        Dependence { vertices: Vertices::from_slice(&ends), named: Vec::new() }
    }

    /// The temperatures a conductor depends on.
    pub(crate) fn conductor_dependence(&self, conductor: &Conductor) -> Dependence {
        let mut dependence = self.ends_of(conductor);
        for value in conductor.law.values() {
            self.reads(value).temperatures.into_iter().for_each(|end| dependence.add(self, end));
        }
        dependence
    }

    /// The temperatures a source depends on: its own node first, if it reads that; none if it
    /// depends on time only.
    pub(crate) fn source_dependence(&self, source: &Source) -> Dependence {
        let reads: Vec<Reads> = source.law.values().iter().map(|value| self.reads(value)).collect();
        let mut dependence = Dependence::default();
        let own = reads.iter().any(|reads| reads.own);
        if let (true, Some(&(node, _))) = (own, source.into.first()) {
            dependence.vertices.push(self.vertex(End::Node(node)));
            dependence.named.push((slot::OWN, 0));
        }
        let named = reads.into_iter().flat_map(|reads| reads.temperatures);
        named.for_each(|end| dependence.add(self, end));
        dependence
    }

    /// The temperatures that the thresholds of a control depend on.
    fn control_dependence(&self, control: &Control) -> Dependence {
        let mut dependence = Dependence::default();
        let thresholds =
            control.thermostat.iter().flat_map(|thermostat| [&thermostat.on, &thermostat.off]);
        for value in thresholds {
            self.reads(value).temperatures.into_iter().for_each(|end| dependence.add(self, end));
        }
        dependence
    }

    /// For each node, true if it is massless and has only constant conductances around it, so that
    /// it can be eliminated.
    pub(crate) fn linear_massless(&self) -> Vec<bool> {
        let mut linear: Vec<bool> = self.nodes.iter().map(|node| node.massless).collect();
        let mut touch = |vertex: u32| {
            if let Some(flag) = linear.get_mut(vertex as usize) {
                *flag = false;
            }
        };
        for (i, conductor) in self.conductors.iter().enumerate() {
            let dependence = self.dependence(ConductorId::from_len(i));
            let proportional = conductor.law.carries() == Carries::Conductance;
            if !proportional || !dependence.vertices.is_empty() {
                touch(self.vertex(conductor.from));
                touch(self.vertex(conductor.to));
                dependence.vertices.iter().for_each(|&v| touch(v));
            }
        }
        for (source, dependence) in self.sources.iter().zip(&self.source_dependence) {
            dependence.vertices.iter().for_each(|&v| touch(v));
            if !dependence.vertices.is_empty() {
                source.into.iter().for_each(|&(node, _)| touch(self.vertex(End::Node(node))));
            }
        }
        // nothing but its balance determines a state
        self.states.iter().for_each(|state| linear[state.node.index()] = false);
        linear
    }

    /// Determines the dependences of all elements once.
    pub(crate) fn settle(&mut self) {
        self.hold_comparisons();
        let last = self.conductors.iter().rposition(|conductor| self.is_variable(conductor));
        let until_last = self.conductors.iter().take(last.map_or(0, |last| last + 1));
        let mut all = Vec::new();
        let of = |conductor: &Conductor| match self.is_variable(conductor) {
            false => OfConductor::Nothing,
            true => match self.conductor_dependence(conductor) {
                ends if ends.is_ends() => OfConductor::Ends,
                more => {
                    all.push(more);
                    OfConductor::More(u32::try_from(all.len() - 1).expect("ids are 32 bits wide"))
                }
            },
        };
        let conductors = until_last.map(of).collect();
        self.more_dependences = all;
        let sources = self.sources.iter().map(|s| self.source_dependence(s)).collect();
        self.conductor_dependence = conductors;
        self.source_dependence = sources;
        self.control_dependence =
            self.controls.iter().map(|c| self.control_dependence(c)).collect();
        self.along = self.alongs();
    }

    /// True if a path takes the mean of this value: it reads its own temperature.
    pub(crate) fn is_along(&self, value: &Value) -> bool {
        !matches!(value, Value::Constant(_)) && value.slots().contains(&slot::OWN)
    }

    /// The properties that paths take the mean of and that no parameter changes.
    fn alongs(&self) -> Vec<Option<Arc<Along>>> {
        let taken = |conductor: &Conductor| {
            let value = conductor.law.along().filter(|value| self.is_along(value));
            value.cloned()
        };
        let last = self.conductors.iter().rposition(|conductor| taken(conductor).is_some());
        let mut known: BTreeMap<usize, Option<Arc<Along>>> = BTreeMap::new();
        let until_last = self.conductors.iter().take(last.map_or(0, |last| last + 1));
        let own = until_last.map(|conductor| {
            let value = taken(conductor)?;
            known.entry(value.address()).or_insert_with(|| self.unchanging(&value)).clone()
        });
        own.collect()
    }

    fn unchanging(&self, value: &Value) -> Option<Arc<Along>> {
        let slots = value.slots();
        let moves =
            |slot: &u32| !matches!(self.layout.holds(*slot), Holds::Own | Holds::Parameter(_));
        if slots.iter().any(moves) {
            return Some(Arc::new(Along::moving(value)));
        }
        let own = slots.iter().all(|slot| *slot == slot::OWN);
        own.then(|| Arc::new(Along::fixed(value, &[f64::NAN; slot::FIXED])))
    }
}
