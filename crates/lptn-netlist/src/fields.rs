//! Reads one table: which of its keys there are, which are missing, which nobody knows.

use lptn_data::{Diagnostic, Span};
use lptn_laws::Formula;
use lptn_network::Input;

use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::vocabulary::Section;

/// What a field belongs to, in words.
#[derive(Clone, Debug)]
pub(crate) struct Owner(String);

impl Owner {
    /// An element, such as resistor `internal`.
    pub(crate) fn element(kind: &str, name: &str) -> Self {
        Self(format!("{kind} `{name}`"))
    }

    /// A section without elements, such as `[run]`.
    pub(crate) fn section(name: &str) -> Self {
        Self(format!("[{name}]"))
    }

    /// Whether it is a section and no element.
    fn is_section(&self) -> bool {
        self.0.contains('[')
    }

    /// A table inside a section, such as `output` of [run].
    pub(crate) fn inside(&self, key: &str) -> Self {
        Self(self.field(key))
    }

    /// "`R` of resistor `internal`".
    pub(crate) fn field(&self, key: &str) -> String {
        format!("`{key}` of {}", self.0)
    }

    /// "resistor `internal`".
    pub(crate) fn words(&self) -> &str {
        &self.0
    }
}

/// The fields of one table, with everything wrong about its keys reported.
#[derive(Debug)]
pub(crate) struct Fields<'a> {
    pub(crate) owner: Owner,
    /// Where the element's name stands, or the section's heading.
    pub(crate) place: &'a Span,
    /// Whether every key is known: a key that is misspelt would be reported as missing as well.
    pub(crate) complete: bool,
    /// The area that is meant where none is given: that of the face at which a path ends.
    pub(crate) area: Option<Input>,
    section: &'static [&'static str],
    table: &'a RawTable,
}

impl<'a> Fields<'a> {
    /// The fields of `entry`; `None` if it is no table.
    pub(crate) fn of(
        section: &Section,
        owner: Owner,
        entry: &'a RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let RawKind::Table(table) = &entry.value.kind else {
            problems.push(not_a_table(section, &owner, entry));
            return None;
        };
        let mut complete = true;
        for field in table.entries.iter().filter(|f| !section.keys.contains(&f.key.as_str())) {
            complete = false;
            let below = field.key_span.range.start >= table.span.range.end;
            let inner = below && matches!(field.value.kind, RawKind::Table(_));
            let elsewhere = section.elsewhere.iter().any(|(key, _)| *key == field.key);
            problems.push(match inner && !owner.is_section() && !elsewhere {
                true => element_inside(section, (&owner, &entry.key), field),
                false => unknown(section, &owner, field),
            });
        }
        Some(Self { owner, place: &entry.key_span, complete, area: None, section: section.keys, table })
    }

    /// Whether a key is there or is meant without.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.get(key).is_some() || (key == "area" && self.area.is_some())
    }

    /// The value of a key, if it is there.
    pub(crate) fn get(&self, key: &str) -> Option<&'a RawValue> {
        self.entry(key).map(|entry| &entry.value)
    }

    /// A key with its value.
    pub(crate) fn entry(&self, key: &str) -> Option<&'a RawEntry> {
        self.table.get(key)
    }

    /// Whether this kind of element has such a key.
    pub(crate) fn known(&self, key: &str) -> bool {
        self.section.contains(&key)
    }

    /// The place of a key.
    pub(crate) fn key(&self, key: &str) -> Option<&'a Span> {
        self.entry(key).map(|entry| &entry.key_span)
    }

    /// The value of a key that has to be there.
    pub(crate) fn require(&self, key: &str, problems: &mut Vec<Diagnostic>) -> Option<&'a RawValue> {
        let value = self.get(key);
        if value.is_none() && self.complete {
            let message = format!("{} has no `{key}`", self.owner.words());
            problems.push(
                Diagnostic::error("netlist::missing_field", message)
                    .at(self.place.clone(), format!("`{key}` is missing"))
                    .help(format!("add `{}`", sample(key))),
            );
        }
        value
    }

    /// The text of a string, for a field that holds a name and not a value.
    pub(crate) fn text(
        &self,
        key: &str,
        value: &'a RawValue,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<&'a str> {
        match &value.kind {
            RawKind::String { text, .. } => Some(text),
            _ => {
                problems.push(wrong_shape(&self.owner.field(key), value, "a string", &sample(key)));
                None
            }
        }
    }
}

/// A field of a known key, as it could be written.
pub(crate) fn sample(key: &str) -> String {
    format!("{key} = {}", sample_value(key))
}

