//! The names of a netlist and their meanings.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use foldhash::{HashMap, HashSet};
use lptn_data::Span;
use lptn_network::FaceStreamId;
use lptn_units::Expression;

use crate::format::NetlistFormat;
use crate::grid_part::KnownGrid;
use crate::raw::{RawEntry, RawKind, RawNetlist};
use crate::template::{INDEX, Structure};

lptn_units::words! {
/// The kind of a name in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ValueKind {
    Parameter = "parameter",
    Signal = "signal",
    Control = "control",
    State = "state",
    Value = "value",
    Table = "table",
}
/// Its name in messages.
pub(crate) fn word;
}

impl ValueKind {
    /// The section of such values.
    pub(crate) const fn section(self) -> &'static str {
        match self {
            Self::Parameter => "param",
            Self::Signal => "signal",
            Self::Control => "control",
            Self::State => "state",
            Self::Value => "value",
            Self::Table => "table",
        }
    }
}

/// Parameters, signals, controls and tables, and the other names of the file that someone may
/// mistake for one.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// The meaning of names inside templates.
    pub(crate) structure: Arc<Structure>,
    /// With the place of the key, and the position in the section.
    pub(crate) values: HashMap<String, (ValueKind, Span, usize)>,
    /// In file order, for suggestions.
    pub(crate) order: Vec<String>,
    pub(crate) elements: HashMap<String, &'static str>,
    /// Wrong values: elements that use them are not reported again.
    failed: HashSet<String>,
    /// Results that other laws of an element's kind have, with the reason why its own has not.
    pub(crate) untold: HashMap<String, &'static str>,
    pub(crate) used: HashSet<String>,
    /// Values in temperatures at the start that the state of a run replaces.
    replaced: HashSet<String>,
    /// True while such a temperature is read.
    pub(crate) is_replaced: bool,
    /// Nodes and boundaries whose results expressions read.
    pub(crate) read: HashSet<String>,
    /// Names in unknown sections: an unknown name may be one of these.
    hidden: HashSet<String>,
    /// Materials and fluids that cannot be read, by section.
    hidden_substances: HashSet<(&'static str, String)>,
    /// A file of names is missing: an unknown name may be in it.
    all_hidden: bool,
    /// Expressions by their text: templates and scripts write one many times.
    pub(crate) expressions: RefCell<HashMap<String, Expression>>,
    /// Number of searches for similar names.
    searches: usize,
    /// Grids by name.
    pub(crate) grids: BTreeMap<String, KnownGrid>,
    /// Streams along faces by name.
    pub(crate) streams: BTreeMap<String, FaceStreamId>,
    /// Grids that cannot be read.
    hidden_grids: HashSet<String>,
    /// Number of names that these searches compared.
    looks: usize,
}

/// After this number of suggestions no more are searched for: each search compares every name.
const MOST_SEARCHES: usize = 100;

/// Nor after this number of comparisons.
const MOST_LOOKS: usize = 4_000_000;

impl Names {
    pub(crate) fn of(raw: &RawNetlist, structure: &Arc<Structure>, format: &NetlistFormat) -> Self {
        let mut names = Self { structure: Arc::clone(structure), ..Self::default() };
        for kind in ValueKind::ALL {
            let entries = raw.elements(kind.section()).iter();
            for (position, entry) in entries.enumerate() {
                names.order.push(entry.key.clone());
                if names.values.contains_key(&entry.key) {
                    names.fail(&entry.key); // taken twice: the meaning is unclear
                } else {
                    names
                        .values
                        .insert(entry.key.clone(), (kind, entry.key_span.clone(), position));
                }
            }
        }
        for kind in format.elements() {
            let entries = raw.elements(kind);
            names.elements.reserve(entries.len());
            for entry in entries {
                names.elements.entry(entry.key.clone()).or_insert(kind);
                names.hide_inner(entry);
            }
        }
        names
    }

