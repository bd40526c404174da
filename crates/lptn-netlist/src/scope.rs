//! The names that expressions may use in a place, and errors about other names.

use std::ops::Range;

use lptn_data::{Diagnostic, Span};
use lptn_network::Context;
use lptn_units::{Expression, Type, Written, is_function, parse_quantity, parse_value, suggest};

use crate::fields::wrong_shape;
use crate::misplaced::{LOCAL, control_not_here, depends_on_time, not_here, value_not_here};
use crate::names::{Names, ValueKind, base};
use crate::place::{Place, Text, Wanted};
use crate::raw::RawKind;
use crate::template::{INDEX, in_own_words, no_index, outside, two_meanings, wrong_path};

impl Names {
    /// Reads the text without resolving names.
    pub(crate) fn text(&self, place: Place<'_>, ty: Option<Type>) -> Result<Text, Diagnostic> {
        match &place.raw.kind {
            RawKind::String { text, .. } => {
                let at = &place.raw.span;
                if let Some(known) = self.expressions.borrow().get(text) {
                    return Ok(Text::Expression(self.resolved(at, known.clone())));
                }
                match parse_value(text, ty, &|name| self.is_value_at(at, name)) {
                    Ok(Written::Quantity(quantity)) => Ok(Text::Quantity(quantity)),
                    Ok(Written::Expression(expression)) => {
                        self.expressions.borrow_mut().insert(text.clone(), expression.clone());
                        Ok(Text::Expression(self.resolved(at, expression)))
                    }
                    Err(error) => Err(place.unit_error(&error)),
                }
            }
            RawKind::Integer(number) | RawKind::Float(number) => match parse_quantity(number, ty) {
                Ok(quantity) => Ok(Text::Quantity(quantity)),
                Err(error) => Err(place.unit_error(&error)),
            },
            _ => {
                let sample = if place.key.is_empty() {
                    "name = \"25.5 degC\"".into()
                } else {
                    place.owner.sample(place.key)
                };
                Err(wrong_shape(
                    &place.words(),
                    place.raw,
                    "a quantity or an expression in quotes",
                    &sample,
                ))
            }
        }
    }

    /// Reports all errors in the names of an expression.
    pub(crate) fn check(
        &mut self,
        place: Place<'_>,
        expression: &Expression,
        wanted: Wanted,
    ) -> Vec<Diagnostic> {
        let names = expression.names().into_iter();
        let problems =
            names.filter_map(|(name, range)| self.check_name(place, (name, range), wanted));
        let problems: Vec<Diagnostic> = problems.collect();
        let problems = problems
            .into_iter()
            .map(|problem| in_own_words(&self.structure, place, problem))
            .collect();
        for (name, _) in expression.calls() {
            if self.values.contains_key(&name) {
                self.note_use(&name);
            }
        }
        problems
    }

