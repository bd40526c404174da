//! Reads one value: a quantity, a number or an expression, with every mistake placed to the byte.

use std::ops::Range;
use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_network::Context;
use lptn_units::{Dimension, Expression, Scope as _, Type, UnitError, UnitErrorKind};

use crate::names::{Names, base};
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind, RawNetlist};
use crate::value_help::{is_bare, parameter_help};
use crate::work::Elaboration;

impl Elaboration<'_> {
    /// The value of a field; `None` after an error in it, which is reported, or in a parameter that
    /// it uses, which has been reported.
    pub(crate) fn given(&mut self, place: Place<'_>, wanted: Wanted) -> Option<Given> {
        if let Some(program) = self.compiled.get(place, wanted) {
            return Some(Given::Expression(Arc::clone(program)));
        }
        let kelvin = wanted.derived.then(|| place.kelvin_for(wanted.ty)).flatten();
        let text = self.kept(kelvin.map_or_else(|| self.names.text(place, wanted.ty), Err))?;
        let before = self.problems.len();
        let given = self.resolve(place, text, wanted);
        if let Some(Given::Expression(program)) = &given
            && self.problems.len() == before
        {
            self.compiled.insert(place, wanted, program);
        }
        given
    }

    /// Resolves the names of a text and checks its type.
    pub(crate) fn resolve(
        &mut self,
        place: Place<'_>,
        text: Text,
        wanted: Wanted,
    ) -> Option<Given> {
        let expression = match text {
            Text::Quantity(quantity) => {
                self.scales.note(place, &quantity);
                return Some(Given::Quantity(quantity));
            }
            Text::Expression(expression) => expression,
        };
        let functional = expression.called().find(|call| self.functional_named(*call).is_some());
        if let Some((name, _)) = functional {
            return self.no_functional(place, name);
        }
        self.learn(&expression);
        self.learn_lubricants(&expression, &place.raw.span);
        self.learn_fans(&expression, &place.raw.span);
        if !self.learn_properties(place, &expression) {
            return None;
        }
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
                Some(Given::Expression(Arc::new(program)))
            }
            Err(errors) => {
                let names = (self.raw, &self.names);
                let scope = self.builder.scope(wanted.context);
                let turning =
                    |name: &str| scope.symbol(name).is_some_and(|symbol| symbol.ty == FREQUENCY);
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

/// The text of an expression, with every instance of its families.
pub(crate) fn whole(expression: &Expression) -> String {
    let text = expression.text().trim();
    if text.contains("[*]") { expression.meant().trim().to_owned() } else { text.to_owned() }
}

impl Elaboration<'_> {
    /// Distinguishes the names of imported elements from unknown ones.
    fn learn(&mut self, expression: &Expression) {
        for (name, _) in expression.names() {
            let name = base(&name);
            if let (None, Some(kind)) = (self.names.kind_of(name), self.kind_of(name)) {
                self.names.learn(name, kind);
            }
        }
    }
}

/// `if(t == 5 [s], …)`.
fn moment(place: Place<'_>, at: Span) -> Diagnostic {
    let message =
        format!("{} compares the time by equality, which lasts for no time", place.words());
    Diagnostic::warning("netlist::moment", message)
        .at(at, "never acts")
        .help("use `<` or `>=`; a pulse is `if(t < 5 [s], a, if(t < 6 [s], b, a))`")
}

const FREQUENCY: Type = Type::of(Dimension::FREQUENCY);

/// True if the dimension differs by a power of rad only.
fn left_over_radians(error: &UnitError) -> bool {
    match &error.kind {
        UnitErrorKind::Dimension { wanted, found, .. } => found.differs_by_radians(**wanted),
        UnitErrorKind::Operands { left, right, .. } => left.differs_by_radians(**right),
        _ => false,
    }
}

/// Depth to which parameters of parameters are followed.
const DEEPEST: usize = 8;

/// Shows the lines of frequencies that may have been meant as speeds, including those of parameters
/// of parameters.
fn with_frequencies(
    (raw, all): (&RawNetlist, &Names),
    expression: &Expression,
    is_frequency: &dyn Fn(&str) -> bool,
    told: Diagnostic,
) -> Diagnostic {
    let mut names: Vec<String> = expression.names().into_iter().map(|(name, _)| name).collect();
    for _ in 0..DEEPEST {
        let lines: Vec<(String, &RawEntry)> = names
            .into_iter()
            .filter_map(|name| all.line(raw, &name).map(|line| (name, line)))
            .collect();
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

/// Shows the lines of parameters that are numbers without a unit: one may be missing there.
fn with_numbers(
    (raw, all): (&RawNetlist, &Names),
    names: &[(String, Range<usize>)],
    told: Diagnostic,
) -> Diagnostic {
    let lines = names.iter().filter_map(|(name, _)| {
        let entry = all.line(raw, name).filter(|_| all.is_parameter(name))?;
        is_bare(entry).then(|| entry.value.span.clone())
    });
    lines.fold(told, |told, line| told.also(line, "a number without a unit"))
}

/// Shows the line of the parameter of an expression of one parameter or signal, which may contain
/// the mistake.
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
    let [(name, _)] = names.as_slice() else { return with_numbers((raw, all), &names, diagnostic) };
    let Some(entry) = all.line(raw, name) else { return diagnostic };
    let diagnostic = diagnostic.also(entry.value.span.clone(), "its value");
    let alone = expression.text().trim() == name && all.is_parameter(name);
    let help = wanted.ty.filter(|_| alone).and_then(|ty| parameter_help(entry, ty));
    diagnostic.help(help)
}