    /// The line of a parameter or signal.
    pub(crate) fn line<'a>(&self, raw: &'a RawNetlist, name: &str) -> Option<&'a RawEntry> {
        let (kind, _, position) = self.values.get(name)?;
        let entries = match kind {
            ValueKind::Parameter | ValueKind::Signal | ValueKind::Value => {
                raw.elements(kind.section())
            }
            ValueKind::Control | ValueKind::State | ValueKind::Table => return None,
        };
        entries.get(*position)
    }

    pub(crate) fn is_parameter(&self, name: &str) -> bool {
        self.value_kind(name) == Some(ValueKind::Parameter)
    }

    /// True for a parameter, a signal or a control: a name that is a value by itself.
    pub(crate) fn is_value(&self, name: &str) -> bool {
        matches!(self.value_kind(name), Some(kind) if kind != ValueKind::Table)
    }

    pub(crate) fn value_kind(&self, name: &str) -> Option<ValueKind> {
        self.values.get(name).map(|(kind, ..)| *kind)
    }

    /// Notes that a study gives a parameter values, which is a use of it.
    pub(crate) fn use_by_study(&mut self, name: &str) {
        self.used.insert(name.to_owned());
    }

    pub(crate) fn is_used(&self, name: &str) -> bool {
        self.used.contains(name)
    }

    /// Notes a use of a value. In a temperature that a state replaces it has no effect.
    pub(crate) fn note_use(&mut self, name: &str) {
        let uses = if self.is_replaced { &mut self.replaced } else { &mut self.used };
        uses.insert(name.to_owned());
    }

    /// The values that only temperatures use which the state of a run replaces.
    pub(crate) fn without_effect(&self) -> impl Iterator<Item = &String> {
        self.replaced.difference(&self.used)
    }

    /// Notes elements that are inside another one, below `[node.winding]`.
    fn hide_inner(&mut self, element: &RawEntry) {
        if let RawKind::Table(table) = &element.value.kind {
            let inner =
                table.entries.iter().filter(|field| matches!(field.value.kind, RawKind::Table(_)));
            self.hidden.extend(inner.map(|field| field.key.clone()).filter(|key| key != "into"));
        }
    }

    /// Notes the names in a section that cannot be read.
    pub(crate) fn hide(&mut self, section: &RawEntry) {
        match &section.value.kind {
            RawKind::Table(table) => {
                self.hidden.extend(table.entries.iter().map(|entry| entry.key.clone()))
            }
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

    /// Notes that a file of names cannot be read.
    pub(crate) fn hide_all(&mut self) {
        self.all_hidden = true;
    }

    pub(crate) fn is_hidden(&self, name: &str) -> bool {
        let inside = || {
            name.match_indices(['.', '[']).any(|(at, _)| self.hidden_grids.contains(&name[..at]))
        };
        self.all_hidden
            || self.hidden.contains(name)
            || (!self.hidden_grids.is_empty() && inside())
            || self.structure.is_lost(name)
    }

    /// Notes a grid that cannot be read.
    pub(crate) fn hide_grid(&mut self, name: &str) {
        self.hidden.insert(name.to_owned());
        self.hidden_grids.insert(name.to_owned());
    }

    /// Notes a name that has been reported.
    pub(crate) fn hide_name(&mut self, name: &str) {
        self.hidden.insert(name.to_owned());
    }

    /// An expression with the names that are meant at its place.
    pub(crate) fn resolved(&self, place: &Span, expression: Expression) -> Expression {
        let expression = match self.index_at(place) {
            Some(index) => expression.with_number(INDEX, index),
            None => expression,
        };
        let full = expression.renamed(&|name| self.structure.meaning(place, name));
        full.with_members(&|name| self.structure.all_of(name)).into_owned()
    }

    /// The number of the instance that a place is read for, unless `index` has another meaning
    /// in the file.
    fn index_at(&self, place: &Span) -> Option<usize> {
        self.structure.index_at(place).filter(|_| !self.is_value(INDEX))
    }

    /// True if a name, with the meaning that it has at its place, is a value by itself.
    pub(crate) fn is_value_at(&self, place: &Span, name: &str) -> bool {
        let index = || name == INDEX && self.structure.index_at(place).is_some();
        let meant = self.structure.meaning(place, name);
        self.is_value(meant.as_deref().unwrap_or(name)) || index()
    }

    /// Notes a material or fluid that cannot be read, with its section.
    pub(crate) fn hide_substance(&mut self, section: &'static str, name: &str) {
        self.hidden_substances.insert((section, name.to_owned()));
    }

    pub(crate) fn is_hidden_substance(&self, section: &'static str, name: &str) -> bool {
        self.hidden_substances.contains(&(section, name.to_owned()))
    }

    pub(crate) fn fail(&mut self, name: &str) {
        self.failed.insert(name.to_owned());
    }

    pub(crate) fn has_failed(&self, name: &str) -> bool {
        self.failed.contains(name) || self.is_hidden(base(name))
    }

    /// Notes an imported element that an expression names.
    pub(crate) fn learn(&mut self, name: &str, kind: &'static str) {
        self.elements.insert(name.to_owned(), kind);
    }

    /// The section of the element of this name.
    pub(crate) fn kind_of(&self, name: &str) -> Option<&'static str> {
        self.elements.get(name).copied()
    }

    /// True if a similar name may be searched for among `names` names: not in a file that has
    /// proved to be full of unknown names.
    pub(crate) fn may_search(&mut self, names: usize) -> bool {
        self.searches += 1;
        self.looks += names;
        self.searches <= MOST_SEARCHES && self.looks <= MOST_LOOKS.max(names)
    }

    /// True if an expression reads the temperature or the heat of the node or boundary of this
    /// name.
    pub(crate) fn reads(&self, name: &str) -> bool {
        self.read.contains(name)
    }

    /// The parameters, signals, controls and tables that nothing uses, in file order.
    pub(crate) fn unused(&self) -> impl Iterator<Item = (ValueKind, &str, &Span)> {
        let is_used = |name: &String| self.used.contains(name) || self.replaced.contains(name);
        let unused = self.order.iter().filter(move |name| !is_used(name));
        unused.filter_map(|name| {
            let (kind, span, _) = self.values.get(name)?;
            // a state is a result by itself
            // so is the flow of a branch in another unit
            (*kind != ValueKind::State && !is_branch_result(name)).then_some(())?;
            Some((*kind, name.as_str(), span))
        })
    }
}

/// Results of a branch in addition to its mass flow: values that may stay unused.
const BRANCH_RESULTS: [&str; 3] = ["volume_flow", "Re", "power"];

fn is_branch_result(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, key)| BRANCH_RESULTS.contains(&key))
}

/// The element of a result: `steel` of `steel.T`.
pub(crate) fn base(name: &str) -> &str {
    match name.rsplit_once('.') {
        Some((base, "T" | "Q" | "Q_from" | "Q_to" | "P")) => base,
        _ => name,
    }
}
