//! Other values for the parameters of a network.

use std::sync::Arc;

use lptn_units::{
    Expression, Quantity, Scope, Symbol, Type, UnitError, kelvin_alone, parse_quantity,
};

use crate::id::ParameterId;
use crate::names::UnknownName;
use crate::parts::Parts;

/// New values for some parameters of one network; the others keep theirs.
#[derive(Clone, Debug)]
pub struct Parameters {
    parts: Arc<Parts>,
    values: Vec<Option<f64>>,
    /// One standard deviation in SI units, where the text that set a value gave one.
    deviations: Vec<Option<f64>>,
}

impl Parameters {
    pub(crate) fn new(parts: Arc<Parts>) -> Self {
        let count = parts.parameters.len();
        Self { parts, values: vec![None; count], deviations: vec![None; count] }
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

    /// These values with one more, set as by [`Parameters::set_text`].
    ///
    /// # Errors
    /// As [`Parameters::set_text`].
    pub fn with(mut self, name: &str, text: &str) -> Result<Self, ParameterError> {
        self.set_text(name, text)?;
        Ok(self)
    }

    /// One standard deviation in SI units of a parameter that was set by a text with `±`.
    pub fn deviation(&self, id: ParameterId) -> Option<f64> {
        self.deviations[id.index()]
    }

    /// Sets a parameter by name to a written quantity, such as `"5000 rpm"`, whose unit is checked
    /// as in a netlist: `"300 K"` is a difference. An expression without names will do,
    /// `"absolute(300 [K])"`. A `±` in the text takes the place of the parameter's own, see
    /// [`Parameters::deviation`].
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
        self.deviations[id.index()] = quantity.deviation.or(self.deviations[id.index()]);
        Ok(id)
    }
}

fn read(text: &str, ty: Type) -> Result<Quantity, UnitError> {
    match kelvin_alone(text).filter(|_| ty.absolute) {
        Some(error) => Err(error),
        None => parse_quantity(text, Some(ty)).or_else(|error| constant(text, ty).ok_or(error)),
    }
}

/// No names but those of functions.
struct Nothing;

impl Scope for Nothing {
    fn symbol(&self, _: &str) -> Option<Symbol> {
        None
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The value of an expression that names nothing.
fn constant(text: &str, ty: Type) -> Option<Quantity> {
    let program = Expression::parse(text).ok()?.compile(&Nothing, Some(ty)).ok()?;
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
