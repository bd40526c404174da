//! The names that expressions may use, and what is said about those they may not.

use std::collections::{HashMap, HashSet};

use lptn_units::{Expression, suggest};

use crate::diagnostic::Diagnostic;
use crate::fields::sample_value;
use crate::file::Span;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable};
use crate::value::{Place, Wanted};
use crate::vocabulary::PARAM;

/// Parameters, and the other names of the file that someone may mistake for one.
#[derive(Debug, Default)]
pub(crate) struct Names {
    parameters: HashMap<String, Span>,
    /// In file order, for suggestions.
    order: Vec<String>,
    elements: HashMap<String, &'static str>,
    /// Parameters whose value is wrong: what uses them is not reported again.
    failed: HashSet<String>,
    used: HashSet<String>,
    /// Names in sections that are not known: they may be what is looked for.
    hidden: HashSet<String>,
    /// Materials that cannot be read.
    hidden_materials: HashSet<String>,
    /// How many similar names were looked for.
    searches: usize,
}

/// After so many suggestions no more are looked for: each takes a look at every name.
const MOST_SEARCHES: usize = 100;

impl Names {
    pub(crate) fn of(raw: &RawNetlist) -> Self {
        let mut names = Self::default();
        for entry in section(raw, PARAM).into_iter().flat_map(|table| &table.entries) {
            names.parameters.insert(entry.key.clone(), entry.key_span.clone());
            names.order.push(entry.key.clone());
        }
        for kind in ["node", "boundary", "source", "capacitor", "resistor", "convection", "limit"] {
            let entries = section(raw, kind).into_iter().flat_map(|table| &table.entries);
            for entry in entries {
                names.elements.entry(entry.key.clone()).or_insert(kind);
            }
        }
        names
    }

    pub(crate) fn is_parameter(&self, name: &str) -> bool {
        self.parameters.contains_key(name)
    }

