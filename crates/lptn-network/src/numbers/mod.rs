//! The constants of a network, evaluated for one set of parameters.

pub(crate) mod conductance;
pub(crate) mod content;
pub(crate) mod control;
pub(crate) mod grid;
pub(crate) mod patch;
pub(crate) mod pipe;
pub(crate) mod state;
pub(crate) mod substance;

use std::sync::Arc;

use crate::along::Along;
use crate::build_error::BuildError;
use crate::enthalpy::Enthalpy;
use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{CapacitorId, End, Field, FluidId, Item, NodeId, ParameterId, SourceId};
use crate::law::ConductorFlow;
use crate::numbers::content::Curves;
use crate::parts::Parts;
use crate::parts::element::Parameter;
use crate::parts::pipe::Pipe;
use crate::parts::state_capacity::StateCapacity;
use crate::parts::whole;
use crate::slot;
use crate::value::Value;
use lptn_laws::Range;

/// The numbers that the parameters determine; checked to be physical.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    pub(crate) parameters: Vec<f64>,
    /// For each parameter whether another value than its own was given.
    pub(crate) given: Vec<bool>,
    pub(crate) capacity: Vec<f64>,
    pub(crate) initial: Vec<f64>,
    /// Up to the last conductor whose law is more than a number.
    pub(crate) flows: Vec<ConductorFlow>,
    /// Heat content of each node whose capacity is not constant, up to the last of them.
    pub(crate) enthalpy: Vec<Option<Arc<Enthalpy>>>,
    /// Heat content of a kg of each fluid whose specific heat is not constant.
    pub(crate) fluids: Vec<Option<Arc<Enthalpy>>>,
    /// The property of which each conductor takes the mean along its path, up to the last of them.
    pub(crate) along: Vec<Option<Arc<Along>>>,
    /// For each of these its conductance in W/K for a mean of 1, in SI units, if only the mean
    /// changes; else NaN.
    pub(crate) shapes: Vec<f64>,
    /// Minimum time in s that each control keeps its state after a switch.
    pub(crate) min_dwell: Vec<f64>,
    /// Least and greatest value of each state in SI units; infinite without a bound.
    pub(crate) bounds: Vec<[f64; 2]>,
    /// The time between samples of each state in s.
    pub(crate) sampling: Vec<Option<f64>>,
    pub(crate) pipes: Vec<Pipe>,
    /// The nodes whose capacity follows states, ascending.
    pub(crate) state_capacities: Vec<StateCapacity>,
}

impl Numbers {
    /// Evaluates `parts`, with the parameters of `overrides` replacing their own values.
    pub(crate) fn evaluate(
        parts: &Parts,
        overrides: &[Option<f64>],
    ) -> Result<Self, Vec<BuildError>> {
        let mut work =
            Work { parts, scope: Evaluation::new(&parts.layout, &[]), errors: Vec::new() };
        let parameters = work.parameters(overrides);
        if !work.errors.is_empty() {
            return Err(work.errors); // every value below would fail for the same reason
        }
        work.check_materials();
        work.check_fluids();
        work.check_grids();
        work.check_patches();
        work.check_lumps();
        if !work.errors.is_empty() {
            whole::collapse(parts, &mut work.errors);
            return Err(work.errors); // and so would the capacities
        }
        let initial = work.initials();
        let capacity = work.capacities(&initial);
        let state_capacities = work.state_capacities();
        let flows = work.flows();
        work.check_face_paths();
        work.check_inputs();
        work.check_sources();
        work.check_limits();
        let min_dwell = work.controls();
        let bounds = work.check_states();
        let sampling = work.sampling();
        let pipes = work.pipes();
        whole::collapse(parts, &mut work.errors);
        if !work.errors.is_empty() {
            return Err(work.errors);
        }
        let (mut enthalpy, fluids) = (work.enthalpies(&initial), work.fluid_enthalpies());
        whole::collapse(parts, &mut work.errors);
        if work.errors.is_empty() {
            let last = enthalpy.iter().rposition(Option::is_some);
            enthalpy.truncate(last.map_or(0, |last| last + 1));
            enthalpy.shrink_to_fit();
            let is_given = |i: usize| overrides.get(i).is_some_and(Option::is_some);
            let given = (0..parameters.len()).map(is_given).collect();
            let along = work.alongs();
            let shapes = work.shapes(&along);
            Ok(Self {
                parameters,
                given,
                capacity,
                initial,
                flows,
                enthalpy,
                fluids,
                along,
                shapes,
                min_dwell,
                bounds,
                sampling,
                pipes,
                state_capacities,
            })
        } else {
            Err(work.errors)
        }
    }
}

pub(crate) struct Work<'a> {
    pub(crate) parts: &'a Parts,
    pub(crate) scope: Evaluation,
    pub(crate) errors: Vec<BuildError>,
}

