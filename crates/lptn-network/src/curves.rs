//! Values that curve over time, sampled before a run so that the integrator resolves them.

use std::collections::BTreeSet;
use std::sync::Arc;

use lptn_units::{Degree, Program, SlotKind};

use crate::evaluation::Evaluation;
use crate::id::{End, Item};
use crate::network::Network;
use crate::parts::Parts;
use crate::parts::layout::Holds;
use crate::parts::watched::Watched;
use crate::slot;
use crate::value::Value;

/// Temperatures above the start, in K, at which a value is sampled if temperatures change its time
/// history.
const RISES: [f64; 4] = [0.0, 10.0, 100.0, -30.0];

/// The start in K of a node that has none.
const USUAL: f64 = 300.0;

/// A value that is not a straight line in time between [`Network::breakpoints`], or a part of one
/// that reads no temperature.
#[derive(Clone, Debug)]
pub struct Curve {
    value: Value,
    held: Option<Held>,
}

/// Temperatures at which a value is sampled.
#[derive(Clone, Debug)]
struct Held {
    /// In K over the start of every node.
    rise: f64,
    /// Ends of the element at hand, and vertices read by name.
    ends: Option<[End; 2]>,
    named: Vec<(u32, End)>,
}

impl Network {
    /// The curves among the inputs of the heat flows. If a value reads temperatures too, these are
    /// its largest parts that read none. If time and temperature enter one function together, the
    /// whole value at some temperatures is added.
    pub fn curves(&self) -> Vec<Curve> {
        let mut found = Found::default();
        for (item, _, value) in
            self.inputs().filter(|(item, _, _)| !matches!(item, Item::Signal(_)))
        {
            if found.is_new(value) && self.parts.look_for_curves(value, &mut found.curves) {
                self.hold(item, value, &mut found.curves);
            }
        }
        let signals = self.parts.driving();
        self.parts.curves_of_signals(&signals, &mut found);
        found.distinct()
    }

    /// The same for results: limits, reports and signals.
    pub fn result_curves(&self, items: &[Item]) -> Vec<Curve> {
        let mut found = Found::default();
        let watched = self.parts.results(items);
        for value in &watched.values {
            if found.is_new(value) {
                self.parts.look_for_curves(value, &mut found.curves);
            }
        }
        found.distinct()
    }

    /// The value of a curve at `time` in s, with comparisons as they are at `inside` in s; `None`
    /// if it has none.
    pub fn curve_at(
        &self,
        curve: &Curve,
        scope: &mut Evaluation,
        (time, inside): (f64, f64),
    ) -> Option<f64> {
        scope.set_time(time, inside);
        self.curve_here(curve, scope)
    }

    /// The value of a curve at the time of `scope`; `None` if it has none.
    pub fn curve_here(&self, curve: &Curve, scope: &mut Evaluation) -> Option<f64> {
        if let Some(held) = &curve.held {
            self.place_held(held, scope);
        }
        curve.value.at(scope).ok()
    }

    fn place_held(&self, held: &Held, scope: &mut Evaluation) {
        if let Some([from, to]) = held.ends {
            let [from, to] = [from, to].map(|end| self.held_temperature(end, held.rise, scope));
            let mean = 0.5 * (from + to);
            let slots = [slot::FROM, slot::TO, slot::MEAN, slot::DIFFERENCE];
            slots
                .into_iter()
                .zip([from, to, mean, from - to])
                .for_each(|(slot, t)| scope.set(slot, t));
            // of a source both ends are its node
            scope.set(slot::OWN, mean);
        }
        for &(slot, end) in &held.named {
            let temperature = self.held_temperature(end, held.rise, scope);
            scope.set(slot, temperature);
        }
    }

    fn held_temperature(&self, end: End, rise: f64, scope: &mut Evaluation) -> f64 {
        match end {
            // a massless node need not have a start
            End::Node(id) => {
                Some(self.initial(id)).filter(|t| t.is_finite()).unwrap_or(USUAL) + rise
            }
            End::Boundary(id) => {
                self.boundaries()[id.index()].temperature.at(scope).unwrap_or(f64::NAN)
            }
        }
    }

