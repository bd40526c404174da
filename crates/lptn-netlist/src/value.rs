//! Reads one value: a quantity, a number or an expression, with every mistake placed to the byte.

use std::sync::Arc;

use lptn_data::{Asked, Diagnostic, Span};
use lptn_network::{Context, Input, Value};
use lptn_units::{
    Dimension, Expression, Program, Quantity, Scope as _, Type, UnitError, UnitErrorKind, Written,
    kelvin_alone, parse_quantity, parse_value,
};

use crate::elaborate::Elaboration;
use crate::fields::{Owner, sample, wrong_shape};
use crate::names::Names;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::result_names::base;
use crate::value_help::{celsius_or_kelvin, parameter_help};

/// A value whose units are right.
#[derive(Clone, Debug)]
pub(crate) enum Given {
    Quantity(Quantity),
    Expression(Program),
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
            Self::Expression(program) => Value::Expression(Arc::new(program)),
        }
    }
}

/// A value before its names are resolved.
#[derive(Clone, Debug)]
pub(crate) enum Text {
    Quantity(Quantity),
    Expression(Expression),
}

/// What a field takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// Its type; any for a parameter.
    pub(crate) ty: Option<Type>,
    /// Which temperatures it may name.
    pub(crate) context: Context,
    /// Whether it may depend on `t` and on signals.
    pub(crate) time: bool,
    /// Whether it may depend on controls.
    pub(crate) controls: bool,
    /// Whether its type is its own, or follows from what something else is: `300 K` is a difference then.
    pub(crate) derived: bool,
}

impl Wanted {
    /// A constant of this type.
    pub(crate) fn constant(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Time, time: false, controls: false, derived: false }
    }

    /// A constant of the type that something else has: a parameter's new value, a bound.
    pub(crate) fn like(ty: Type) -> Self {
        Self { derived: true, ..Self::constant(ty) }
    }

    /// A constant of any type.
    pub(crate) fn parameter() -> Self {
        Self { ty: None, context: Context::Time, time: false, controls: false, derived: false }
    }

    /// A function of time, and of what is on or off.
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

    /// A constant of this type that may depend on the temperature `T` of what it belongs to.
    pub(crate) fn own(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Own, time: false, controls: false, derived: false }
    }

    /// The heat of a source.
    pub(crate) fn of_source(ty: Type) -> Self {
        Self { ty: Some(ty), context: Context::Source, time: true, controls: true, derived: false }
    }

    /// A value of a path between two ends.
    pub(crate) fn of_link(ty: impl Into<Option<Type>>) -> Self {
        Self { ty: ty.into(), context: Context::Link, time: true, controls: true, derived: false }
    }

    /// Something that results determine.
    pub(crate) fn of_results() -> Self {
        Self { ty: None, context: Context::Result, time: true, controls: true, derived: false }
    }

    /// Whether it may name the temperature of any node or boundary, `NAME.T`.
    pub(crate) fn names_nodes(self) -> bool {
        matches!(self.context, Context::Control | Context::Source | Context::Link | Context::Result)
    }

    /// Whether this is a name of a temperature in this place.
    pub(crate) fn is_local(self, name: &str) -> bool {
        match self.context {
            Context::Own | Context::Source => name == "T",
            Context::Link => matches!(name, "T_from" | "T_to" | "T_mean" | "dT"),
            Context::Time | Context::Control | Context::Result => false,
        }
    }
}

/// One field of one element: what it is called, and what stands there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
    pub(crate) owner: &'a Owner,
    pub(crate) key: &'a str,
    pub(crate) raw: &'a RawValue,
}

