//! Reads one table and reports missing and unknown keys.

use std::borrow::Cow;

use lptn_data::{Diagnostic, Span, list};
use lptn_network::Input;
use lptn_units::Type;

use crate::format::{KeyDeclaration, SectionDeclaration};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

/// The element or section that a field belongs to, in words.
#[derive(Clone, Debug)]
pub(crate) struct Owner<'a> {
    words: Words<'a>,
    /// The section that declares its keys.
    section: &'static SectionDeclaration,
}

/// Words that only errors need.
#[derive(Clone, Debug)]
enum Words<'a> {
    /// Kind and name of an element.
    Element(&'static str, Cow<'a, str>),
    Section(&'static str),
    /// A table inside a section.
    Inside(String),
}

impl<'a> Owner<'a> {
    fn of(words: Words<'a>) -> Self {
        Self { words, section: &SectionDeclaration::NEW }
    }

    /// An element, such as resistor `internal`.
    pub(crate) fn element(kind: &'static str, name: impl Into<Cow<'a, str>>) -> Self {
        Self::of(Words::Element(kind, name.into()))
    }

    /// A section without elements, such as `[run]`.
    pub(crate) fn section(name: &'static str) -> Self {
        Self::of(Words::Section(name))
    }

    /// A table inside a section, such as `output` of [run].
    pub(crate) fn inside(&self, key: &str) -> Owner<'static> {
        Owner::of(Words::Inside(self.field(key)))
    }

    /// True if it is a section, not an element.
    fn is_section(&self) -> bool {
        self.words().contains('[')
    }

    /// "`R` of resistor `internal`".
    pub(crate) fn field(&self, key: &str) -> String {
        format!("`{key}` of {}", self.words())
    }

    /// "resistor `internal`".
    pub(crate) fn words(&self) -> String {
        match &self.words {
            Words::Element(kind, name) => format!("{kind} `{name}`"),
            Words::Section(name) => format!("[{name}]"),
            Words::Inside(words) => words.clone(),
        }
    }

    /// The section that it belongs to.
    pub(crate) fn kind(&self) -> &'static str {
        self.section.name
    }

    /// One of its keys as it could be written.
    pub(crate) fn sample(&self, key: &str) -> String {
        self.section.sample(key)
    }

    /// The type of one of its keys, as it is declared.
    pub(crate) fn ty(&self, key: &str) -> Type {
        debug_assert!(self.section.key(key).is_some(), "{key} is not a key of {}", self.words());
        self.section.key(key).map_or(Type::SCALAR, KeyDeclaration::ty)
    }

    /// The example of one of its keys below another name.
    pub(crate) fn sample_as(&self, key: &str, name: &str) -> String {
        let example = self.section.key(key).map_or("\"..\"", |key| key.example);
        format!("{name} = {example}")
    }
}

/// A lubricant that an element names, and the place whose temperature it has.
#[derive(Debug)]
pub(crate) struct Oil {
    pub(crate) name: String,
    pub(crate) at: String,
}

/// The fields of one table, with all errors of its keys reported.
#[derive(Debug)]
pub(crate) struct Fields<'a> {
    pub(crate) owner: Owner<'a>,
    /// The place of the element's name, or of the section's heading.
    pub(crate) place: &'a Span,
    /// True if every key is known: otherwise a misspelt key would be reported as missing, too.
    pub(crate) complete: bool,
    /// The area if none is given: that of the face at which a path ends.
    pub(crate) area: Option<Input>,
    /// The lubricant of a loss, and its place.
    pub(crate) oil: Option<Oil>,
    table: &'a RawTable,
}