    /// Adds a value as a whole, at some temperatures.
    fn hold(&self, item: Item, value: &Value, curves: &mut Vec<Curve>) {
        let ends = match item {
            Item::Conductor(id) => {
                let conductor = &self.conductors()[id.index()];
                Some([conductor.from, conductor.to])
            }
            Item::Source(id) => {
                self.sources()[id.index()].into.first().map(|&(node, _)| [End::Node(node); 2])
            }
            _ => None,
        };
        let named =
            value.slots().into_iter().filter_map(|slot| match self.parts.layout.holds(slot) {
                Holds::Temperature(end) => Some((slot, end)),
                _ => None,
            });
        let named: Vec<(u32, End)> = named.collect();
        let held = RISES.map(|rise| Held { rise, ends, named: named.clone() });
        curves.extend(held.map(|held| Curve { value: value.clone(), held: Some(held) }));
    }
}

/// Curves, and the values they were looked for in.
#[derive(Default)]
struct Found {
    curves: Vec<Curve>,
    /// Addresses of the programs in memory: cells of a grid share one.
    seen: BTreeSet<usize>,
}

impl Found {
    fn is_new(&mut self, value: &Value) -> bool {
        match value {
            Value::Constant(_) => false,
            Value::Expression(program) => self.seen.insert(Arc::as_ptr(program).addr()),
            Value::Product(factors) => self.seen.insert(Arc::as_ptr(factors).addr()),
        }
    }

    /// Each part once, however often it occurs.
    fn distinct(self) -> Vec<Curve> {
        let mut known = BTreeSet::new();
        let mut curves = self.curves;
        curves.retain(|curve| {
            let programs = curve.value.programs().into_iter().map(|program| program.fingerprint());
            curve.held.is_some() || known.insert(programs.collect::<Vec<String>>())
        });
        curves
    }
}

impl Parts {
    /// Adds the curves of a value. Returns true if the whole value has to be sampled too, as time
    /// and temperatures enter one function.
    fn look_for_curves(&self, value: &Value, curves: &mut Vec<Curve>) -> bool {
        let is_foreign = |slot: u32| self.slot_kind(slot) == SlotKind::Foreign;
        if !value.slots().into_iter().any(is_foreign) {
            if self.course(value) == Degree::Nonlinear {
                curves.push(Curve { value: value.clone(), held: None });
            }
            return false;
        }
        let mut entangled = false;
        for program in value.programs() {
            let split = program.split(&|slot| self.slot_kind(slot));
            entangled |= split.entangled;
            let curved = split
                .parts
                .into_iter()
                .filter(|part: &Program| self.course_of(part) == Degree::Nonlinear);
            curves.extend(
                curved.map(|part| Curve { value: Value::Expression(part.into()), held: None }),
            );
        }
        // a factor that switches has no value before the run
        let positions =
            |slot: u32| matches!(self.layout.holds(slot), Holds::Control(_) | Holds::Switch(_));
        entangled && !value.slots().into_iter().any(positions)
    }

    fn curves_of_signals(&self, watched: &Watched<'_>, found: &mut Found) {
        for (signal, _) in
            self.layout.signals().iter().zip(&watched.signals).filter(|(_, used)| **used)
        {
            if let crate::Course::Expression(value) = &signal.course
                && found.is_new(value)
            {
                self.look_for_curves(value, &mut found.curves);
            }
        }
    }

    fn slot_kind(&self, slot: u32) -> SlotKind {
        match self.layout.holds(slot) {
            Holds::Time | Holds::Signal(_) => SlotKind::Varying,
            // their truth does not change inside a segment
            Holds::FrozenTime | Holds::FrozenSignal(_) | Holds::Parameter(_) => SlotKind::Fixed,
            Holds::Link
            | Holds::Own
            | Holds::Temperature(_)
            | Holds::Heat(_)
            | Holds::Grid(_)
            | Holds::Control(_)
            | Holds::Switch(_) => SlotKind::Foreign,
        }
    }
}
