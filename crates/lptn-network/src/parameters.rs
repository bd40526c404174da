//! Other values for the parameters of a network.

use std::sync::Arc;

use lptn_units::{
    Correlations, Expression, NoNames, Quantity, Spread, Type, UnitError, kelvin_alone,
    parse_quantity,
};

use crate::id::ParameterId;
use crate::names::UnknownName;
use crate::parts::Parts;

/// The correlation of two parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Correlation {
    between: [ParameterId; 2],
    value: f64,
}

impl Correlation {
    /// True if it is of this parameter.
    fn is_of(&self, id: ParameterId) -> bool {
        self.between.contains(&id)
    }
}

/// New values for some parameters of one network, and their uncertainty; the others keep theirs.
#[derive(Clone, Debug)]
pub struct Parameters {
    parts: Arc<Parts>,
    values: Vec<Option<f64>>,
    /// The deviation of each value, if one was given with it.
    deviations: Vec<Option<Spread>>,
    correlations: Vec<Correlation>,
}

impl Parameters {
    pub(crate) fn new(parts: Arc<Parts>) -> Self {
        let count = parts.parameters.len();
        Self {
            parts,
            values: vec![None; count],
            deviations: vec![None; count],
            correlations: Vec::new(),
        }
    }

    /// The same values for other parts with the same parameters.
    pub(crate) fn onto(&self, parts: &Arc<Parts>) -> Self {
        Self { parts: Arc::clone(parts), ..self.clone() }
    }

    pub(crate) fn belong_to(&self, parts: &Arc<Parts>) -> bool {
        Arc::ptr_eq(&self.parts, parts)
    }

    pub(crate) fn values(&self) -> &[Option<f64>] {
        &self.values
    }

    /// Sets a parameter to a number in SI units; an absolute temperature in K.
    pub fn set(&mut self, id: ParameterId, value: f64) {
        self.values[id.index()] = Some(value);
    }

    /// The value that a parameter was given, in SI units; an absolute temperature in K.
    pub fn value(&self, id: ParameterId) -> Option<f64> {
        self.values[id.index()]
    }

    /// These values with one more, set as by [`Parameters::set_text`].
    ///
    /// # Errors
    /// As [`Parameters::set_text`].
    pub fn with(mut self, name: &str, text: &str) -> Result<Self, ParameterError> {
        self.set_text(name, text)?;
        Ok(self)
    }

    /// The deviation of a parameter, if one was given: by a text with `±`, or by
    /// [`Parameters::set_deviation`].
    pub fn deviation(&self, id: ParameterId) -> Option<Spread> {
        self.deviations[id.index()]
    }

    /// Sets the deviation of a parameter and deletes its correlations with others.
    pub fn set_deviation(&mut self, id: ParameterId, deviation: Spread) {
        self.deviations[id.index()] = Some(deviation);
        self.correlations.retain(|correlation| !correlation.is_of(id));
    }

    /// Sets the correlation of two parameters, more than -1 and less than 1; for a lognormal one
    /// that of its logarithm.
    pub fn correlate(&mut self, between: [ParameterId; 2], value: f64) {
        let [a, b] = between;
        self.correlations.retain(|correlation| !(correlation.is_of(a) && correlation.is_of(b)));
        self.correlations.push(Correlation { between, value });
    }

    /// The uncertain parameters, in the order of the network, each with its deviation: given here,
    /// or from its own `±`. A deviation in percent is of the value that the parameter has.
    pub fn uncertain(&self) -> Vec<(ParameterId, Spread)> {
        let all = self.parts.parameters.iter().zip(&self.deviations).zip(0..);
        let found = all.filter_map(|((own, given), i)| {
            let spread = given.or(own.deviation).filter(|spread| !spread.is_certain())?;
            Some((ParameterId(i), spread))
        });
        found.collect()
    }

    /// The correlations of these parameters.
    pub fn correlations_of(&self, ids: &[ParameterId]) -> Correlations {
        let mut all = Correlations::none(ids.len());
        for Correlation { between: [a, b], value } in &self.correlations {
            let place = |id: &ParameterId| ids.iter().position(|other| other == id);
            if let (Some(i), Some(j)) = (place(a), place(b)) {
                all.set(i, j, *value);
            }
        }
        all
    }

    /// Sets a parameter by name to a written quantity, such as `"5000 rpm"`, whose unit is checked
    /// as in a netlist: `"300 K"` is a difference. An expression without names is accepted too,
    /// `"absolute(300 [K])"`. A `±` in the text replaces the parameter's own, see
    /// [`Parameters::deviation`]. Without one the parameter keeps its own, and one in percent
    /// follows the new value.
    ///
    /// # Errors
    /// [`ParameterError`] for an unknown name, a unit of another type or a number that cannot be
    /// read.
    pub fn set_text(&mut self, name: &str, text: &str) -> Result<ParameterId, ParameterError> {
        let Some(&id) = self.parts.parameter_names.get(name) else {
            let names: Vec<&str> = self.parts.parameters.iter().map(|p| p.name.as_str()).collect();
            return Err(ParameterError::Unknown(UnknownName::new(name, &names)));
        };
        let ty = self.parts.parameters[id.index()].ty;
        let quantity = read(text, ty).map_err(|error| ParameterError::Unit {
            name: name.to_owned(),
            ty,
            error: Box::new(error),
        })?;
        self.set(id, quantity.value);
        if let Some(deviation) = quantity.deviation {
            self.set_deviation(id, deviation);
        }
        Ok(id)
    }
}

fn read(text: &str, ty: Type) -> Result<Quantity, UnitError> {
    match kelvin_alone(text).filter(|_| ty.absolute) {
        Some(error) => Err(error),
        None => parse_quantity(text, Some(ty)).or_else(|error| constant(text, ty).ok_or(error)),
    }
}

/// The value of an expression that names nothing.
fn constant(text: &str, ty: Type) -> Option<Quantity> {
    let program = Expression::parse(text).ok()?.compile(&NoNames, Some(ty)).ok()?;
    let value = program.eval::<f64>(&[], &mut Vec::new()).ok()?;
    Some(Quantity { value, deviation: None, ty })
}

lptn_units::errors! {
/// Why a parameter could not be set.
#[derive(Clone, Debug)]
pub enum ParameterError {
    /// There is no such parameter.
    Unknown(unknown: UnknownName) = "network::unknown_parameter",
        format!("no parameter: {unknown}"), source unknown;
    /// The text is not a quantity of the type of this parameter.
    Unit { name: String, ty: Type, error: Box<UnitError> } = error.code(),
        format!("`{name}`: {error}"),
        source error.as_ref(), help error.help();
}
}