impl Place<'_> {
    /// "`R` of resistor `internal`"; a parameter has no fields.
    pub(crate) fn words(&self) -> String {
        if self.key.is_empty() { self.owner.words().to_owned() } else { self.owner.field(self.key) }
    }

    /// For the reader of a CSV file that the field names.
    pub(crate) fn asked(&self) -> Asked {
        Asked { words: self.words(), span: Some(self.raw.span.clone()) }
    }

    /// Reads the text without resolving names.
    pub(crate) fn text(&self, ty: Option<Type>, names: &Names) -> Result<Text, Diagnostic> {
        match &self.raw.kind {
            RawKind::String { text, .. } => {
                let (place, structure) = (&self.raw.span, &names.structure);
                match parse_value(text, ty, &|name| names.is_value(&structure.resolve(place, name))) {
                    Ok(Written::Quantity(quantity)) => Ok(Text::Quantity(quantity)),
                    Ok(Written::Expression(expression)) => {
                        Ok(Text::Expression(names.resolved(place, expression)))
                    }
                    Err(error) => Err(self.unit_error(&error)),
                }
            }
            RawKind::Integer(number) | RawKind::Float(number) => match parse_quantity(number, ty) {
                Ok(quantity) => Ok(Text::Quantity(quantity)),
                Err(error) => Err(self.unit_error(&error)),
            },
            _ => {
                let sample =
                    if self.key.is_empty() { "name = \"25.5 degC\"".into() } else { sample(self.key) };
                Err(wrong_shape(&self.words(), self.raw, "a quantity or an expression in quotes", &sample))
            }
        }
    }

    /// What is wrong with a whole string in kelvin for an absolute temperature where `K` is a difference.
    pub(crate) fn kelvin_for(&self, ty: Option<Type>) -> Option<Diagnostic> {
        let RawKind::String { text, .. } = &self.raw.kind else { return None };
        let error = ty.filter(|ty| ty.absolute).and_then(|_| kelvin_alone(text))?;
        let problem = self.unit_error(&error);
        let key = if self.key.is_empty() { String::new() } else { format!("{} = ", self.key) };
        let line = |value: &str| format!("`{key}\"{value}\"`");
        Some(match celsius_or_kelvin(text, line, "") {
            Some(help) => problem.help(help),
            None => problem,
        })
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
            UnitErrorKind::BareNumber { .. } => self.raw.span.clone(),
            _ => self.raw.part(&error.span),
        };
        let diagnostic = diagnostic.at(place, "");
        match self.unit_help(error) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        }
    }

    /// The part of the string that is wrong, if it is not the whole string.
    fn fragment(&self, error: &UnitError) -> Option<&str> {
        let RawKind::String { text, .. } = &self.raw.kind else { return None };
        let part = text.get(error.span.clone())?.trim();
        (!part.is_empty() && part != text.trim()).then_some(part)
    }

    fn unit_help(&self, error: &UnitError) -> Option<String> {
        match &error.kind {
            // the same number in another unit is rarely what was meant
            UnitErrorKind::Dimension { wanted, fix: Some(fix), .. }
                if !fix.contains('[') && !self.key.is_empty() =>
            {
                let unit = wanted.usual_unit();
                if matches!(self.key, "x" | "y" | "t" | "v") {
                    return Some(format!("give it in {unit}, for example `\"1 {unit}\"`"));
                }
                Some(format!("give it in {unit}, for example `{}`", sample(self.key)))
            }
            UnitErrorKind::NotFinite { text } if text.starts_with("inf") && self.key == "R" => {
                Some("leave the path out if no heat flows through it".into())
            }
            UnitErrorKind::OutOfRange { .. } => Some("numbers reach from about 1e-307 to 1e308".into()),
            _ => error.help(),
        }
    }
}

impl Elaboration<'_> {
    /// The value of a field; `None` if something is wrong with it, which is then reported, or with a parameter it
    /// uses, which has been reported.
    pub(crate) fn given(&mut self, place: Place<'_>, wanted: Wanted) -> Option<Given> {
        let kelvin = wanted.derived.then(|| place.kelvin_for(wanted.ty)).flatten();
        match kelvin.map_or_else(|| place.text(wanted.ty, &self.names), Err) {
            Ok(text) => self.resolve(place, text, wanted),
            Err(problem) => {
                self.problems.push(problem);
                None
            }
        }
    }

    /// Resolves the names of a text and checks its type.
    pub(crate) fn resolve(&mut self, place: Place<'_>, text: Text, wanted: Wanted) -> Option<Given> {
        let expression = match text {
            Text::Quantity(quantity) => {
                self.scales.note(place, &quantity);
                return Some(Given::Quantity(quantity));
            }
            Text::Expression(expression) => expression,
        };
        self.learn(&expression);
        let problems = self.names.check(place, &expression, wanted);
        if !problems.is_empty() {
            self.problems.extend(problems);
            return None;
        }
        let mut names = expression.names().into_iter().chain(expression.calls());
        if names.any(|(name, _)| self.names.has_failed(&name)) {
            return None;
        }
        if wanted.context == Context::Result {
            self.builder.name_heats(&expression);
        }
        match expression.compile(&self.builder.scope(wanted.context), wanted.ty) {
            Ok(program) => {
                let moments = expression.equalities("t").into_iter().filter(|_| wanted.time);
                self.problems.extend(moments.map(|range| moment(place, place.raw.part(&range))));
                Some(Given::Expression(program))
            }
            Err(errors) => {
                let names = (self.raw, &self.names);
                let scope = self.builder.scope(wanted.context);
                let turning = |name: &str| scope.symbol(name).is_some_and(|symbol| symbol.ty == FREQUENCY);
                let explain = |error| {
                    let told = with_parameter(names, (place, wanted), &expression, error);
                    if left_over_radians(error) {
                        with_frequencies(names, &expression, &turning, told)
                    } else {
                        told
                    }
                };
                let problems: Vec<Diagnostic> = errors.iter().map(explain).collect();
                self.problems.extend(problems);
                None
            }
        }
    }
}

