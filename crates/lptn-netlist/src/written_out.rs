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
        let names: Vec<String> = expression.names().into_iter().map(|(name, _)| name).collect();
        let parameters = ValueKind::Parameter.section();
        let constant = |name: &String| name == "pi" || self.is_in(parameters, (value, name));
        let timed = |name: &String| self.is_timed((value, name));
        let kind = match () {
            () if names.iter().all(constant) => ValueKind::Parameter,
            () if names.iter().all(|name| constant(name) || timed(name)) => ValueKind::Signal,
            () => ValueKind::Value,
        };
        kind.section()
    }

    /// The first name in a value that changes, and true if it changes with time alone.
    pub(crate) fn changing(&self, value: &RawValue) -> Option<(String, bool)> {
        let RawKind::String { text, .. } = &value.kind else { return None };
        let names = Expression::parse(text).ok()?.names().into_iter().map(|(name, _)| name);
        let sections = [ValueKind::Value, ValueKind::State, ValueKind::Control];
        let sections = sections.map(ValueKind::section);
        let is_result = |name: &str| {
            let of_node = name.strip_suffix(".T").is_some_and(|node| {
                ["node", "boundary"].iter().any(|section| self.is_in(section, (value, node)))
            });
            of_node || sections.iter().any(|section| self.is_in(section, (value, name)))
        };
        names.into_iter().find_map(|name| {
            let timed = self.is_timed((value, &name));
            (timed || is_result(&name)).then_some((name, timed))
        })
    }

    /// True for the time, and for a signal.
    fn is_timed(&self, (value, name): (&RawValue, &str)) -> bool {
        name == "t" || self.is_in(ValueKind::Signal.section(), (value, name))
    }

    /// True if a name in a value is that of an element of a section.
    fn is_in(&self, section: &str, (value, name): (&RawValue, &str)) -> bool {
        let full = self.structure.resolve(&value.span, name);
        self.raw.elements(section).iter().any(|entry| entry.key == full)
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