impl<'a> Fields<'a> {
    /// The fields of `entry`; `None` if it is not a table.
    pub(crate) fn of(
        section: &'static SectionDeclaration,
        owner: Owner<'a>,
        entry: &'a RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let RawKind::Table(table) = &entry.value.kind else {
            problems.push(not_a_table(section, &owner, entry));
            return None;
        };
        let mut complete = true;
        for field in table.entries.iter().filter(|field| section.key(&field.key).is_none()) {
            complete = false;
            let below = field.key_span.range.start >= table.span.range.end;
            let inner = below && matches!(field.value.kind, RawKind::Table(_));
            let elsewhere = section.elsewhere.iter().any(|(key, _)| *key == field.key);
            problems.push(match inner && !owner.is_section() && !elsewhere {
                true => element_inside(section, (&owner, &entry.key), field),
                false => unknown(section, &owner, field),
            });
        }
        let owner = Owner { section, ..owner };
        Some(Self { owner, place: &entry.key_span, complete, area: None, oil: None, table })
    }

    /// True if a key is given or has a value by default.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.get(key).is_some() || (key == "area" && self.area.is_some())
    }

    /// All entries.
    pub(crate) fn table(&self) -> &'a RawTable {
        self.table
    }

    /// The value of a key, if it is there.
    pub(crate) fn get(&self, key: &str) -> Option<&'a RawValue> {
        self.entry(key).map(|entry| &entry.value)
    }

    /// A key with its value.
    pub(crate) fn entry(&self, key: &str) -> Option<&'a RawEntry> {
        self.table.get(key)
    }

    /// True if this kind of element has such a key.
    pub(crate) fn known(&self, key: &str) -> bool {
        self.owner.section.key(key).is_some()
    }

    /// The place of a key.
    pub(crate) fn key(&self, key: &str) -> Option<&'a Span> {
        self.entry(key).map(|entry| &entry.key_span)
    }

    /// The value of a required key.
    pub(crate) fn require(
        &self,
        key: &str,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<&'a RawValue> {
        let value = self.get(key);
        if value.is_none() && self.complete {
            let message = format!("{} has no `{key}`", self.owner.words());
            problems.push(self.missing(key, message));
        }
        value
    }

    /// Its keys, as they are declared.
    pub(crate) fn declared(&self) -> &'static [KeyDeclaration] {
        self.owner.section.keys
    }

    /// Error for a missing key, with how it could be written.
    pub(crate) fn missing(&self, key: &str, message: String) -> Diagnostic {
        Diagnostic::error("netlist::missing_field", message)
            .at(self.place.clone(), format!("`{key}` is missing"))
            .help(format!("add `{}`", self.sample(key)))
    }

    /// The text of a string, for a field that takes a name instead of a value.
    pub(crate) fn text(
        &self,
        key: &str,
        value: &'a RawValue,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<&'a str> {
        match &value.kind {
            RawKind::String { text, .. } => Some(text),
            _ => {
                problems.push(self.wrong_shape(key, value, "a string"));
                None
            }
        }
    }

    /// Error for a value of a key, or a part of it, of the wrong type.
    pub(crate) fn wrong_shape(&self, key: &str, value: &RawValue, wanted: &str) -> Diagnostic {
        wrong_shape(&self.owner.field(key), value, wanted, &self.sample(key))
    }

    /// The value of a key that is `true` or `false`, if given.
    pub(crate) fn yes_or_no(
        &self,
        key: &str,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Option<bool>> {
        match self.get(key).map(|raw| (raw, &raw.kind)) {
            None => Some(None),
            Some((_, RawKind::Boolean(answer))) => Some(Some(*answer)),
            Some((raw, _)) => {
                problems.push(self.wrong_shape(key, raw, "`true` or `false`"));
                None
            }
        }
    }

    /// Error for several keys that exclude each other: each one that is given has a label.
    pub(crate) fn several<'k>(
        &self,
        code: &'static str,
        message: String,
        keys: impl IntoIterator<Item = &'k str>,
    ) -> Diagnostic {
        let places = keys.into_iter();
        let places =
            places.filter_map(|key| Some((self.key(key)?.clone(), format!("`{key}` here"))));
        Diagnostic::error(code, format!("{} {message}", self.owner.words())).places(places)
    }

    /// One of its keys as it could be written.
    pub(crate) fn sample(&self, key: &str) -> String {
        self.owner.sample(key)
    }
}

/// A value of another TOML type than its field takes.
pub(crate) fn wrong_shape(field: &str, value: &RawValue, wanted: &str, sample: &str) -> Diagnostic {
    let message = format!("{field} must be {wanted}, got {}", value.kind.with_article());
    Diagnostic::error("netlist::wrong_shape", message)
        .at(value.span.clone(), format!("{wanted} belongs here"))
        .help(format!("write it like this: `{sample}`"))
}

fn not_a_table(section: &SectionDeclaration, owner: &Owner<'_>, entry: &RawEntry) -> Diagnostic {
    let got = entry.value.kind.with_article();
    let message = format!("{} must be a table of fields, got {got}", owner.words());
    let error = Diagnostic::error("netlist::not_a_table", message).at(entry.value.span.clone(), "");
    if matches!(entry.value.kind, RawKind::Array(_)) {
        return error.help("write the heading with single brackets: each element has its own name");
    }
    let own = section.holding(&entry.value.kind);
    let right = own.unwrap_or_else(|| section.example.to_owned());
    error.help(format!("write it like this: `{} = {right}`", entry.key))
}

/// An element below the heading of another one.
fn element_inside(
    section: &SectionDeclaration,
    (owner, name): (&Owner<'_>, &str),
    field: &RawEntry,
) -> Diagnostic {
    let (key, kind) = (&field.key, section.name);
    Diagnostic::error("netlist::unknown_key", format!("{} has no field `{key}`", owner.words()))
        .at(
            field.key_span.clone(),
            format!("belongs to `[{kind}.{name}]`, which lasts to the next heading"),
        )
        .help(format!(
            "put `{key}` above `[{kind}.{name}]`, or give it its own heading `[{kind}.{key}]`"
        ))
}

/// Error for a key that a section does not have.
pub(crate) fn unknown(
    section: &SectionDeclaration,
    owner: &Owner<'_>,
    field: &RawEntry,
) -> Diagnostic {
    let key = &field.key;
    if section.later.contains(&key.as_str()) {
        let message = format!("{} is not supported yet", owner.field(key));
        return Diagnostic::wrong(
            "netlist::not_supported_yet",
            message,
            &field.key_span,
            format!("the keys here are {}", list(&section.names())),
        );
    }
    Diagnostic::error("netlist::unknown_key", format!("{} has no field `{key}`", owner.words()))
        .at(field.key_span.clone(), "unknown key")
        .help(with_value(section.help_for(key), &field.value))
}

/// Help with the value of the user in the place of `{value}`.
fn with_value(help: String, value: &RawValue) -> String {
    let written = value.kind.written().unwrap_or_else(|| "\"..\"".to_owned());
    match &value.kind {
        RawKind::Array(_) => help.replace("[{value}]", &written),
        _ => help,
    }
    .replace("{value}", &written)
}