/// The right side of a field of a known key.
pub(crate) fn sample_value(key: &str) -> &'static str {
    match key {
        "of" => "\"steel.T\"",
        "below" => "\"110 degC\"",
        "above" => "\"-20 degC\"",
        "report" => "{ rise = \"steel.T - air.T\" }",
        "window" => "{ climb = { from = \"10 min\", to = \"20 min\" } }",
        "severity" => "\"warning\"",
        "minimise" | "maximise" => "\"name of a parameter\"",
        "vary" => "{ p = { from = \"1 W/K\", to = \"10 W/K\" } }",
        "require" => "[\"steel.T <= 80 [degC]\"]",
        "over" => "\"steady\"",
        "data" => "\"record.csv\"",
        "column" => "{ ring = \"steel.T\" }",
        "sigma" => "\"0.2 K\"",
        "template" => "\"planet\"",
        "count" => "3",
        "connect" => "{ carrier = \"carrier\" }",
        "set" => "{ ratio = 0.5 }",
        "unit" => "\"K/W\"",
        "material" => "\"steel_8620\"",
        "mass" => "\"1.2 kg\"",
        "volume" => "\"150 cm^3\"",
        "density" => "\"7850 kg/m^3\"",
        "cp" => "\"475 J/(kg K)\"",
        "source" => "\"where the numbers come from\"",
        "size" => "[\"0.5 m\", \"0.5 m\", \"20 mm\"]",
        "cells" => "[20, 20, 4]",
        "T0" | "T" => "\"25 degC\"",
        "C" => "\"500 J/K\"",
        "P" => "\"100 W\"",
        "stop" => "\"25 min\"",
        "start" => "\"0 s\"",
        "initial" => "\"out/gearbox/state.json\"",
        "min_dwell" => "\"30 s\"",
        "every" => "\"5 s\"",
        "tolerance" => "\"1e-5 K\"",
        "temperature_unit" => "\"degC\"",
        "select" => "[\"*.T\"]",
        "at" => "[\"0 s\", \"5 s\"]",
        "output" => "{ every = \"5 s\" }",
        "L_char" => "\"12 mm\"",
        "massless" => "true",
        "integrator" => "\"auto\"",
        "from" => "\"name of a node or boundary\"",
        "to" => "\"name of another node or boundary\"",
        "sense" => "\"name of a node or boundary\"",
        "node" | "into" => "\"name of a node\"",
        _ => sample_of_law(key).or_else(|| sample_of_curve(key)).unwrap_or("\"..\""),
    }
}

/// The right side of a field of a path or of what it is made of.
fn sample_of_law(key: &str) -> Option<&'static str> {
    Some(match key {
        "on_above" => "\"60 degC\"",
        "off_below" => "\"55 degC\"",
        "on_below" => "\"18 degC\"",
        "off_above" => "\"20 degC\"",
        "shape" => "\"slab\"",
        "fluid" => "\"water\"",
        "solidus" => "\"55 degC\"",
        "liquidus" => "\"57 degC\"",
        "latent_heat" => "\"200 kJ/kg\"",
        _ => return Formula::ALL.iter().find_map(|law| law.field(key)).map(|field| field.example),
    })
}

/// The right side of a field of a table or signal.
fn sample_of_curve(key: &str) -> Option<&'static str> {
    Some(match key {
        "x" => "[\"0 rpm\", \"5000 rpm\"]",
        "y" => "[\"0 W\", \"80 W\"]",
        "t" => "[\"0 s\", \"60 s\"]",
        "v" => "[\"0 rpm\", \"5000 rpm\"]",
        "x_unit" | "v_unit" => "\"rpm\"",
        "y_unit" => "\"W\"",
        "t_unit" => "\"s\"",
        "csv" => "\"cycle.csv\"",
        "nodes" => "\"nodes.csv\"",
        "boundaries" => "\"boundaries.csv\"",
        "conductors" => "\"conductors.csv\"",
        "sources" => "\"sources.csv\"",
        "time" => "\"t\"",
        "value" => "\"speed\"",
        "interp" => "\"linear\"",
        "outside" | "after_end" => "\"hold\"",
        "period" => "\"60 s\"",
        _ => return None,
    })
}

/// A value of another TOML type than its field takes.
pub(crate) fn wrong_shape(field: &str, value: &RawValue, wanted: &str, sample: &str) -> Diagnostic {
    let message = format!("{field} must be {wanted}, got {}", value.kind.with_article());
    Diagnostic::error("netlist::wrong_shape", message)
        .at(value.span.clone(), format!("{wanted} belongs here"))
        .help(format!("write it like this: `{sample}`"))
}

fn not_a_table(section: &Section, owner: &Owner, entry: &RawEntry) -> Diagnostic {
    let got = entry.value.kind.with_article();
    let message = format!("{} must be a table of fields, got {got}", owner.words());
    let error = Diagnostic::error("netlist::not_a_table", message).at(entry.value.span.clone(), "");
    if matches!(entry.value.kind, RawKind::Array(_)) {
        return error.help("write the heading with single brackets: each element has a name of its own");
    }
    error.help(format!("write it like this: `{} = {}`", entry.key, section.example))
}

/// An element below the heading of another one.
fn element_inside(section: &Section, (owner, name): (&Owner, &str), field: &RawEntry) -> Diagnostic {
    let (key, kind) = (&field.key, section.name);
    Diagnostic::error("netlist::unknown_key", format!("{} has no field `{key}`", owner.words()))
        .at(field.key_span.clone(), format!("belongs to `[{kind}.{name}]`, which lasts to the next heading"))
        .help(format!(
            "put `{key}` above `[{kind}.{name}]`, or give it the heading `[{kind}.{key}]` of its own"
        ))
}

fn unknown(section: &Section, owner: &Owner, field: &RawEntry) -> Diagnostic {
    let key = &field.key;
    if section.later.contains(&key.as_str()) {
        let message = format!("{} is not supported yet", owner.field(key));
        return Diagnostic::error("netlist::not_supported_yet", message)
            .at(field.key_span.clone(), "")
            .help(format!("the keys here are {} so far", lptn_data::list(section.keys)));
    }
    Diagnostic::error("netlist::unknown_key", format!("{} has no field `{key}`", owner.words()))
        .at(field.key_span.clone(), "unknown key")
        .help(section.help_for(key))
}
