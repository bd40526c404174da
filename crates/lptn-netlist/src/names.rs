//! The names that expressions may use, and what is said about those they may not.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use lptn_network::Context;
use lptn_units::{Expression, is_function, suggest};

use crate::diagnostic::Diagnostic;
use crate::fields::sample_value;
use crate::file::Span;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable};
use crate::result_names::base;
use crate::value::{Place, Wanted};
use crate::vocabulary::{PARAM, SIGNAL, TABLE};

/// What a name in an expression can stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ValueKind {
    Parameter,
    Signal,
    Table,
}

impl ValueKind {
    /// Each with its section.
    const ALL: [(Self, &'static str); 3] =
        [(Self::Parameter, PARAM), (Self::Signal, SIGNAL.name), (Self::Table, TABLE.name)];

    /// What it is called in messages.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Signal => "signal",
            Self::Table => "table",
        }
    }
}

/// Parameters, signals and tables, and the other names of the file that someone may mistake for one.
#[derive(Debug, Default)]
pub(crate) struct Names {
    values: HashMap<String, (ValueKind, Span)>,
    /// In file order, for suggestions.
    pub(crate) order: Vec<String>,
    pub(crate) elements: HashMap<String, &'static str>,
    /// Values that are wrong: what uses them is not reported again.
    failed: HashSet<String>,
    used: HashSet<String>,
    /// Names in sections that are not known: they may be what is looked for.
    hidden: HashSet<String>,
    /// Materials that cannot be read.
    hidden_materials: HashSet<String>,
    /// Fluids that cannot be read.
    hidden_fluids: HashSet<String>,
    /// How many similar names were looked for.
    searches: usize,
}

/// After so many suggestions no more are looked for: each takes a look at every name.
const MOST_SEARCHES: usize = 100;

/// The sections whose elements share one set of names.
const ELEMENTS: [&str; 11] = [
    "node",
    "boundary",
    "source",
    "capacitor",
    "resistor",
    "conduction",
    "convection",
    "contact",
    "radiation",
    "advection",
    "limit",
];

impl Names {
    pub(crate) fn of(raw: &RawNetlist) -> Self {
        let mut names = Self::default();
        for (kind, heading) in ValueKind::ALL {
            for entry in section(raw, heading).into_iter().flat_map(|table| &table.entries) {
                names.order.push(entry.key.clone());
                if names.values.contains_key(&entry.key) {
                    names.fail(&entry.key); // taken twice: what is meant cannot be told
                } else {
                    names.values.insert(entry.key.clone(), (kind, entry.key_span.clone()));
                }
            }
        }
        for kind in ELEMENTS {
            let entries = section(raw, kind).into_iter().flat_map(|table| &table.entries);
            for entry in entries {
                names.elements.entry(entry.key.clone()).or_insert(kind);
                names.hide_inner(entry);
            }
        }
        names
    }

