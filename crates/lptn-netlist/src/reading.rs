//! Readings that many sections share. Each reports its own errors, so that sections report only
//! special ones.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Field, Input, Item};
use lptn_units::{Help, Type, suggest};

use crate::fields::{Fields, Owner};
use crate::format::SectionDeclaration;
use crate::initial;
use crate::names::ValueKind;
use crate::place::{Given, Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::work::{Elaboration, stand_in};

/// All values, if none is wrong. Each is read, so that every error is reported.
pub(crate) fn all<T>(read: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    read.collect::<Vec<_>>().into_iter().collect()
}

impl<'a> Elaboration<'a> {
    /// The fields of an element; `None` if it is not a table.
    pub(crate) fn fields(
        &mut self,
        section: &'static SectionDeclaration,
        entry: &'a RawEntry,
    ) -> Option<Fields<'a>> {
        self.inner(section, Owner::element(section.name, &entry.key), entry)
    }

    /// The fields of a table inside an element.
    pub(crate) fn inner(
        &mut self,
        section: &'static SectionDeclaration,
        owner: Owner<'a>,
        entry: &'a RawEntry,
    ) -> Option<Fields<'a>> {
        Fields::of(section, owner, entry, &mut self.problems)
    }

    /// The value of a key as the builder takes it: a stand-in if it is wrong, `None` if it is
    /// missing.
    pub(crate) fn input(
        &mut self,
        fields: &Fields<'_>,
        key: &str,
        wanted: Wanted,
    ) -> Option<Input> {
        Some(self.input_at(fields, key, fields.get(key)?, wanted))
    }

    /// The same of one value of a list that a key has.
    pub(crate) fn input_at(
        &mut self,
        fields: &Fields<'_>,
        key: &str,
        raw: &RawValue,
        wanted: Wanted,
    ) -> Input {
        let given = self.given(Place { owner: &fields.owner, key, raw }, wanted);
        given.map_or_else(|| stand_in(wanted.ty.unwrap_or(Type::SCALAR)), Given::input)
    }

    /// The value of a table's key that has the name of a field elsewhere, as `from` of a range:
    /// messages about it name the table.
    pub(crate) fn given_inside(
        &mut self,
        owner: &Owner<'_>,
        (key, raw): (&str, &RawValue),
        wanted: Wanted,
    ) -> Option<Given> {
        self.given(Place { owner: &owner.inside(key), key: "", raw }, wanted)
    }

    /// The value of a required key.
    pub(crate) fn require(&mut self, fields: &Fields<'a>, key: &str) -> Option<&'a RawValue> {
        fields.require(key, &mut self.problems)
    }

    /// The text of a key that takes a name, if given.
    pub(crate) fn word(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
    ) -> Option<(&'a str, &'a RawValue)> {
        let raw = fields.get(key)?;
        Some((fields.text(key, raw, &mut self.problems)?, raw))
    }

    /// The text of a key that requires a name.
    pub(crate) fn required_word(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
    ) -> Option<(&'a str, &'a RawValue)> {
        self.require(fields, key)?;
        self.word(fields, key)
    }

    /// The items of a key that takes a list of `what`.
    pub(crate) fn list(
        &mut self,
        fields: &Fields<'a>,
        (key, what): (&str, &str),
    ) -> Option<&'a [RawValue]> {
        match fields.get(key)? {
            RawValue { kind: RawKind::Array(list), .. } => Some(list),
            raw => {
                self.report(fields.wrong_shape(key, raw, what));
                None
            }
        }
    }

    /// The table that a key takes.
    pub(crate) fn table_of(
        &mut self,
        fields: &Fields<'a>,
        (key, what): (&str, &str),
    ) -> Option<&'a RawTable> {
        match fields.get(key)? {
            RawValue { kind: RawKind::Table(table), .. } => Some(table),
            raw => {
                self.report(fields.wrong_shape(key, raw, what));
                None
            }
        }
    }

    /// The value of a key that is `true` or `false`, if given.
    pub(crate) fn yes_or_no(&mut self, fields: &Fields<'_>, key: &str) -> Option<Option<bool>> {
        fields.yes_or_no(key, &mut self.problems)
    }

    /// One of several words; default: the first.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        words: &[(&str, T)],
    ) -> Option<T> {
        if fields.get(key).is_none() {
            return words.first().map(|(_, value)| *value);
        }
        let (text, raw) = self.word(fields, key)?;
        if let Some((_, value)) = words.iter().find(|(word, _)| *word == text) {
            return Some(*value);
        }
        let message = format!("{} cannot be \"{text}\"", fields.owner.field(key));
        let all: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let help = match suggest(text, all.iter().copied()) {
            Some(near) => format!("did you mean `{key} = \"{near}\"`?"),
            None => format!("it is one of {}", lptn_data::list(&all)),
        };
        self.refuse("netlist::unknown_word", message, &raw.span, help);
        None
    }

    /// Keys that have no effect here.
    pub(crate) fn refuse_keys(&mut self, fields: &Fields<'_>, keys: &[&str], why: &str) {
        for key in keys {
            if let Some(span) = fields.key(key) {
                let message = format!("{} {why}", fields.owner.field(key));
                self.refuse("netlist::useless_key", message, span, format!("remove `{key}`"));
            }
        }
    }

    /// Notes the places of an element and of its given fields.
    pub(crate) fn note(&mut self, item: Item, name: &Span, fields: &Fields<'a>, which: &[Field]) {
        self.map.insert(item, Field::Name, name.clone());
        for &field in which {
            if let Some(raw) = fields.get(field.key()) {
                self.map.value(item, field, raw);
            }
        }
    }

    /// The value; an error is reported.
    pub(crate) fn kept<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|problem| self.report(problem)).ok()
    }

    /// Reports an error at its place.
    pub(crate) fn refuse(
        &mut self,
        code: &'static str,
        message: impl Into<String>,
        at: &Span,
        help: impl Help,
    ) {
        let problem = Diagnostic::wrong(code, message, at, help);
        self.report(problem);
    }

    /// Reports a parameter that gets values without an effect.
    pub(crate) fn doubt_effect(&mut self, words: &str, name: &str, place: &Span) {
        if self.names.without_effect().any(|other| other == name) {
            self.report(initial::without_effect(words, name, place));
        }
    }

    /// True if a name is that of a parameter; if not, it is reported.
    pub(crate) fn is_parameter_here(&mut self, words: &str, name: &str, place: &Span) -> bool {
        if self.names.is_parameter(name) {
            self.doubt_effect(words, name, place);
            return true;
        }
        let message = format!("{words} has to name a parameter, got `{name}`");
        let names =
            self.elements(ValueKind::Parameter.section()).iter().map(|entry| entry.key.as_str());
        let help = match suggest(name, names) {
            Some(near) => format!("did you mean `{near}`?"),
            None => match self.names.value_kind(name) {
                Some(kind) => {
                    format!("`{name}` is a {}; only values of [param] can be varied", kind.word())
                }
                None => "give the value a name in [param] and use it in the element".to_owned(),
            },
        };
        self.refuse("netlist::unknown_parameter", message, place, help);
        false
    }
}