    fn check_name(
        &mut self,
        place: Place<'_>,
        (name, range): (String, Range<usize>),
        wanted: Wanted,
    ) -> Option<Diagnostic> {
        let at = || place.raw.part(&range);
        if let Some(kind) = self.value_kind(&name) {
            self.note_use(&name);
            if name == INDEX && self.structure.index_at(&place.raw.span).is_some() {
                return Some(two_meanings(place, kind, at()));
            }
            return match kind {
                ValueKind::Signal if !wanted.time => Some(depends_on_time(place, &name, at())),
                ValueKind::Control if !wanted.controls => {
                    Some(control_not_here(place, &name, at()))
                }
                ValueKind::State | ValueKind::Value if !wanted.names_states() => {
                    Some(value_not_here(place, (kind, &name), at()))
                }
                _ => None,
            };
        }
        let result = wanted.context == Context::Result;
        let known =
            (wanted.names_nodes() && self.is_temperature(&name)) || (result && self.is_heat(&name));
        if known {
            self.read.insert(base(&name).to_owned());
        }
        let template = self.structure.template_at(&place.raw.span);
        if let (true, Some(template)) =
            (known && !self.structure.belongs(&place.raw.span, &name), template)
        {
            return Some(outside(place, &name, template).at(at(), "not in the template"));
        }
        if known
            || self.is_of_grid(&name, wanted)
            || wanted.is_local(&name)
            || self.is_hidden(base(&name))
        {
            return None; // what hides it has been reported
        }
        if name == "t" {
            return (!wanted.time).then(|| depends_on_time(place, &name, at()));
        }
        let at = at();
        if let Some(problem) = self.unknown_of_grid(place, (&name, &at), wanted) {
            return Some(problem);
        }
        if let Some(wrong) = self.structure.wrong_path(&name) {
            return Some(wrong_path((&place.words(), &name), at, wrong));
        }
        Some(
            match LOCAL.contains(&name.as_str()) || (name.ends_with(".T") && !wanted.names_nodes())
            {
                true => not_here(place, &name, wanted, at),
                false
                    if wanted.context == Context::Result
                        || (wanted.names_nodes() && name.ends_with(".T")) =>
                {
                    self.unknown_result(place, &name, at)
                }
                false => self.unknown((place, wanted), &name, at),
            },
        )
    }

    /// `NAME.T` of a node or boundary.
    fn is_temperature(&self, name: &str) -> bool {
        let kind = name.strip_suffix(".T").and_then(|name| self.kind_of(name));
        matches!(kind, Some("node" | "boundary"))
    }

    fn unknown(
        &mut self,
        (place, wanted): (Place<'_>, Wanted),
        name: &str,
        at: Span,
    ) -> Diagnostic {
        let words = place.words();
        if name.contains(['.', '[']) {
            let message = format!("{words} uses `{name}`, which is not a parameter");
            return Diagnostic::error("netlist::unknown_name", message)
                .at(at, "unknown name")
                .help(
                    "expressions may use parameters, tables and, if time is allowed, signals, \
                 controls and `t`: write the value itself",
                );
        }
        if name == INDEX {
            return no_index(place, self.structure.instance_at(&place.raw.span), at);
        }
        let error = Diagnostic::error(
            "netlist::unknown_name",
            format!("{words} uses `{name}`, which is not a parameter"),
        )
        .at(at, "unknown name");
        if is_function(name) {
            return error.help(format!("`{name}` is a function: write `{name}(..)`"));
        }
        if wanted.time && ["time", "Time", "zeit", "Zeit"].contains(&name) {
            return error.help("the time of the run is `t`, as in `sin(2 * pi * t / 1 [h])`");
        }
        let search = self.may_search(self.order.len());
        let local = LOCAL.into_iter().filter(|name| wanted.is_local(name));
        let inside = self.structure.names_at(&place.raw.span);
        let known = self.order.iter().map(String::as_str).chain(["pi"]).chain(local).chain(inside);
        let known = known.filter(|_| search);
        let near = suggest(name, known);
        if let Some(near) = near {
            let error = error.help(format!("did you mean `{near}`?"));
            return match self.values.get(&self.structure.resolve(&place.raw.span, near)) {
                Some((_, span, _)) => error.also(span.clone(), "similar name"),
                None => error,
            };
        }
        match self.elements.get(name) {
            Some(&("node" | "boundary")) if wanted.names_nodes() => {
                error.help(format!("its temperature is `{name}.T`"))
            }
            Some(kind) => error.help(format!("`{name}` is a {kind}; expressions use parameters")),
            None => error.help(format!("add it to [param], for example `{}`", sample(place, name))),
        }
    }
}

/// A line for a name that is missing. It has the unit of the value only if it is all of the value.
fn sample(place: Place<'_>, name: &str) -> String {
    match &place.raw.kind {
        RawKind::String { text, .. } if text.trim() == name => {
            place.owner.sample_as(place.key, name)
        }
        _ => format!("{name} = \"..\""),
    }
}
