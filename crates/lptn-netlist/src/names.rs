//! The names that expressions may use, and what is said about those they may not.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::sync::{Arc, LazyLock};

use lptn_data::{Diagnostic, Span};
use lptn_laws::Kind;
use lptn_network::Context;
use lptn_units::{Expression, is_function, suggest};

use crate::fields::sample_value;
use crate::grid_names::KnownGrid;
use crate::misplaced::{LOCAL, depends_on_time, not_here};
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable};
use crate::result_names::base;
use crate::section::control_not_here;
use crate::template::{Structure, in_own_words, outside, wrong_path};
use crate::value::{Place, Wanted};
use crate::vocabulary::{CONTROL, PARAM, SIGNAL, TABLE};

/// What a name in an expression can stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ValueKind {
    Parameter,
    Signal,
    Control,
    Table,
}

impl ValueKind {
    /// Each with its section.
    const ALL: [(Self, &'static str); 4] = [
        (Self::Parameter, PARAM),
        (Self::Signal, SIGNAL.name),
        (Self::Control, CONTROL.name),
        (Self::Table, TABLE.name),
    ];

    /// What it is called in messages.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Signal => "signal",
            Self::Control => "control",
            Self::Table => "table",
        }
    }
}

/// Parameters, signals, controls and tables, and the other names of the file that someone may mistake for one.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// What names mean inside templates.
    pub(crate) structure: Arc<Structure>,
    /// With the place of the key, and the position in the section.
    values: HashMap<String, (ValueKind, Span, usize)>,
    /// In file order, for suggestions.
    pub(crate) order: Vec<String>,
    pub(crate) elements: HashMap<String, &'static str>,
    /// Values that are wrong: what uses them is not reported again.
    failed: HashSet<String>,
    used: HashSet<String>,
    /// Nodes and boundaries whose results expressions read.
    read: HashSet<String>,
    /// Names in sections that are not known: they may be what is looked for.
    hidden: HashSet<String>,
    /// Materials that cannot be read.
    hidden_materials: HashSet<String>,
    /// Fluids that cannot be read.
    hidden_fluids: HashSet<String>,
    /// A file of names is missing: any name may be what is looked for.
    all_hidden: bool,
    /// How many similar names were looked for.
    searches: usize,
    /// Grids by name.
    pub(crate) grids: BTreeMap<String, KnownGrid>,
    /// Grids that cannot be read.
    hidden_grids: HashSet<String>,
    /// How many names were looked at for that.
    looks: usize,
}

/// After so many suggestions no more are looked for: each takes a look at every name.
const MOST_SEARCHES: usize = 100;

/// After so many looks at names neither.
const MOST_LOOKS: usize = 4_000_000;

/// The sections whose elements share one set of names.
static ELEMENTS: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let paths = Kind::ALL.iter().map(|kind| kind.declaration().section);
    ["node", "grid", "boundary", "source", "capacitor"].into_iter().chain(paths).chain(["limit"]).collect()
});

impl Names {
    pub(crate) fn of(raw: &RawNetlist, structure: &Arc<Structure>) -> Self {
        let mut names = Self { structure: Arc::clone(structure), ..Self::default() };
        for (kind, heading) in ValueKind::ALL {
            let entries = section(raw, heading).into_iter().flat_map(|table| &table.entries);
            for (position, entry) in entries.enumerate() {
                names.order.push(entry.key.clone());
                if names.values.contains_key(&entry.key) {
                    names.fail(&entry.key); // taken twice: what is meant cannot be told
                } else {
                    names.values.insert(entry.key.clone(), (kind, entry.key_span.clone(), position));
                }
            }
        }
        for kind in ELEMENTS.iter() {
            let entries = section(raw, kind).into_iter().flat_map(|table| &table.entries);
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
            ValueKind::Parameter => &section(raw, PARAM)?.entries,
            ValueKind::Signal => &section(raw, SIGNAL.name)?.entries,
            ValueKind::Control | ValueKind::Table => return None,
        };
        entries.get(*position)
    }

    pub(crate) fn is_parameter(&self, name: &str) -> bool {
        self.value_kind(name) == Some(ValueKind::Parameter)
    }

    /// Whether it is a parameter, a signal or a control: a name that stands for a value by itself.
    pub(crate) fn is_value(&self, name: &str) -> bool {
        matches!(self.value_kind(name), Some(kind) if kind != ValueKind::Table)
    }

    pub(crate) fn value_kind(&self, name: &str) -> Option<ValueKind> {
        self.values.get(name).map(|(kind, ..)| *kind)
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

    /// Notes that a file of names cannot be read.
    pub(crate) fn hide_all(&mut self) {
        self.all_hidden = true;
    }

    pub(crate) fn is_hidden(&self, name: &str) -> bool {
        let inside = || name.match_indices(['.', '[']).any(|(at, _)| self.hidden_grids.contains(&name[..at]));
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
        expression.renamed(&|name| self.structure.meaning(place, name))
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

    /// Notes an imported element that an expression names.
    pub(crate) fn learn(&mut self, name: &str, kind: &'static str) {
        self.elements.insert(name.to_owned(), kind);
    }

    /// The section of the element of this name.
    pub(crate) fn kind_of(&self, name: &str) -> Option<&'static str> {
        self.elements.get(name).copied()
    }

    /// Whether a similar name may still be looked for among so many: not once a file has shown to be full of unknown
    /// names.
    pub(crate) fn may_search(&mut self, names: usize) -> bool {
        self.searches += 1;
        self.looks += names;
        self.searches <= MOST_SEARCHES && self.looks <= MOST_LOOKS.max(names)
    }

    /// Whether an expression reads the temperature or the heat of the node or boundary of this name.
    pub(crate) fn reads(&self, name: &str) -> bool {
        self.read.contains(name)
    }

    /// The parameters, signals, controls and tables that nothing uses, in file order.
    pub(crate) fn unused(&self) -> impl Iterator<Item = (ValueKind, &str, &Span)> {
        let unused = self.order.iter().filter(|name| !self.used.contains(*name));
        unused.filter_map(|name| {
            let (kind, span, _) = self.values.get(name)?;
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
        let problems: Vec<Diagnostic> = problems.collect();
        let problems =
            problems.into_iter().map(|problem| in_own_words(&self.structure, place, problem)).collect();
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
            return match kind {
                ValueKind::Signal if !wanted.time => Some(depends_on_time(place, &name, at())),
                ValueKind::Control if !wanted.controls => Some(control_not_here(place, &name, at())),
                _ => None,
            };
        }
        let result = wanted.context == Context::Result;
        let known = (wanted.names_nodes() && self.is_temperature(&name)) || (result && self.is_heat(&name));
        if known {
            self.read.insert(base(&name).to_owned());
        }
        let template = self.structure.template_at(&place.raw.span);
        if let (true, Some(template)) = (known && !self.structure.belongs(&place.raw.span, &name), template) {
            return Some(outside(place, &name, template).at(at(), "not in the template"));
        }
        if known || self.is_of_grid(&name, wanted) || wanted.is_local(&name) || self.is_hidden(base(&name)) {
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
                "expressions may use parameters, tables and, where time is allowed, signals, controls and `t`: write the value itself",
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
            None => {
                error.help(format!("add it to [param], for example `{name} = {}`", sample_value(place.key)))
            }
        }
    }
}

/// The entries of a section.
pub(crate) fn section<'a>(raw: &'a RawNetlist, name: &str) -> Option<&'a RawTable> {
    match &raw.top.get(name)?.value.kind {
        RawKind::Table(table) => Some(table),
        _ => None,
    }
}