impl Elaboration<'_> {
    /// Tells the names of imported elements from unknown ones.
    fn learn(&mut self, expression: &Expression) {
        for (name, _) in expression.names() {
            let name = base(&name);
            if let (None, Some(kind)) = (self.names.kind_of(name), self.kind_of(name)) {
                self.names.learn(name, kind);
            }
        }
    }
}

/// `if(t == 5 [s], ..)`.
fn moment(place: Place<'_>, at: Span) -> Diagnostic {
    let message = format!("{} compares the time by equality, which lasts for no time", place.words());
    Diagnostic::warning("netlist::moment", message)
        .at(at, "never acts")
        .help("use `<` or `>=`; a pulse is `if(t < 5 [s], a, if(t < 6 [s], b, a))`")
}

const FREQUENCY: Type = Type::of(Dimension::FREQUENCY);

/// Whether a power of rad is what is too much or too little.
fn left_over_radians(error: &UnitError) -> bool {
    match &error.kind {
        UnitErrorKind::Dimension { wanted, found, .. } => found.differs_by_radians(**wanted),
        UnitErrorKind::Operands { left, right, .. } => left.differs_by_radians(**right),
        _ => false,
    }
}

/// Parameters of parameters are followed so far.
const DEEPEST: usize = 8;

/// The lines of the frequencies that may have been meant as speeds are shown as well, those of parameters that
/// parameters are made of too.
fn with_frequencies(
    (raw, all): (&RawNetlist, &Names),
    expression: &Expression,
    is_frequency: &dyn Fn(&str) -> bool,
    told: Diagnostic,
) -> Diagnostic {
    let mut names: Vec<String> = expression.names().into_iter().map(|(name, _)| name).collect();
    for _ in 0..DEEPEST {
        let lines: Vec<(String, &RawEntry)> =
            names.into_iter().filter_map(|name| all.line(raw, &name).map(|line| (name, line))).collect();
        let found = lines.iter().filter(|(name, _)| is_frequency(name)).map(|(_, entry)| *entry);
        let found: Vec<&RawEntry> = found.collect();
        if !found.is_empty() {
            return found
                .into_iter()
                .fold(told, |told, entry| told.also(entry.value.span.clone(), "a frequency"));
        }
        let texts = lines.iter().filter_map(|(_, entry)| match &entry.value.kind {
            RawKind::String { text, .. } => Expression::parse(text).ok(),
            _ => None,
        });
        names = texts.flat_map(|expression| expression.names()).map(|(name, _)| name).collect();
    }
    told
}

/// A mistake in an expression of one parameter or signal may be that of the parameter: its line is shown as well.
fn with_parameter(
    (raw, all): (&RawNetlist, &Names),
    (place, wanted): (Place<'_>, Wanted),
    expression: &Expression,
    error: &UnitError,
) -> Diagnostic {
    let diagnostic = place.unit_error(error);
    use UnitErrorKind as Kind;
    let of_type = matches!(
        error.kind,
        Kind::Dimension { .. }
            | Kind::AbsoluteWanted { .. }
            | Kind::DifferenceWanted { .. }
            | Kind::Rotation { .. }
            | Kind::Operands { .. }
    );
    let names = if of_type { expression.names() } else { Vec::new() };
    let [(name, _)] = names.as_slice() else { return diagnostic };
    let Some(entry) = all.line(raw, name) else { return diagnostic };
    let diagnostic = diagnostic.also(entry.value.span.clone(), "its value");
    let alone = expression.text().trim() == name && all.is_parameter(name);
    let help = wanted.ty.filter(|_| alone).and_then(|ty| parameter_help(entry, ty));
    match help {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}
