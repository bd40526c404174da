//! The place of one value: its field, the type that the field takes, and its errors.
//!
//! `K` is an absolute temperature or a difference according to the type of its field. If the type
//! follows from another value (`Wanted::like`), `K` is a difference.

use std::sync::Arc;

use lptn_data::{Asked, Diagnostic};
use lptn_network::{Context, Input, Value};
use lptn_units::{Expression, Program, Quantity, Type, UnitError, UnitErrorKind, kelvin_alone};

use crate::fields::Owner;
use crate::raw::{RawKind, RawValue};
use crate::value_help::celsius_or_kelvin;

/// A value whose units are right.
#[derive(Clone, Debug)]
pub(crate) enum Given {
    Quantity(Quantity),
    Expression(Arc<Program>),
}

impl Given {
    /// Its type.
    pub(crate) fn ty(&self) -> Type {
        match self {
            Self::Quantity(quantity) => quantity.ty,
            Self::Expression(program) => program.ty(),
        }
    }

    /// For the builder of a network.
    pub(crate) fn input(self) -> Input {
        match self {
            Self::Quantity(quantity) => quantity.into(),
            Self::Expression(program) => program.into(),
        }
    }

    /// Without its type, which the reader has checked.
    pub(crate) fn value(self) -> Value {
        match self {
            Self::Quantity(quantity) => Value::Constant(quantity.value),
            Self::Expression(program) => Value::Expression(program),
        }
    }
}

/// A value before its names are resolved.
#[derive(Clone, Debug)]
pub(crate) enum Text {
    Quantity(Quantity),
    Expression(Expression),
}

/// The type and permitted names of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// Its type; any for a parameter.
    pub(crate) ty: Option<Type>,
    /// The context, which determines the temperatures that it may name.
    pub(crate) context: Context,
    /// True if it may depend on `t` and on signals.
    pub(crate) time: bool,
    /// True if it may depend on controls.
    pub(crate) controls: bool,
    /// True if its type follows from another value: `300 K` is then a difference.
    pub(crate) derived: bool,
}

impl Wanted {
    /// A constant of this type.
    pub(crate) fn constant(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Time, time: false, controls: false, derived: false }
    }

    /// A constant of the same type as another value: a parameter's new value, a bound.
    pub(crate) fn like(ty: Type) -> Self {
        Self { derived: true, ..Self::constant(ty) }
    }

    /// A constant of any type.
    pub(crate) fn parameter() -> Self {
        Self { ty: None, context: Context::Time, time: false, controls: false, derived: false }
    }

    /// A function of time and of controls.
    pub(crate) fn in_time(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Time, time: true, controls: true, derived: false }
    }

    /// A function of time of any type, known before the run.
    pub(crate) fn signal() -> Self {
        Self { ty: None, context: Context::Time, time: true, controls: false, derived: false }
    }

    /// A threshold of a control.
    pub(crate) fn threshold() -> Self {
        Self {
            ty: Some(Type::ABSOLUTE_TEMPERATURE),
            context: Context::Control,
            time: true,
            controls: true,
            derived: false,
        }
    }

    /// A constant of this type that may depend on the temperature `T` of its own element.
    pub(crate) fn own(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Own, time: false, controls: false, derived: false }
    }

    /// A capacity: it may depend on its own `T` or on states.
    pub(crate) fn capacity(ty: Type) -> Self {
        Self { context: Context::Capacity, ..Self::own(ty) }
    }

    /// A value of a path or source, whose expressions may name the temperatures of `context`.
    pub(crate) fn of_law(ty: Option<Type>, context: Context) -> Self {
        Self { ty, context, time: true, controls: true, derived: false }
    }

    /// A value that follows from results.
    pub(crate) fn of_results() -> Self {
        Self { ty: None, context: Context::Result, time: true, controls: true, derived: false }
    }

    /// True if it may name the temperature of any node or boundary, `NAME.T`.
    pub(crate) fn names_nodes(self) -> bool {
        matches!(self.context, Context::Control | Context::Source | Context::Link | Context::Result)
    }

    /// True if it may name states and named values.
    pub(crate) fn names_states(self) -> bool {
        self.context == Context::Capacity || self.names_nodes()
    }

    /// True if this is a name of a temperature in this place.
    pub(crate) fn is_local(self, name: &str) -> bool {
        match self.context {
            Context::Own | Context::Capacity | Context::Source => name == "T",
            Context::Link => matches!(name, "T_from" | "T_to" | "T_mean" | "dT"),
            Context::Time | Context::Control | Context::Result => false,
        }
    }
}

