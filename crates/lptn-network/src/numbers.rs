//! The constants of a network, evaluated for one set of parameters.

use std::sync::Arc;

use crate::element::{Conductor, Parameter};
use crate::enthalpy::Enthalpy;
use crate::error::{BuildError, BuildErrorKind};
use crate::evaluation::Evaluation;
use crate::flow::Flow;
use crate::id::{
    CapacitorId, ConductorId, Field, FluidId, Item, LimitId, MaterialId, NodeId, ParameterId, SourceId,
};
use crate::law::{At, Law, Stream};
use crate::layout::slot;
use crate::parts::Parts;
use crate::thermal::Curves;
use crate::value::Value;

/// What the parameters determine; checked to be physical.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    pub(crate) parameters: Vec<f64>,
    pub(crate) capacity: Vec<f64>,
    pub(crate) initial: Vec<f64>,
    pub(crate) flows: Vec<Flow>,
    /// Heat content of each node whose capacity is not constant.
    pub(crate) enthalpy: Vec<Option<Arc<Enthalpy>>>,
    /// Heat content of a kg of each fluid whose specific heat is not constant.
    pub(crate) fluids: Vec<Option<Arc<Enthalpy>>>,
    /// How long each control stays as it is after a switch, in s.
    pub(crate) min_dwell: Vec<f64>,
}

impl Numbers {
    /// Evaluates `parts`, with the parameters of `overrides` in place of their own values.
    pub(crate) fn evaluate(parts: &Parts, overrides: &[Option<f64>]) -> Result<Self, Vec<BuildError>> {
        let mut work = Work { parts, scope: Evaluation::new(&parts.layout, &[]), errors: Vec::new() };
        let parameters = work.parameters(overrides);
        if !work.errors.is_empty() {
            return Err(work.errors); // every value below would fail for the same reason
        }
        work.check_materials();
        work.check_fluids();
        work.check_lumps();
        if !work.errors.is_empty() {
            return Err(work.errors); // and so would the capacities
        }
        let initial = work.initials();
        let capacity = work.capacities(&initial);
        let flows = work.flows();
        work.check_inputs();
        work.check_limits();
        let min_dwell = work.controls();
        if !work.errors.is_empty() {
            return Err(work.errors);
        }
        let (enthalpy, fluids) = (work.enthalpies(&initial), work.fluid_enthalpies());
        if work.errors.is_empty() {
            Ok(Self { parameters, capacity, initial, flows, enthalpy, fluids, min_dwell })
        } else {
            Err(work.errors)
        }
    }
}

/// What a number has to be.
#[derive(Clone, Copy)]
pub(crate) enum Range {
    Finite,
    Positive,
    Temperature,
    /// Above 0, at most 1.
    Fraction,
}

pub(crate) struct Work<'a> {
    pub(crate) parts: &'a Parts,
    pub(crate) scope: Evaluation,
    errors: Vec<BuildError>,
}

