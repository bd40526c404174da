//! The constants of a network, evaluated for one set of parameters.

use lptn_units::Degree;

use crate::element::{Law, Parameter};
use crate::error::{BuildError, BuildErrorKind};
use crate::id::{CapacitorId, ConductorId, Field, Item, LimitId, MaterialId, NodeId, ParameterId};
use crate::parts::Parts;
use crate::value::{Evaluation, Value, slot};

/// What the parameters determine; checked to be physical.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    pub(crate) parameters: Vec<f64>,
    pub(crate) capacity: Vec<f64>,
    pub(crate) initial: Vec<f64>,
    pub(crate) conductance: Vec<f64>,
}

impl Numbers {
    /// Evaluates `parts`, with the parameters of `overrides` in place of their own values.
    pub(crate) fn evaluate(parts: &Parts, overrides: &[Option<f64>]) -> Result<Self, Vec<BuildError>> {
        let mut work = Work { parts, scope: Evaluation::new(&[]), errors: Vec::new() };
        let parameters = work.parameters(overrides);
        if !work.errors.is_empty() {
            return Err(work.errors); // every value below would fail for the same reason
        }
        work.check_materials();
        work.check_lumps();
        if !work.errors.is_empty() {
            return Err(work.errors); // and so would the capacities
        }
        let (capacity, initial) = (work.capacities(), work.initials());
        let conductance = work.conductances();
        work.check_inputs();
        work.check_limits();
        if work.errors.is_empty() {
            Ok(Self { parameters, capacity, initial, conductance })
        } else {
            Err(work.errors)
        }
    }
}

/// What a number has to be.
#[derive(Clone, Copy)]
enum Range {
    Finite,
    Positive,
    Temperature,
}

struct Work<'a> {
    parts: &'a Parts,
    scope: Evaluation,
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
            self.scope.push_parameter(value);
            values.push(value);
        }
        values
    }

    fn capacities(&mut self) -> Vec<f64> {
        let parts = self.parts;
        let mut capacity: Vec<f64> = Vec::with_capacity(parts.nodes.len());
        for (i, node) in parts.nodes.iter().enumerate() {
            let item = Item::Node(NodeId::from_len(i));
            let own = node.capacity.as_ref();
            capacity.push(own.map_or(0.0, |c| self.constant(item, Field::Capacity, c, Range::Positive)));
        }
        for (i, part) in parts.capacitors.iter().enumerate() {
            let item = Item::Capacitor(CapacitorId::from_len(i));
            capacity[part.node.index()] +=
                self.constant(item, Field::Capacity, &part.capacity, Range::Positive);
        }
        capacity
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

    fn conductances(&mut self) -> Vec<f64> {
        let conductors = self.parts.conductors.iter().enumerate();
        conductors
            .map(|(i, conductor)| self.conductance(Item::Conductor(ConductorId::from_len(i)), &conductor.law))
            .collect()
    }

    fn conductance(&mut self, item: Item, law: &Law) -> f64 {
        let errors_before = self.errors.len();
        let (field, value) = match law {
            Law::Resistance(r) => {
                (Field::Resistance, self.constant(item, Field::Resistance, r, Range::Positive).recip())
            }
            Law::Conductance(g) => {
                (Field::Conductance, self.constant(item, Field::Conductance, g, Range::Positive))
            }
            Law::Film { coefficient, area } => {
                let h = self.constant(item, Field::FilmCoefficient, coefficient, Range::Positive);
                (Field::Area, h * self.constant(item, Field::Area, area, Range::Positive))
            }
        };
        if self.errors.len() > errors_before {
            return value;
        }
        // 1/R and h A can still leave the range of numbers
        self.in_range(item, field, value, Range::Positive)
    }

    /// Inputs may depend on time: a constant one is checked now, the others when they are read.
    fn check_inputs(&mut self) {
        for (item, field, value) in self.parts.inputs() {
            if value.depends_on_time() {
                self.reads_results(item, field, value);
                self.check_comparisons(item, field, value);
            } else {
                let range = if field == Field::Temperature { Range::Temperature } else { Range::Finite };
                self.constant(item, field, value, range);
            }
        }
    }

    fn check_materials(&mut self) {
        for (i, material) in self.parts.materials.iter().enumerate() {
            let item = Item::Material(MaterialId::from_len(i));
            let properties = [
                (Field::Density, &material.density),
                (Field::SpecificHeat, &material.cp),
                (Field::Conductivity, &material.k),
            ];
            for (field, value) in properties {
                if let Some(value) = value {
                    self.constant(item, field, value, Range::Positive);
                }
            }
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

    fn check_comparisons(&mut self, item: Item, field: Field, value: &Value) {
        let Value::Expression(program) = value else { return };
        let linear = |d: Degree| matches!(d, Degree::Constant | Degree::Affine);
        if !program.comparisons().iter().all(|c| linear(c.degree_in(slot::TIME))) {
            self.error(item, BuildErrorKind::ComparisonNotLinear { item, field });
        }
    }

    /// Whether a value that has to be known before any result reads temperatures; reported if so.
    fn reads_results(&mut self, item: Item, field: Field, value: &Value) -> bool {
        let first = slot::PARAMETERS as usize + self.parts.parameters.len();
        let reads = value.slots().last().is_some_and(|&last| last as usize >= first);
        if reads {
            self.error(item, BuildErrorKind::DependsOnResult { item, field });
        }
        reads
    }

    fn constant(&mut self, item: Item, field: Field, value: &Value, range: Range) -> f64 {
        if self.reads_results(item, field, value) {
            return f64::NAN;
        }
        if value.depends_on_time() {
            self.error(item, BuildErrorKind::DependsOnTime { item, field });
            return f64::NAN;
        }
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
            Range::Temperature if value < 0.0 => BuildErrorKind::BelowAbsoluteZero { item, field, value },
            _ => return value,
        };
        self.error(item, kind);
        value
    }

    fn error(&mut self, item: Item, kind: BuildErrorKind) {
        self.errors.push(BuildError { kind, name: self.parts.name_of(item).to_owned() });
    }
}

fn range_of(parameter: &Parameter) -> Range {
    if parameter.ty.absolute { Range::Temperature } else { Range::Finite }
}
