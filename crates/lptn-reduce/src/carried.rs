//! Inputs of a network that a reduced one keeps as written.

use lptn_assembly::ThermalSystem;
use lptn_network::{BoundaryId, Course, End, Extent, Input, NetworkBuilder, Path, Source, Value};
use lptn_units::{Problem, Problems, Quantity, Type, format_number};

use crate::error::ReduceError;

/// The boundaries and sources that are kept, by their places.
pub(crate) struct Carried<'a> {
    pub(crate) system: &'a ThermalSystem,
    pub(crate) boundaries: Vec<bool>,
    pub(crate) sources: Vec<bool>,
}

impl Carried<'_> {
    /// Adds the parameters that the inputs use as constants, or all of them if there are signals;
    /// and the tables and signals.
    pub(crate) fn parameters(&self, builder: &mut NetworkBuilder) -> Result<(), ReduceError> {
        let network = self.system.network();
        let boundaries = network.boundaries().iter().zip(&self.boundaries);
        let boundaries = boundaries.filter(|(_, is)| **is).map(|(b, _)| &b.temperature);
        let sources = network.sources().iter().zip(&self.sources).filter(|(_, is)| **is);
        let values = boundaries.chain(sources.flat_map(|(s, _)| s.law.values()));
        let used: Vec<u32> = values.flat_map(Value::slots).collect();
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

    /// A boundary with its temperature as written.
    pub(crate) fn boundary(
        &self,
        builder: &mut NetworkBuilder,
        place: usize,
    ) -> Result<BoundaryId, ReduceError> {
        let boundary = &self.system.network().boundaries()[place];
        let value = input(builder, &boundary.temperature, Type::ABSOLUTE_TEMPERATURE, 1.0)?;
        Ok(builder.boundary(&boundary.name, value))
    }

    /// A source with `weight` times its heat, into these nodes.
    pub(crate) fn source(
        &self,
        builder: &mut NetworkBuilder,
        (place, weight): (usize, f64),
        into: &[(End, f64)],
    ) -> Result<(), ReduceError> {
        let source = &self.system.network().sources()[place];
        let law = law(builder, source, weight)?;
        builder.heat(&source.name(), source.kind, into, law);
        Ok(())
    }

    /// The name `wanted`, made unique with underscores.
    pub(crate) fn free(&self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while self.system.network().item(&name).is_ok() {
            name.push('_');
        }
        name
    }
}

/// The law of a source with `weight` times its heat.
fn law(builder: &NetworkBuilder, source: &Source, weight: f64) -> Result<Path, ReduceError> {
    let formula = source.law.formula();
    let Extent::Divided(scaled) = formula.declaration().extent else {
        return Err(ReduceError::NotGiven { name: source.name().into_owned() });
    };
    let fields = formula.declaration().fields.iter().zip(source.law.values());
    let values: Result<Vec<Input>, ReduceError> = fields
        .map(|(field, value)| {
            let factor = if scaled.contains(&field.key) { weight } else { 1.0 };
            input(builder, value, field.ty, factor)
        })
        .collect();
    Ok(Path::new(formula, values?))
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

pub(crate) fn first<P: Problem>(errors: &Problems<P>) -> String {
    errors.first().map(ToString::to_string).unwrap_or_default()
}