impl Work<'_> {
    pub(crate) fn parameters(&mut self, overrides: &[Option<f64>]) -> Vec<f64> {
        let parts = self.parts;
        let mut values = Vec::with_capacity(parts.parameters.len());
        for (i, parameter) in parts.parameters.iter().enumerate() {
            let item = Item::Parameter(ParameterId::from_len(i));
            let value = match overrides.get(i).copied().flatten() {
                Some(value) => self.in_range(item, Field::Value, value, range_of(parameter)),
                None => self.constant(item, Field::Value, &parameter.value, range_of(parameter)),
            };
            self.scope.set_parameter(i, value);
            values.push(value);
        }
        values
    }

    /// Capacities at the start.
    fn capacities(&mut self, initial: &[f64]) -> Vec<f64> {
        let parts = self.parts;
        let mut capacity: Vec<f64> = Vec::with_capacity(parts.nodes.len());
        for (i, node) in parts.nodes.iter().enumerate() {
            let item = Item::Node(NodeId::from_len(i));
            let own = node.capacity.as_ref();
            if parts.is_like_the_last_node(i) {
                capacity.push(capacity[i - 1]);
                continue;
            }
            capacity.push(own.map_or(0.0, |c| self.capacity(item, c, (initial, i))));
        }
        for (i, part) in parts.capacitors.iter().enumerate() {
            let item = Item::Capacitor(CapacitorId::from_len(i));
            let node = part.node.index();
            capacity[node] += self.capacity(item, &part.capacity, (initial, node));
        }
        capacity
    }

    /// A capacity at the start, which may depend on the temperature of its node or on states.
    fn capacity(&mut self, item: Item, value: &Value, (initial, node): (&[f64], usize)) -> f64 {
        let temperature = initial[node];
        if self.parts.follows_states(value) {
            return self.of_states(item, value, initial);
        }
        if self.parts.reads(value).own && temperature.is_finite() {
            self.scope.set(slot::OWN, temperature);
            self.check_comparisons(item, Field::Capacity, value);
            return self.own(item, Field::Capacity, value);
        }
        self.constant(item, Field::Capacity, value, Range::Positive)
    }

    /// A capacity that follows states, at their start.
    fn of_states(&mut self, item: Item, value: &Value, initial: &[f64]) -> f64 {
        let (field, reads) = (Field::Capacity, self.parts.reads(value));
        if reads.time || reads.positions {
            self.error(item, BuildErrorKind::DependsOnTime { item, field });
            return f64::NAN;
        }
        // a jump of a capacity would need the heat of the mass at its moment
        if value.programs().iter().any(|program| !program.comparisons().is_empty()) {
            self.error(item, BuildErrorKind::ComparisonNotLinear { item, field });
            return f64::NAN;
        }
        for end in reads.temperatures {
            if let End::Node(id) = end {
                self.scope.set(self.parts.layout.temperature(end), initial[id.index()]);
            }
        }
        self.evaluate(item, field, value, Range::Positive)
    }

    /// The capacities that follow states. The other parts of such a node have to be constant.
    fn state_capacities(&mut self) -> Vec<StateCapacity> {
        let found = self.parts.state_capacities();
        if found.is_empty() {
            return found;
        }
        let varying = self.parts.varying_capacities();
        for node in found.iter().map(|of| of.node).filter(|node| varying[node.index()]) {
            let (item, field) = (Item::Node(node), Field::Capacity);
            self.error(item, BuildErrorKind::DependsOnResult { item, field });
        }
        found
    }

    /// A positive value that may depend on the `T` that was set.
    fn own(&mut self, item: Item, field: Field, value: &Value) -> f64 {
        let reads = self.parts.reads(value);
        if reads.time || reads.positions {
            self.error(item, BuildErrorKind::DependsOnTime { item, field });
            return f64::NAN;
        }
        if reads.link || !reads.temperatures.is_empty() {
            self.error(item, BuildErrorKind::DependsOnResult { item, field });
            return f64::NAN;
        }
        self.evaluate(item, field, value, Range::Positive)
    }

    fn enthalpies(&mut self, initial: &[f64]) -> Vec<Option<Arc<Enthalpy>>> {
        let varying = self.parts.varying_capacities();
        let mut curves: Vec<Option<Arc<Enthalpy>>> = Vec::with_capacity(varying.len());
        let mut known = Curves::new(self.parts);
        for (i, varies) in varying.into_iter().enumerate() {
            let id = NodeId::from_len(i);
            if varies && self.parts.is_like_the_last_node(i) && self.parts.has_no_capacitors(i) {
                curves.push(curves[i - 1].clone());
                continue;
            }
            let curve =
                varies.then(|| self.parts.content_of(id, initial[i], &mut self.scope, &mut known));
            curves.push(curve.and_then(|curve| match curve {
                Ok(curve) => Some(curve),
                Err(kind) => {
                    self.error(Item::Node(id), kind);
                    None
                }
            }));
        }
        curves
    }

    fn fluid_enthalpies(&mut self) -> Vec<Option<Arc<Enthalpy>>> {
        let mut curves = Vec::with_capacity(self.parts.fluids.len());
        for i in 0..self.parts.fluids.len() {
            let fluid = FluidId::from_len(i);
            let curve = self.parts.fluid_enthalpy(fluid, &mut self.scope).unwrap_or_else(|kind| {
                self.error(Item::Fluid(fluid), kind);
                None
            });
            curves.push(curve);
        }
        curves
    }

    fn initials(&mut self) -> Vec<f64> {
        let nodes = self.parts.nodes.iter().enumerate();
        nodes
            .map(|(i, node)| {
                let item = Item::Node(NodeId::from_len(i));
                let initial = node.initial.as_ref().filter(|_| !node.massless);
                initial.map_or(f64::NAN, |t| {
                    self.constant(item, Field::Initial, t, self.parts.range_at_start(i))
                })
            })
            .collect()
    }

    /// Inputs may depend on time, sources and conductors on temperatures too: a constant one is
    /// checked now, the others when they are read.
    fn check_inputs(&mut self) {
        for (item, field, value) in self.parts.inputs() {
            let reads = self.parts.reads(value);
            let allowed = match item {
                Item::Conductor(_) => {
                    matches!(field, Field::Law(law) if law.property.is_some()) || !reads.own
                }
                Item::Control(_) => !reads.link && !reads.own,
                Item::Source(id) => !reads.link && self.names_its_node((id, field), reads.own),
                _ => !reads.reads_results(),
            };
            if !allowed {
                self.error(item, BuildErrorKind::DependsOnResult { item, field });
            }
            self.check_comparisons(item, field, value);
            let range = match (item, field) {
                (Item::Boundary(_), _) => Range::Temperature,
                (Item::Source(_), Field::Law(law)) => law.range,
                _ => continue,
            };
            if reads.is_constant() {
                self.constant(item, field, value, range);
            }
        }
    }

    /// `T` in a value of a source means one node.
    fn names_its_node(&mut self, (id, field): (SourceId, Field), own: bool) -> bool {
        let source = &self.parts.sources[id.index()];
        if own && source.into.len() != 1 {
            self.error(Item::Source(id), BuildErrorKind::WhichTemperature { source: id, field });
        }
        true
    }

    /// Checks that comparisons change at times that are known in advance.
    pub(crate) fn check_comparisons(&mut self, item: Item, field: Field, value: &Value) {
        for program in value.programs() {
            for (comparison, &relation) in program.comparisons().iter().zip(program.relations()) {
                if let Some(kind) =
                    self.parts.comparison_problem((comparison, relation), item, field)
                {
                    self.error(item, kind);
                    return;
                }
            }
        }
    }

    pub(crate) fn constant(
        &mut self,
        item: Item,
        field: Field,
        value: &Value,
        range: Range,
    ) -> f64 {
        let reads = self.parts.reads(value);
        if reads.reads_results() {
            self.error(item, BuildErrorKind::DependsOnResult { item, field });
            return f64::NAN;
        }
        if reads.time || reads.positions {
            self.error(item, BuildErrorKind::DependsOnTime { item, field });
            return f64::NAN;
        }
        self.evaluate(item, field, value, range)
    }

    pub(crate) fn evaluate(
        &mut self,
        item: Item,
        field: Field,
        value: &Value,
        range: Range,
    ) -> f64 {
        match value.at(&mut self.scope) {
            Ok(number) => self.in_range(item, field, number, range),
            Err(error) => {
                self.error(item, BuildErrorKind::Evaluation { item, field, error });
                f64::NAN
            }
        }
    }

    pub(crate) fn in_range(&mut self, item: Item, field: Field, value: f64, range: Range) -> f64 {
        let kind = match range {
            Range::Positive if !(value.is_finite() && value > 0.0) => {
                BuildErrorKind::NotPositive { item, field, value }
            }
            _ if !value.is_finite() => BuildErrorKind::NotFinite { item, field, value },
            Range::NotNegative if value < 0.0 => BuildErrorKind::Negative { item, field, value },
            Range::Fraction if !(value > 0.0 && value <= 1.0) => {
                BuildErrorKind::NotAFraction { item, field, value }
            }
            Range::Degrees(from, to) if !range.has_angle(value) => {
                BuildErrorKind::Angle { item, field, value, range: [from, to] }
            }
            Range::Count if value < 1.0 || value.fract() != 0.0 => {
                BuildErrorKind::NotCounted { item, field, value }
            }
            Range::Temperature if value < 0.0 => {
                BuildErrorKind::BelowAbsoluteZero { item, field, value }
            }
            _ => return value,
        };
        self.error(item, kind);
        value
    }

    pub(crate) fn error(&mut self, item: Item, kind: BuildErrorKind) {
        self.errors.push(BuildError { kind, name: self.parts.name_of(item).into_owned() });
    }
}

pub(crate) fn range_of(parameter: &Parameter) -> Range {
    if parameter.ty.absolute { Range::Temperature } else { Range::Finite }
}
