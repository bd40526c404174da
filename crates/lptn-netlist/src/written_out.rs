//! An element that is written out as parameters, signals, named values and states before anything
//! is read: a controller, a branch, a junction.
//!
//! Everything that is written has the place of the value that it follows from, so that messages
//! show the line of the author.

use lptn_units::{Expression, Type};

use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::template::Structure;

/// An element on its way to values.
pub(crate) struct WrittenOut<'r> {
    raw: &'r RawNetlist,
    structure: &'r Structure,
    pub(crate) entry: &'r RawEntry,
    /// Its name where it is written.
    pub(crate) here: &'r str,
    /// Elements with their sections.
    pub(crate) made: Vec<(&'static str, RawEntry)>,
    /// The types that some of them have to have, by full name.
    pub(crate) types: Vec<(String, Type)>,
}

impl<'r> WrittenOut<'r> {
    pub(crate) fn new(
        (raw, structure): (&'r RawNetlist, &'r Structure),
        entry: &'r RawEntry,
    ) -> Self {
        let here = here(structure, entry);
        Self { raw, structure, entry, here, made: Vec::new(), types: Vec::new() }
    }

    /// Adds `NAME.name`; the element itself if the name is empty.
    pub(crate) fn put(&mut self, section: &'static str, name: &str, value: RawValue) {
        let key = self.key(name);
        let key_span = self.entry.key_span.clone();
        self.made.push((section, RawEntry { key, key_span, value }));
    }

    fn key(&self, name: &str) -> String {
        match name {
            "" => self.entry.key.clone(),
            name => format!("{}.{name}", self.entry.key),
        }
    }

    pub(crate) fn text(&mut self, section: &'static str, name: &str, text: String) {
        let value = RawValue::text(text, &self.entry.key_span);
        self.put(section, name, value);
    }

    /// Requires a type.
    pub(crate) fn typed(&mut self, name: &str, ty: Type) {
        self.types.push((self.key(name), ty));
    }

    /// A named value of this type.
    pub(crate) fn value(&mut self, name: &str, ty: Type, text: String) {
        self.text(ValueKind::Value.section(), name, text);
        self.typed(name, ty);
    }

    /// A value that an author wrote, in the section where it belongs.
    pub(crate) fn given(&mut self, name: &str, value: &RawValue) {
        self.put(self.section_of(value), name, value.clone());
    }

    /// A constant is a parameter, a function of time a signal, anything else a named value.
    pub(crate) fn section_of(&self, value: &RawValue) -> &'static str {
        let RawKind::String { text, .. } = &value.kind else {
            return ValueKind::Parameter.section();
        };
        let Ok(expression) = Expression::parse(text) else { return ValueKind::Parameter.section() };
        let is = |section: &str, name: &str| {
            let full = self.structure.resolve(&value.span, name);
            self.raw.elements(section).iter().any(|entry| entry.key == full)
        };
        let names: Vec<String> = expression.names().into_iter().map(|(name, _)| name).collect();
        let constant = |name: &String| name == "pi" || is(ValueKind::Parameter.section(), name);
        let timed = |name: &String| name == "t" || is(ValueKind::Signal.section(), name);
        let kind = match () {
            () if names.iter().all(constant) => ValueKind::Parameter,
            () if names.iter().all(|name| constant(name) || timed(name)) => ValueKind::Signal,
            () => ValueKind::Value,
        };
        kind.section()
    }

    /// A table of texts, such as a state.
    pub(crate) fn table(&self, keys: &[(&str, String)]) -> RawValue {
        let at = &self.entry.key_span;
        let entry =
            |(key, text): &(&str, String)| RawEntry::new(key, RawValue::text(text.clone(), at));
        let entries = keys.iter().map(entry).collect();
        RawValue::table(entries, at)
    }
}

/// The name of an element where it is written: without that of the instance around it.
pub(crate) fn here<'r>(structure: &Structure, entry: &'r RawEntry) -> &'r str {
    let around = structure.instance_at(&entry.key_span);
    let here = around.and_then(|path| entry.key.strip_prefix(path)?.strip_prefix('.'));
    here.unwrap_or(&entry.key)
}