    /// Notes the names in a section that cannot be read.
    pub(crate) fn hide(&mut self, section: &RawEntry) {
        if let RawKind::Table(table) = &section.value.kind {
            self.hidden.extend(table.entries.iter().map(|entry| entry.key.clone()));
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

    pub(crate) fn fail(&mut self, name: &str) {
        self.failed.insert(name.to_owned());
    }

    pub(crate) fn has_failed(&self, name: &str) -> bool {
        self.failed.contains(name) || self.is_hidden(name.strip_suffix(".T").unwrap_or(name))
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

    /// The parameters that nothing uses, in file order.
    pub(crate) fn unused(&self) -> impl Iterator<Item = (&str, &Span)> {
        let unused = self.order.iter().filter(|name| !self.used.contains(*name));
        unused.filter_map(|name| Some((name.as_str(), self.parameters.get(name)?)))
    }

    /// Everything wrong with the names of an expression.
    pub(crate) fn check(
        &mut self,
        place: Place<'_>,
        expression: &Expression,
        wanted: Wanted,
    ) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        for (name, range) in expression.names() {
            if self.parameters.contains_key(&name) {
                self.used.insert(name);
            } else if wanted.results && self.is_temperature(&name) {
                // the scope of results knows it
            } else if self.is_hidden(name.strip_suffix(".T").unwrap_or(&name)) {
                // what hides it has been reported
            } else if name != "t" {
                let at = place.raw.part(&range);
                let problem = match wanted.results {
                    true => self.unknown_result(place, &name, at),
                    false => self.unknown(place, &name, at),
                };
                problems.push(problem);
            } else if !wanted.time {
                problems.push(depends_on_time(place, place.raw.part(&range)));
            }
        }
        problems
    }

    /// `NAME.T` of a node or boundary.
    fn is_temperature(&self, name: &str) -> bool {
        let kind = name.strip_suffix(".T").and_then(|name| self.kind_of(name));
        matches!(kind, Some("node" | "boundary"))
    }

    /// An unknown name where temperatures may be named.
    fn unknown_result(&mut self, place: Place<'_>, name: &str, at: Span) -> Diagnostic {
        let words = place.words();
        let base = name.strip_suffix(".T");
        let message = match base {
            Some(base) => format!("{words}: no node or boundary named `{base}`"),
            None => format!("{words} uses `{name}`, which is no parameter"),
        };
        let error = Diagnostic::error("netlist::unknown_name", message).at(at, "unknown name");
        let kind = self.kind_of(base.unwrap_or(name));
        match (kind, base) {
            (Some("node" | "boundary"), None) => error.help(format!("its temperature is `{name}.T`")),
            (Some(kind), _) => {
                let name = base.unwrap_or(name);
                error.help(format!("`{name}` is a {kind}; temperatures are those of nodes and boundaries"))
            }
            (None, _) => match self.similar_result(name) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help(
                    "name the temperature of a node or boundary, for example `steel.T`, a parameter or `t`",
                ),
            },
        }
    }

    /// The most similar parameter or temperature; of equally similar ones the first in the alphabet.
    fn similar_result(&mut self, name: &str) -> Option<String> {
        if !self.may_search() {
            return None;
        }
        let places = self.elements.iter().filter(|(_, kind)| matches!(**kind, "node" | "boundary"));
        let mut names: Vec<String> = places.map(|(name, _)| format!("{name}.T")).collect();
        names.extend(self.order.iter().cloned());
        names.sort_unstable();
        suggest(name, names.iter().map(String::as_str)).map(str::to_owned)
    }

    fn unknown(&mut self, place: Place<'_>, name: &str, at: Span) -> Diagnostic {
        let words = place.words();
        if name.contains(['.', '[']) || matches!(name, "T" | "T_from" | "T_to" | "T_mean" | "dT") {
            let message = format!("{words}: `{name}`, a temperature in an expression, is not supported yet");
            let help = match place.key {
                "below" | "above" => BOUND_HELP,
                _ => "expressions may use the parameters and, where time is allowed, `t`",
            };
            return Diagnostic::error("netlist::not_supported_yet", message).at(at, "").help(help);
        }
        let error = Diagnostic::error(
            "netlist::unknown_name",
            format!("{words} uses `{name}`, which is no parameter"),
        )
        .at(at, "unknown name");
        let near =
            if self.may_search() { suggest(name, self.order.iter().map(String::as_str)) } else { None };
        if let Some(near) = near {
            let error = error.help(format!("did you mean `{near}`?"));
            return match self.parameters.get(near) {
                Some(span) => error.also(span.clone(), "similar name"),
                None => error,
            };
        }
        match self.elements.get(name) {
            Some(kind) => error.help(format!("`{name}` is a {kind}; expressions use parameters")),
            None => {
                error.help(format!("add it to [param], for example `{name} = {}`", sample_value(place.key)))
            }
        }
    }
}

const BOUND_HELP: &str =
    "what changes belongs in `of`: a difference such as `of = \"steel.T - air.T\"` has a constant bound";

fn depends_on_time(place: Place<'_>, at: Span) -> Diagnostic {
    let help = match place.key {
        "below" | "above" => BOUND_HELP,
        _ => "only `P` of a source and `T` of a boundary may depend on `t`: write the expression there",
    };
    if place.key.is_empty() {
        let message = format!("{} depends on the time `t`, but a parameter is constant", place.words());
        return Diagnostic::error("netlist::time_in_parameter", message).at(at, "time").help(help);
    }
    let message = format!("{} has to be constant, but depends on the time `t`", place.words());
    Diagnostic::error("network::depends_on_time", message).at(at, "time").help(help)
}

/// The entries of a section.
pub(crate) fn section<'a>(raw: &'a RawNetlist, name: &str) -> Option<&'a RawTable> {
    match &raw.top.get(name)?.value.kind {
        RawKind::Table(table) => Some(table),
        _ => None,
    }
}
