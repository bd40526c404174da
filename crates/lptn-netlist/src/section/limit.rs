//! `[limit]`: what the results have to keep.

use lptn_data::Diagnostic;
use lptn_network::{Bound, Field, Input, Item, Severity};
use lptn_units::Type;

use crate::fields::{Fields, Owner, sample, wrong_shape};
use crate::place::{Given, Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::vocabulary::LIMIT;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    pub(crate) fn limits(&mut self) {
        for entry in self.elements(LIMIT.name) {
            self.limit(entry);
        }
    }

    fn limit(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element(LIMIT.name, &entry.key);
        let fields = Fields::of(&LIMIT, owner, entry, &mut self.problems)?;
        let (of, ty, text) = self.limited(&fields);
        let (bound, raw, value) = self.bound(&fields, ty);
        let severity = self.severity(&fields);
        let id = self.builder.limit(&entry.key, (of, &text), (bound, value), severity);
        let item = Item::Limit(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        for (field, raw) in [(Field::Of, fields.get("of")), (bound.field(), raw)] {
            if let Some(raw) = raw {
                self.map.value(item, field, raw);
            }
        }
        Some(())
    }

    /// What is limited, its type where that is known, and how it is written.
    fn limited(&mut self, fields: &Fields<'a>) -> (Input, Option<Type>, String) {
        let nothing = || (stand_in(Type::ABSOLUTE_TEMPERATURE), None, String::new());
        let Some(raw) = fields.require("of", &mut self.problems) else { return nothing() };
        let place = Place { owner: &fields.owner, key: "of", raw };
        match self.given(place, Wanted::of_results()) {
            Some(Given::Quantity(_)) => {
                self.report(constant(place));
                nothing()
            }
            Some(Given::Expression(program)) => {
                let (ty, text) = (program.ty(), program.text().trim().to_owned());
                (program.into(), Some(ty), text)
            }
            None => nothing(),
        }
    }

    /// Exactly one of `below` and `above`; of the type of what is limited.
    fn bound(&mut self, fields: &Fields<'a>, ty: Option<Type>) -> (Bound, Option<&'a RawValue>, Input) {
        let below = fields.get("below").map(|raw| (Bound::Below, raw));
        let above = fields.get("above").map(|raw| (Bound::Above, raw));
        match (below, above) {
            (Some(_), Some(_)) => self.report(two_bounds(fields)),
            (None, None) if fields.complete => self.report(no_bound(fields)),
            _ => {}
        }
        let Some((bound, raw)) = below.or(above) else {
            return (Bound::Below, None, stand_in(ty.unwrap_or(Type::ABSOLUTE_TEMPERATURE)));
        };
        let place = Place { owner: &fields.owner, key: bound.field().key(), raw };
        // without the type of what is limited nothing can be said of the unit
        let given = ty.and_then(|ty| self.given(place, Wanted::like(ty)));
        let input = given.map_or_else(|| stand_in(ty.unwrap_or(Type::ABSOLUTE_TEMPERATURE)), Given::input);
        (bound, Some(raw), input)
    }

    fn severity(&mut self, fields: &Fields<'a>) -> Severity {
        let Some(raw) = fields.get("severity") else { return Severity::Error };
        match &raw.kind {
            RawKind::String { text, .. } if text == "error" => Severity::Error,
            RawKind::String { text, .. } if text == "warning" => Severity::Warning,
            RawKind::String { text, .. } => {
                self.report(unknown_severity(&fields.owner, raw, text));
                Severity::Error
            }
            _ => {
                let words = fields.owner.field("severity");
                self.report(wrong_shape(&words, raw, "\"error\" or \"warning\"", &sample("severity")));
                Severity::Error
            }
        }
    }
}

fn constant(place: Place<'_>) -> Diagnostic {
    Diagnostic::error("netlist::constant_limit", format!("{} is a constant", place.words()))
        .at(place.raw.span.clone(), "never changes")
        .help("name what the run computes, for example `of = \"steel.T\"`")
}

fn unknown_severity(owner: &Owner, raw: &RawValue, text: &str) -> Diagnostic {
    let message = format!("{} must be \"error\" or \"warning\", got \"{text}\"", owner.field("severity"));
    Diagnostic::error("netlist::unknown_severity", message)
        .at(raw.span.clone(), "no such severity")
        .help("a broken limit of severity \"error\" ends with exit code 1, one of \"warning\" is printed")
}

fn no_bound(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} has neither `below` nor `above`", fields.owner.words());
    Diagnostic::error("netlist::no_bound", message)
        .at(fields.place.clone(), "does not say what is to be kept")
        .help(format!("add `{}` or `{}`", sample("below"), sample("above")))
}

fn two_bounds(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} has `below` as well as `above`", fields.owner.words());
    let mut error = Diagnostic::error("netlist::two_bounds", message);
    if let Some(span) = fields.key("below") {
        error = error.at(span.clone(), "`below` here");
    }
    if let Some(span) = fields.key("above") {
        error = error.also(span.clone(), "`above` here");
    }
    error.help("keep one of them; a band is two limits")
}
