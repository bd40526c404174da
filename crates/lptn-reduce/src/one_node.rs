//! One node, or a few in a row, in place of a network: as a network that runs.

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Course, Extent, HeatCapacity, HeatFlow, Input, Network, NetworkBuilder, NodeId, Path,
    Resistance, Source, Temperature, Value,
};
use lptn_units::{Problem, Problems, Quantity, Type, format_number};

use crate::error::ReduceError;
use crate::ladder::Ladder;
use crate::norton::NortonEquivalent;

/// What stands between the port and the reference.
pub(crate) struct Row {
    /// Resistance in K/W in front of the first capacity; 0 for none.
    pub(crate) direct: f64,
    /// What follows, if there is any capacity.
    pub(crate) ladder: Option<Ladder>,
}

impl Row {
    /// One node with this capacity in J/K, or none.
    pub(crate) fn one(resistance: f64, capacity: f64) -> Self {
        if capacity > 0.0 {
            let ladder = Ladder { capacity: vec![capacity], resistance: vec![resistance] };
            Self { direct: 0.0, ladder: Some(ladder) }
        } else {
            Self { direct: resistance, ladder: None }
        }
    }
}

/// Everything but the capacities.
pub(crate) struct OneNode<'a> {
    pub(crate) system: &'a ThermalSystem,
    pub(crate) norton: &'a NortonEquivalent,
    /// Temperature of the port at the start in K.
    pub(crate) initial: f64,
    /// Start of the run in s, where constant inputs are read.
    pub(crate) start: f64,
}