    /// The line of a parameter or signal; entries stand in the order of the file.
    pub(crate) fn line<'a>(&self, raw: &'a RawNetlist, name: &str) -> Option<&'a RawEntry> {
        let (kind, span) = self.values.get(name)?;
        let entries = match kind {
            ValueKind::Parameter => &section(raw, PARAM)?.entries,
            ValueKind::Signal => &section(raw, SIGNAL.name)?.entries,
            ValueKind::Table => return None,
        };
        let at = entries.binary_search_by_key(&span.range.start, |entry| entry.key_span.range.start).ok()?;
        entries.get(at)
    }

    pub(crate) fn is_parameter(&self, name: &str) -> bool {
        self.value_kind(name) == Some(ValueKind::Parameter)
    }

    /// Whether it is a parameter or a signal: a name that stands for a value by itself.
    pub(crate) fn is_value(&self, name: &str) -> bool {
        matches!(self.value_kind(name), Some(ValueKind::Parameter | ValueKind::Signal))
    }

    pub(crate) fn value_kind(&self, name: &str) -> Option<ValueKind> {
        self.values.get(name).map(|(kind, _)| *kind)
    }

    pub(crate) fn is_used(&self, name: &str) -> bool {
        self.used.contains(name)
    }

    /// Notes elements that stand inside another one, below `[node.winding]`.
    fn hide_inner(&mut self, element: &RawEntry) {
        if let RawKind::Table(table) = &element.value.kind {
            let inner = table.entries.iter().filter(|field| matches!(field.value.kind, RawKind::Table(_)));
            self.hidden.extend(inner.map(|field| field.key.clone()).filter(|key| key != "into"));
        }
    }

    /// Notes the names in a section that cannot be read.
    pub(crate) fn hide(&mut self, section: &RawEntry) {
        match &section.value.kind {
            RawKind::Table(table) => self.hidden.extend(table.entries.iter().map(|entry| entry.key.clone())),
            RawKind::Array(list) => {
                // `[[node]]` with its name among its fields
                let fields = list.iter().filter_map(|item| match &item.kind {
                    RawKind::Table(table) => Some(&table.entries),
                    _ => None,
                });
                let names = fields.flatten().filter_map(|field| match &field.value.kind {
                    RawKind::String { text, .. } => Some(text.clone()),
                    _ => None,
                });
                self.hidden.extend(names);
            }
            _ => {}
        }
    }

    pub(crate) fn is_hidden(&self, name: &str) -> bool {
        self.hidden.contains(name)
    }

    /// Notes a material that cannot be read.
    pub(crate) fn hide_material(&mut self, name: &str) {
        self.hidden_materials.insert(name.to_owned());
    }

    pub(crate) fn is_hidden_material(&self, name: &str) -> bool {
        self.hidden_materials.contains(name)
    }

    /// Notes a fluid that cannot be read.
    pub(crate) fn hide_fluid(&mut self, name: &str) {
        self.hidden_fluids.insert(name.to_owned());
    }

    pub(crate) fn is_hidden_fluid(&self, name: &str) -> bool {
        self.hidden_fluids.contains(name)
    }

    pub(crate) fn fail(&mut self, name: &str) {
        self.failed.insert(name.to_owned());
    }

    pub(crate) fn has_failed(&self, name: &str) -> bool {
        self.failed.contains(name) || self.is_hidden(base(name))
    }

    /// The section of the element of this name.
    pub(crate) fn kind_of(&self, name: &str) -> Option<&'static str> {
        self.elements.get(name).copied()
    }

    /// Whether a similar name may still be looked for: not once a file has shown to be full of unknown names.
    pub(crate) fn may_search(&mut self) -> bool {
        self.searches += 1;
        self.searches <= MOST_SEARCHES
    }

    /// The parameters, signals and tables that nothing uses, in file order.
    pub(crate) fn unused(&self) -> impl Iterator<Item = (ValueKind, &str, &Span)> {
        let unused = self.order.iter().filter(|name| !self.used.contains(*name));
        unused.filter_map(|name| {
            let (kind, span) = self.values.get(name)?;
            Some((*kind, name.as_str(), span))
        })
    }

    /// Everything wrong with the names of an expression.
    pub(crate) fn check(
        &mut self,
        place: Place<'_>,
        expression: &Expression,
        wanted: Wanted,
    ) -> Vec<Diagnostic> {
        let names = expression.names().into_iter();
        let problems = names.filter_map(|(name, range)| self.check_name(place, (name, range), wanted));
        let problems = problems.collect();
        let calls = expression.calls().into_iter().map(|(name, _)| name);
        self.used.extend(calls.filter(|name| self.values.contains_key(name)));
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
            self.used.insert(name.clone());
            let changes = kind == ValueKind::Signal && !wanted.time;
            return changes.then(|| depends_on_time(place, &name, at()));
        }
        let result = wanted.context == Context::Result;
        let known = (wanted.names_nodes() && self.is_temperature(&name)) || (result && self.is_heat(&name));
        if known || wanted.is_local(&name) || self.is_hidden(base(&name)) {
            return None; // what hides it has been reported
        }
        if name == "t" {
            return (!wanted.time).then(|| depends_on_time(place, &name, at()));
        }
        let at = at();
        Some(match LOCAL.contains(&name.as_str()) || (name.ends_with(".T") && !wanted.names_nodes()) {
            true => not_here(place, &name, wanted, at),
            false if wanted.context == Context::Result || (wanted.names_nodes() && name.ends_with(".T")) => {
                self.unknown_result(place, &name, at)
            }
            false => self.unknown((place, wanted), &name, at),
        })
    }

    /// `NAME.T` of a node or boundary.
    fn is_temperature(&self, name: &str) -> bool {
        let kind = name.strip_suffix(".T").and_then(|name| self.kind_of(name));
        matches!(kind, Some("node" | "boundary"))
    }

    fn unknown(&mut self, (place, wanted): (Place<'_>, Wanted), name: &str, at: Span) -> Diagnostic {
        let words = place.words();
        if name.contains(['.', '[']) {
            let message = format!("{words} uses `{name}`, which is no parameter");
            return Diagnostic::error("netlist::unknown_name", message).at(at, "unknown name").help(
                "expressions may use parameters, tables and, where time is allowed, signals and `t`: write the value itself",
            );
        }
        let error = Diagnostic::error(
            "netlist::unknown_name",
            format!("{words} uses `{name}`, which is no parameter"),
        )
        .at(at, "unknown name");
        if is_function(name) {
            return error.help(format!("`{name}` is a function: write `{name}(..)`"));
        }
        let search = self.may_search();
        let local = LOCAL.into_iter().filter(|name| wanted.is_local(name));
        let known = self.order.iter().map(String::as_str).chain(["pi"]).chain(local).filter(|_| search);
        let near = suggest(name, known);
        if let Some(near) = near {
            let error = error.help(format!("did you mean `{near}`?"));
            return match self.values.get(near) {
                Some((_, span)) => error.also(span.clone(), "similar name"),
                None => error,
            };
        }
        match self.elements.get(name) {
            Some(&("node" | "boundary")) if wanted.names_nodes() => {
                error.help(format!("its temperature is `{name}.T`"))
            }
            Some(kind) => error.help(format!("`{name}` is a {kind}; expressions use parameters")),
            None => {
                error.help(format!("add it to [param], for example `{name} = {}`", sample_value(place.key)))
            }
        }
    }
}

