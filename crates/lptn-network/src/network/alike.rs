//! Paths whose laws and expressions are the same except for numbers, evaluated together.
//!
//! A template, a loop of a script or an import makes hundreds of films with one expression. An
//! expression alone costs some hundred instructions to find its way; on lanes it does so once for
//! eight paths. The arithmetic is that of [`Network::exchange`], to the last digit.

use std::collections::BTreeMap;
use std::sync::Arc;

use lptn_laws::{Formula, radiation_conductance};
use lptn_units::{LANES, Lanes, Program};

use crate::evaluation::Evaluation;
use crate::id::ConductorId;
use crate::law::{ConductorFlow, Law, impossible};
use crate::network::Network;
use crate::slot;
use crate::value::Value;

/// The most values of a law that is evaluated together with others.
const MOST: usize = 4;

/// Paths with one law, in the order of their ids.
#[derive(Clone, Debug)]
pub struct Alike {
    formula: Formula,
    fields: Vec<OfAll>,
    /// The two vertices of each, nodes before boundaries.
    ends: Vec<[u32; 2]>,
    radiates: bool,
}

/// The values of one field.
#[derive(Clone, Debug)]
enum OfAll {
    Numbers(Vec<f64>),
    Program(Arc<Program>),
}

/// Key of paths whose programs are compared: a law and the texts of its expressions.
type Key<'a> = (Formula, Vec<Option<&'a str>>);

impl Network {
    /// Sorts these conductors into groups that are alike, each with its members. A conductor that no
    /// other one is like is a group of one; those that cannot be evaluated together are left out.
    pub fn alike(
        &self,
        ids: impl IntoIterator<Item = ConductorId>,
    ) -> Vec<(Alike, Vec<ConductorId>)> {
        let mut groups: Vec<(Alike, Vec<ConductorId>)> = Vec::new();
        let mut known: BTreeMap<Key<'_>, Vec<usize>> = BTreeMap::new();
        for id in ids {
            let law = &self.conductors()[id.index()].law;
            let Some(key) = self.lane_key(id, law) else { continue };
            let same = known.entry(key).or_default();
            let place = same.iter().copied().find(|&place| groups[place].0.takes(law));
            let place = place.unwrap_or_else(|| {
                groups.push((Alike::of(law), Vec::new()));
                same.push(groups.len() - 1);
                groups.len() - 1
            });
            let (alike, members) = &mut groups[place];
            let [from, to] = [0, 1].map(|k| self.conductor_variables(id)[k]);
            alike.push(law, [from, to]);
            members.push(id);
        }
        groups
    }

    /// `None` if a conductor depends on more than its two ends, takes a mean along its path, or
    /// has an expression with branches.
    fn lane_key<'a>(&self, id: ConductorId, law: &'a Law) -> Option<Key<'a>> {
        let dependence = self.parts.dependence(id);
        let plain = self.flow(id) == ConductorFlow::Variable
            && !law.is_stream()
            && self.along(id).is_none()
            && dependence.vertices.len() == 2
            && dependence.named.is_empty()
            && law.values().len() <= MOST;
        let text = |value: &'a Value| match value {
            Value::Constant(_) => Some(None),
            Value::Expression(program) if program.runs_on_lanes() => Some(Some(program.text())),
            Value::Expression(_) | Value::Product(_) => None,
        };
        if !plain {
            return None;
        }
        let texts: Option<Vec<_>> = law.values().iter().map(text).collect();
        Some((law.formula(), texts?))
    }
}

impl Alike {
    fn of(law: &Law) -> Self {
        let field = |value: &Value| match value {
            Value::Expression(program) => OfAll::Program(Arc::clone(program)),
            _ => OfAll::Numbers(Vec::new()),
        };
        Self {
            formula: law.formula(),
            fields: law.values().iter().map(field).collect(),
            ends: Vec::new(),
            radiates: law.carries() == lptn_laws::Carries::Radiation,
        }
    }

    fn takes(&self, law: &Law) -> bool {
        let same = |(field, value): (&OfAll, &Value)| match (field, value) {
            (OfAll::Numbers(_), Value::Constant(_)) => true,
            (OfAll::Program(own), Value::Expression(other)) => {
                Arc::ptr_eq(own, other) || own.does_the_same(other)
            }
            _ => false,
        };
        self.fields.iter().zip(law.values()).all(same)
    }

    fn push(&mut self, law: &Law, ends: [u32; 2]) {
        self.ends.push(ends);
        for (field, value) in self.fields.iter_mut().zip(law.values()) {
            if let (OfAll::Numbers(numbers), Value::Constant(value)) = (field, value) {
                numbers.push(*value);
            }
        }
    }

    /// Writes the heat from the first end of each to its second in W, at the time of `scope` and
    /// these temperatures of all vertices in K; NaN for those that have to be evaluated one by one,
    /// because one among their neighbours has no heat.
    pub fn heats(&self, scope: &mut Evaluation, temperatures: &[f64], out: &mut Vec<f64>) {
        out.clear();
        let mut stack = Vec::new();
        for first in (0..self.ends.len()).step_by(LANES) {
            let count = LANES.min(self.ends.len() - first);
            let heats = self.heats_of(first, (scope, temperatures), &mut stack);
            out.extend_from_slice(&heats.unwrap_or([f64::NAN; LANES])[..count]);
        }
    }

    /// The heats of the paths from one on; lanes after the last path repeat it.
    fn heats_of(
        &self,
        first: usize,
        (scope, temperatures): (&mut Evaluation, &[f64]),
        stack: &mut Vec<Lanes>,
    ) -> Option<Lanes> {
        let path = |lane: usize| (first + lane).min(self.ends.len() - 1);
        let end = |k: usize| -> Lanes {
            std::array::from_fn(|lane| temperatures[self.ends[path(lane)][k] as usize])
        };
        let (from, to) = (end(0), end(1));
        let mean: Lanes = std::array::from_fn(|lane| (from[lane] + to[lane]) * 0.5);
        let load = |slot: u32| match slot {
            slot::FROM => from,
            slot::TO => to,
            slot::MEAN | slot::OWN => mean,
            slot::DIFFERENCE => std::array::from_fn(|lane| from[lane] - to[lane]),
            other => [scope.slot(other); LANES],
        };
        let mut values = [[0.0; LANES]; MOST];
        for (field, values) in self.fields.iter().zip(&mut values) {
            *values = match field {
                OfAll::Numbers(numbers) => std::array::from_fn(|lane| numbers[path(lane)]),
                OfAll::Program(program) => program.eval_lanes(load, stack)?,
            };
        }
        let mut heats = [0.0; LANES];
        for (lane, heat) in heats.iter_mut().enumerate() {
            let values = values.map(|of_all| of_all[lane]);
            *heat = self.heat(&values[..self.fields.len()], [from[lane], to[lane]])?;
        }
        Some(heats)
    }

    /// The heat of one of them, if it has any.
    fn heat(&self, values: &[f64], [from, to]: [f64; 2]) -> Option<f64> {
        let declared = self.formula.declaration().fields;
        if declared.iter().zip(values).any(|(field, value)| impossible(field, *value).is_some()) {
            return None;
        }
        let value = self.formula.value(values, [from, to]);
        let conductance =
            if self.radiates { radiation_conductance(value, from, to) } else { value };
        let heat = conductance * (from - to);
        (conductance >= 0.0 && heat.is_finite()).then_some(heat)
    }
}