impl OneNode<'_> {
    /// The network with this row of nodes. The first is the port's namesake.
    ///
    /// Constant inputs become one boundary `T_ref` at the end of the row and one source `Q_N`. Where
    /// an input changes with time, every boundary stays, behind the last resistance over its
    /// weight, and every source, times its weight: expressions stay as they are written, and the
    /// whole is the same equivalent at every moment.
    pub(crate) fn network(&self, row: &Row) -> Result<Network, ReduceError> {
        let from = self.system.network();
        let mut builder = NetworkBuilder::new();
        let varies = from.has_time_dependent_inputs();
        if varies {
            self.parameters(&mut builder)?;
        }
        let (port, end) = self.row(&mut builder, row);
        if varies {
            self.boundaries(&mut builder, end).and_then(|()| self.sources(&mut builder, port))?;
        } else {
            self.constants(&mut builder, port, end)?;
        }
        builder.build().map_err(|errors| ReduceError::Equivalent(first(&errors)))
    }

    /// The nodes; the port and the last of them, with the resistance behind it.
    fn row(&self, builder: &mut NetworkBuilder, row: &Row) -> (NodeId, (NodeId, f64)) {
        let name = &self.system.network().nodes()[self.norton.port.index()].name;
        let start = Temperature(self.initial);
        let (capacity, resistance) = match &row.ladder {
            Some(ladder) => (&ladder.capacity[..], &ladder.resistance[..]),
            None => (&[][..], &[][..]),
        };
        let massless = (row.direct > 0.0).then(|| builder.massless(name));
        let mut before = massless.map(|port| (port, row.direct));
        let mut port = massless;
        for (k, (&capacity, &resistance)) in (1..).zip(capacity.iter().zip(resistance)) {
            let here = if k == 1 && massless.is_none() {
                name.clone()
            } else {
                self.free(&format!("n{k}"))
            };
            let node = builder.node(&here, HeatCapacity(capacity), start);
            if let Some((last, resistance)) = before {
                let between = self.free(&format!("R_{k}"));
                builder.resistor(&between, last, node, Resistance(resistance));
            }
            port = port.or(Some(node));
            before = Some((node, resistance));
        }
        let end = before.unwrap_or_else(|| (builder.massless(name), self.norton.resistance));
        (port.unwrap_or(end.0), end)
    }

    /// The parameters that the inputs use, as the constants they come to; with signals and tables
    /// all of them.
    fn parameters(&self, builder: &mut NetworkBuilder) -> Result<(), ReduceError> {
        let network = self.system.network();
        let boundaries = network.boundaries().iter().map(|b| &b.temperature);
        let sources = network.sources().iter().zip(&self.norton.source_weights);
        let sources = sources.flat_map(|(s, w)| s.law.values().iter().map(move |v| (v, w)));
        let values = boundaries.zip(&self.norton.boundary_weights).chain(sources);
        let used: Vec<u32> =
            values.filter(|(_, w)| **w > 0.0).flat_map(|(value, _)| value.slots()).collect();
        let all = !network.signals().is_empty();
        for (parameter, id) in network.parameters().iter().zip(network.parameter_ids()) {
            if all || used.contains(&network.parameter_slot(id)) {
                let value = network.parameter_value(id);
                builder.parameter(
                    &parameter.name,
                    Quantity { value, deviation: None, ty: parameter.ty },
                );
            }
        }
        for (name, table) in network.tables() {
            builder.table(name, table.clone());
        }
        for signal in network.signals() {
            match &signal.course {
                Course::Expression(value) => {
                    let value = input(builder, value, signal.ty, 1.0)?;
                    builder.signal_expression(&signal.name, value);
                }
                course => {
                    let id = builder.signal(&signal.name, signal.ty, course.clone());
                    signal.unit.iter().for_each(|unit| builder.show_signal_in(id, unit.clone()));
                }
            }
        }
        Ok(())
    }

    fn constants(
        &self,
        builder: &mut NetworkBuilder,
        port: NodeId,
        (end, resistance): (NodeId, f64),
    ) -> Result<(), ReduceError> {
        let inputs = self.norton.inputs(self.system, self.start).map_err(ReduceError::Input)?;
        let reference = builder.boundary(&self.free("T_ref"), Temperature(inputs.reference));
        let name = self.free(if port == end { "R_eq" } else { "R_end" });
        builder.resistor(&name, end, reference, Resistance(resistance));
        if !self.system.network().sources().is_empty() {
            builder.source(&self.free("Q_N"), port, HeatFlow(inputs.heat));
        }
        Ok(())
    }

    fn boundaries(
        &self,
        builder: &mut NetworkBuilder,
        (node, resistance): (NodeId, f64),
    ) -> Result<(), ReduceError> {
        let network = self.system.network();
        for (boundary, &weight) in network.boundaries().iter().zip(&self.norton.boundary_weights) {
            if weight > 0.0 {
                let value = input(builder, &boundary.temperature, Type::ABSOLUTE_TEMPERATURE, 1.0)?;
                let end = builder.boundary(&boundary.name, value);
                let name = self.free(&format!("R_{}", boundary.name));
                builder.resistor(&name, node, end, Resistance(resistance / weight));
            }
        }
        Ok(())
    }

    fn sources(&self, builder: &mut NetworkBuilder, node: NodeId) -> Result<(), ReduceError> {
        let network = self.system.network();
        for (source, &weight) in network.sources().iter().zip(&self.norton.source_weights) {
            if weight > 0.0 {
                let law = self.law(builder, source, weight)?;
                builder.heat(&source.name(), source.kind, &[(node.into(), 1.0)], law);
            }
        }
        Ok(())
    }

    /// The law of a source with `weight` times its heat.
    fn law(
        &self,
        builder: &NetworkBuilder,
        source: &Source,
        weight: f64,
    ) -> Result<Path, ReduceError> {
        let formula = source.law.formula();
        let Extent::Divided(scaled) = formula.declaration().extent else {
            return Err(ReduceError::NotGiven { name: source.name().into_owned() });
        };
        let fields = formula.declaration().fields.iter().zip(source.law.values());
        let values: Result<Vec<Input>, ReduceError> = fields
            .map(|(field, value)| {
                let factor = if field.key == scaled { weight } else { 1.0 };
                input(builder, value, field.ty, factor)
            })
            .collect();
        Ok(Path::new(formula, values?))
    }

    /// A name that nothing of the network has.
    fn free(&self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while self.system.network().item(&name).is_ok() {
            name.push('_');
        }
        name
    }
}

/// `weight` times a value, which has no absolute type unless the weight is 1.
fn input(
    builder: &NetworkBuilder,
    value: &Value,
    ty: Type,
    weight: f64,
) -> Result<Input, ReduceError> {
    let factor = format_number(weight);
    match value {
        Value::Constant(value) => {
            Ok(Quantity { value: weight * value, deviation: None, ty }.into())
        }
        Value::Product(_) => {
            Err(ReduceError::Equivalent("a product is not an input: this is a bug in lptn".into()))
        }
        Value::Expression(program) => {
            let text = if factor == "1" {
                program.text().to_owned()
            } else {
                format!("{factor} * ({})", program.text())
            };
            let failed = |errors| ReduceError::Equivalent(format!("`{text}`: {}", first(&errors)));
            Ok(builder.expression(&text, Some(ty)).map_err(failed)?.into())
        }
    }
}

fn first<P: Problem>(errors: &Problems<P>) -> String {
    errors.first().map(ToString::to_string).unwrap_or_default()
}