const BOUND_HELP: &str =
    "what changes belongs in `of`: a difference such as `of = \"steel.T - air.T\"` has a constant bound";

/// Temperatures of what is at hand.
const LOCAL: [&str; 5] = ["T", "T_from", "T_to", "T_mean", "dT"];

/// A temperature in a place that has none of this name.
fn not_here(place: Place<'_>, name: &str, wanted: Wanted, at: Span) -> Diagnostic {
    let words = place.words();
    let message = format!("{words} cannot use the temperature `{name}`");
    let bound = matches!(place.key, "below" | "above");
    let help = match wanted.context {
        _ if bound => BOUND_HELP,
        Context::Link if name == "T" => {
            "a path has the temperatures `T_from`, `T_to` and `T_mean`, and the difference `dT`"
        }
        Context::Source if LOCAL.contains(&name) => {
            "a source has `T`, the temperature of its node; that of another place is `NAME.T`"
        }
        Context::Time if place.key == "density" => {
            "the density of a solid is constant: give it at the temperature at which its volume is measured"
        }
        Context::Own => "it may depend on `T`, the temperature of what it belongs to, and on no other",
        Context::Result => "name the node or boundary, for example `steel.T`",
        _ => {
            "`P` of a source and the values of paths may depend on temperatures; `C` of a node and the properties \
             of materials and fluids on their own `T`"
        }
    };
    Diagnostic::error("netlist::temperature_not_here", message).at(at, "").help(help)
}

/// `t` or a signal where a constant is due.
fn depends_on_time(place: Place<'_>, name: &str, at: Span) -> Diagnostic {
    let (what, label) = match name {
        "t" => ("the time `t`".to_owned(), "time"),
        _ => (format!("signal `{name}`"), "changes with time"),
    };
    let words = place.words();
    let parameter = words.strip_prefix("parameter `").and_then(|rest| rest.strip_suffix('`'));
    if let (Some(parameter), RawKind::String { text, .. }) = (parameter, &place.raw.kind) {
        let message = format!("{words} depends on {what}, but a parameter is constant");
        let help = format!("make it a signal: below [signal] write `{parameter} = \"{}\"`", text.trim());
        return Diagnostic::error("netlist::time_in_parameter", message).at(at, label).help(help);
    }
    let help = match place.key {
        "below" | "above" => BOUND_HELP,
        _ => "sources, boundaries, the values of paths and signals may depend on time; this is constant",
    };
    let message = format!("{} has to be constant, but depends on {what}", place.words());
    Diagnostic::error("network::depends_on_time", message).at(at, label).help(help)
}

/// The entries of a section.
pub(crate) fn section<'a>(raw: &'a RawNetlist, name: &str) -> Option<&'a RawTable> {
    match &raw.top.get(name)?.value.kind {
        RawKind::Table(table) => Some(table),
        _ => None,
    }
}