impl Work<'_> {
    fn parameters(&mut self, overrides: &[Option<f64>]) -> Vec<f64> {
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
            capacity.push(own.map_or(0.0, |c| self.capacity(item, c, initial[i])));
        }
        for (i, part) in parts.capacitors.iter().enumerate() {
            let item = Item::Capacitor(CapacitorId::from_len(i));
            let node = part.node.index();
            capacity[node] += self.capacity(item, &part.capacity, initial[node]);
        }
        capacity
    }

    /// A capacity may depend on the temperature of its own node.
    fn capacity(&mut self, item: Item, value: &Value, temperature: f64) -> f64 {
        if self.parts.reads(value).own && temperature.is_finite() {
            self.scope.set(slot::OWN, temperature);
            self.check_comparisons(item, Field::Capacity, value);
            return self.own(item, Field::Capacity, value);
        }
        self.constant(item, Field::Capacity, value, Range::Positive)
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
        let mut curves = Vec::with_capacity(varying.len());
        let mut known = Curves::new();
        for (i, varies) in varying.into_iter().enumerate() {
            let id = NodeId::from_len(i);
            let curve = varies.then(|| self.parts.enthalpy_of(id, initial[i], &mut self.scope, &mut known));
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
            let curve = self.parts.fluid_enthalpy(fluid, &mut self.scope);
            if curve.is_err() {
                let field = Field::SpecificHeat;
                self.error(Item::Fluid(fluid), BuildErrorKind::FluidUnknown { fluid, field });
            }
            curves.push(curve.ok().flatten());
        }
        curves
    }

    fn initials(&mut self) -> Vec<f64> {
        let nodes = self.parts.nodes.iter().enumerate();
        nodes
            .map(|(i, node)| {
                let item = Item::Node(NodeId::from_len(i));
                let initial = node.initial.as_ref().filter(|_| !node.massless);
                initial.map_or(f64::NAN, |t| self.constant(item, Field::Initial, t, Range::Temperature))
            })
            .collect()
    }

    fn flows(&mut self) -> Vec<Flow> {
        let conductors = self.parts.conductors.iter().enumerate();
        conductors.map(|(i, c)| self.flow(Item::Conductor(ConductorId::from_len(i)), c)).collect()
    }

    fn flow(&mut self, item: Item, conductor: &Conductor) -> Flow {
        let errors_before = self.errors.len();
        let law = &conductor.law;
        for (field, value) in law.parts() {
            if self.parts.reads(value).is_constant() {
                self.constant(item, field, value, range_of_field(field));
            }
        }
        self.check_shape(item, law);
        if self.errors.len() > errors_before || self.parts.is_variable(conductor) {
            return Flow::Variable;
        }
        let (slots, stack) = self.scope.plain();
        let mut at = At { slots, stack };
        let (flow, number) = match law {
            Law::Advection(stream) => {
                let rate = self.capacity_rate(stream);
                return Flow::Stream(self.in_range(item, stream.parts()[0].0, rate, Range::Finite));
            }
            Law::Radiation(exchange) => {
                let gr = at.exchange_area(exchange).unwrap_or(f64::NAN);
                (Flow::Radiation(gr), gr)
            }
            _ => {
                let conductance = at.conductance(law).unwrap_or(f64::NAN);
                (Flow::Conductance(conductance), conductance)
            }
        };
        // 1/R and h A can still leave the range of numbers
        let field = law.parts().last().map_or(Field::Conductance, |(field, _)| *field);
        self.in_range(item, field, number, Range::Positive);
        flow
    }

    /// A constant capacity rate in W/K.
    fn capacity_rate(&mut self, stream: &Stream) -> f64 {
        let parts = self.parts;
        let mut at = |value: &Value| value.at(&mut self.scope).unwrap_or(f64::NAN);
        let flow = at(stream.parts()[0].1);
        let Some(fluid) = stream.fluid().map(|id| &parts.fluids[id.index()]) else { return flow };
        let density = match stream {
            Stream::Volume { at: measured, .. } => {
                let temperature = at(measured);
                self.scope.set(slot::OWN, temperature);
                fluid.density.as_ref().map_or(f64::NAN, |d| d.at(&mut self.scope).unwrap_or(f64::NAN))
            }
            _ => 1.0,
        };
        flow * density * fluid.cp.at(&mut self.scope).unwrap_or(f64::NAN)
    }

    fn check_shape(&mut self, item: Item, law: &Law) {
        let parts = law.parts();
        let constant = |field: Field| {
            let (_, value) = parts.iter().find(|(f, _)| *f == field)?;
            self.parts.reads(value).is_constant().then_some(value)
        };
        let (Some(inner), Some(outer)) = (constant(Field::InnerRadius), constant(Field::OuterRadius)) else {
            return;
        };
        if let (Ok(inner), Ok(outer)) = (inner.at(&mut self.scope), outer.at(&mut self.scope))
            && inner >= outer
        {
            self.error(item, BuildErrorKind::Radii { item, inner, outer });
        }
    }

    /// Inputs may depend on time, sources and conductors on temperatures too: a constant one is checked now, the
    /// others when they are read.
    fn check_inputs(&mut self) {
        for (item, field, value) in self.parts.inputs() {
            let reads = self.parts.reads(value);
            let allowed = match item {
                Item::Conductor(_) => field == Field::Conductivity || !reads.own,
                Item::Control(_) => !reads.link && !reads.own,
                Item::Source(id) => !reads.link && self.names_its_node(id, reads.own),
                _ => !reads.reads_results(),
            };
            if !allowed {
                self.error(item, BuildErrorKind::DependsOnResult { item, field });
            }
            self.check_comparisons(item, field, value);
            if matches!(item, Item::Boundary(_) | Item::Source(_)) && reads.is_constant() {
                let range = if field == Field::Temperature { Range::Temperature } else { Range::Finite };
                self.constant(item, field, value, range);
            }
        }
    }

    /// `T` of a source means one node.
    fn names_its_node(&mut self, id: SourceId, own: bool) -> bool {
        let source = &self.parts.sources[id.index()];
        if own && source.into.len() != 1 {
            self.error(Item::Source(id), BuildErrorKind::WhichTemperature { source: id });
        }
        true
    }

    fn check_materials(&mut self) {
        for (i, material) in self.parts.materials.iter().enumerate() {
            let item = Item::Material(MaterialId::from_len(i));
            let properties = [(Field::SpecificHeat, &material.cp), (Field::Conductivity, &material.k)];
            if let Some(value) = &material.density {
                self.constant(item, Field::Density, value, Range::Positive);
            }
            for (field, value) in properties {
                if let Some(value) = value {
                    self.property(item, field, value);
                }
            }
            if let Some(melting) = &material.melting {
                let solidus = self.constant(item, Field::Solidus, &melting.solidus, Range::Temperature);
                let liquidus = self.constant(item, Field::Liquidus, &melting.liquidus, Range::Temperature);
                self.constant(item, Field::LatentHeat, &melting.heat, Range::Positive);
                if liquidus < solidus {
                    self.error(item, BuildErrorKind::Melting { item, solidus, liquidus });
                }
            }
        }
    }

    fn check_fluids(&mut self) {
        for (i, fluid) in self.parts.fluids.iter().enumerate() {
            let item = Item::Fluid(FluidId::from_len(i));
            let density = fluid.density.as_ref().map(|value| (Field::Density, value));
            for (field, value) in density.into_iter().chain([(Field::SpecificHeat, &fluid.cp)]) {
                self.property(item, field, value);
            }
        }
    }

    /// A property may depend on `T`; it is then checked where it is used.
    fn property(&mut self, item: Item, field: Field, value: &Value) {
        if self.parts.reads(value).own {
            self.check_comparisons(item, field, value);
        } else {
            self.constant(item, field, value, Range::Positive);
        }
    }

    /// A product of two negative numbers would pass for a capacity.
    fn check_lumps(&mut self) {
        let parts = self.parts;
        let nodes = parts.nodes.iter().enumerate();
        let nodes = nodes.map(|(i, node)| (Item::Node(NodeId::from_len(i)), &node.lump));
        let capacitors = parts.capacitors.iter().enumerate();
        let capacitors = capacitors.map(|(i, part)| (Item::Capacitor(CapacitorId::from_len(i)), &part.lump));
        for (item, lump) in nodes.chain(capacitors) {
            if let Some(lump) = lump {
                let (field, value) = lump.size.field();
                self.constant(item, field, value, Range::Positive);
            }
        }
    }

    /// The values of limits are constant; what they limit is evaluated with results.
    fn check_limits(&mut self) {
        for (i, limit) in self.parts.limits.iter().enumerate() {
            let item = Item::Limit(LimitId::from_len(i));
            let range = if limit.ty.absolute { Range::Temperature } else { Range::Finite };
            self.constant(item, limit.bound.field(), &limit.value, range);
        }
    }

    /// Comparisons have to change at times that are known beforehand.
    fn check_comparisons(&mut self, item: Item, field: Field, value: &Value) {
        for program in value.programs() {
            for (comparison, &relation) in program.comparisons().iter().zip(program.relations()) {
                if let Some(kind) = self.parts.comparison_problem((comparison, relation), item, field) {
                    self.error(item, kind);
                    return;
                }
            }
        }
    }

    pub(crate) fn constant(&mut self, item: Item, field: Field, value: &Value, range: Range) -> f64 {
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

    fn evaluate(&mut self, item: Item, field: Field, value: &Value, range: Range) -> f64 {
        match value.at(&mut self.scope) {
            Ok(number) => self.in_range(item, field, number, range),
            Err(error) => {
                self.error(item, BuildErrorKind::Evaluation { item, field, error });
                f64::NAN
            }
        }
    }

    fn in_range(&mut self, item: Item, field: Field, value: f64, range: Range) -> f64 {
        let kind = match range {
            Range::Positive if !(value.is_finite() && value > 0.0) => {
                BuildErrorKind::NotPositive { item, field, value }
            }
            _ if !value.is_finite() => BuildErrorKind::NotFinite { item, field, value },
            Range::Fraction if !(value > 0.0 && value <= 1.0) => {
                BuildErrorKind::NotAFraction { item, field, value }
            }
            Range::Temperature if value < 0.0 => BuildErrorKind::BelowAbsoluteZero { item, field, value },
            _ => return value,
        };
        self.error(item, kind);
        value
    }

    pub(crate) fn error(&mut self, item: Item, kind: BuildErrorKind) {
        self.errors.push(BuildError { kind, name: self.parts.name_of(item).to_owned() });
    }
}

fn range_of(parameter: &Parameter) -> Range {
    if parameter.ty.absolute { Range::Temperature } else { Range::Finite }
}

fn range_of_field(field: Field) -> Range {
    match field {
        Field::Emissivity | Field::ViewFactor => Range::Fraction,
        Field::StreamCapacity | Field::Flow => Range::Finite,
        Field::FlowTemperature => Range::Temperature,
        _ => Range::Positive,
    }
}