/// One field of one element: its name and its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
    pub(crate) owner: &'a Owner<'a>,
    pub(crate) key: &'a str,
    pub(crate) raw: &'a RawValue,
}

impl Place<'_> {
    /// "`R` of resistor `internal`"; a parameter has no fields.
    pub(crate) fn words(&self) -> String {
        if self.key.is_empty() { self.owner.words() } else { self.owner.field(self.key) }
    }

    /// For the reader of a CSV file that the field names.
    pub(crate) fn asked(&self) -> Asked {
        Asked { words: self.words(), span: Some(self.raw.span.clone()) }
    }

    /// The error for a string in kelvin for an absolute temperature, if `K` is a difference there.
    pub(crate) fn kelvin_for(&self, ty: Option<Type>) -> Option<Diagnostic> {
        let RawKind::String { text, .. } = &self.raw.kind else { return None };
        let error = ty.filter(|ty| ty.absolute).and_then(|_| kelvin_alone(text))?;
        let problem = self.unit_error(&error);
        let key = if self.key.is_empty() { String::new() } else { format!("{} = ", self.key) };
        let line = |value: &str| format!("`{key}\"{value}\"`");
        Some(problem.help(celsius_or_kelvin(text, line, "")))
    }

    /// Puts a mistake in the string at its place in the file.
    pub(crate) fn unit_error(&self, error: &UnitError) -> Diagnostic {
        let (words, says) = (self.words(), error.to_string());
        let says = match self.fragment(error) {
            _ if !says.starts_with("must be ") => format!(": {says}"),
            Some(part) => format!(": `{part}` {says}"),
            None => format!(" {says}"),
        };
        let diagnostic = Diagnostic::error(error.code(), format!("{words}{says}"));
        let place = match error.kind {
            // the value as a whole is the mistake
            UnitErrorKind::BareNumber { .. } if self.fragment(error).is_none() => {
                self.raw.span.clone()
            }
            _ => self.raw.part(&error.span),
        };
        let diagnostic = diagnostic.at(place, "");
        diagnostic.help(self.unit_help(error))
    }

    /// The part of the string that is wrong, if it is not the whole string.
    fn fragment(&self, error: &UnitError) -> Option<&str> {
        let RawKind::String { text, .. } = &self.raw.kind else { return None };
        let part = text.get(error.span.clone())?.trim();
        (!part.is_empty() && part != text.trim()).then_some(part)
    }

    fn unit_help(&self, error: &UnitError) -> Option<String> {
        match &error.kind {
            // the same number in another unit is rarely right
            UnitErrorKind::Dimension { wanted, fix: Some(fix), .. }
                if !fix.contains('[') && !self.key.is_empty() =>
            {
                let unit = wanted.usual_unit();
                if matches!(self.key, "x" | "y" | "t" | "v") {
                    return Some(format!("give it in {unit}, for example `\"1 {unit}\"`"));
                }
                Some(format!("give it in {unit}, for example `{}`", self.owner.sample(self.key)))
            }
            UnitErrorKind::NotFinite { text } if text.starts_with("inf") && self.key == "R" => {
                Some("leave the path out if no heat flows through it".into())
            }
            UnitErrorKind::OutOfRange { .. } => {
                Some("numbers reach from about 1e-307 to 1e308".into())
            }
            _ => error.help(),
        }
    }
}
