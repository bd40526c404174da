//! The result of the templates of a netlist: its instances, and the meaning of names inside them.

use std::borrow::Cow;
use std::collections::BTreeMap;

use foldhash::{HashMap, HashSet};
use lptn_data::{CopyId, Files, Span};
use lptn_units::{Spread, Type};

use crate::raw::{RawEntry, RawValue};

/// The instances of a netlist.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structure {
    /// The names inside each template that is used.
    pub(super) insides: Vec<Inside>,
    /// Texts that are read once more, by [`CopyId`].
    pub(super) copies: Vec<Copied>,
    /// Number of instances.
    pub(super) instances: usize,
    /// Every use by its full name, without index.
    pub(super) uses: BTreeMap<String, Used>,
    /// The lines of the uses that connect ports.
    pub(super) lines: Vec<RawEntry>,
    pub(super) connections: Vec<Connection>,
    /// The types of parameters of instances that are set, and the places of the types.
    pub(super) types: HashMap<String, (Type, Span)>,
    /// The `±` in the template of parameters of instances that are set.
    pub(super) deviations: HashMap<String, Spread>,
    /// Uses that could not be read: their elements are missing.
    pub(super) lost: Vec<String>,
    /// The area in m^2 of the surface at which a path of an enclosure ends, and its place.
    surface_areas: HashMap<String, (f64, Span)>,
}

/// The names inside a template.
#[derive(Clone, Debug)]
pub(super) struct Inside {
    pub(super) template: String,
    /// Parameters, elements and uses.
    pub(super) own: HashSet<String>,
    pub(super) ports: Vec<String>,
}

/// One instance.
#[derive(Clone, Debug)]
pub(super) struct Instance {
    /// Its name, `planet[2]`.
    pub(super) path: String,
    /// Its template, as a position in [`Structure::insides`].
    pub(super) inside: usize,
    /// The full name of the target of each port.
    pub(super) ports: Vec<String>,
    /// Its number, if its use has a `count`.
    pub(super) index: Option<usize>,
}

/// A text that is read once more.
#[derive(Clone, Debug)]
pub(super) enum Copied {
    /// The text of a template, for an instance.
    Instance(Instance),
    /// A value of the text around it, for one of several instances.
    Value {
        /// The text that it belongs to.
        around: CopyId,
        /// The number of the instance.
        index: usize,
    },
}

/// The name of the number of an instance in expressions.
pub(crate) const INDEX: &str = "index";

/// A `[use.NAME]`.
#[derive(Clone, Debug)]
pub(super) struct Used {
    /// Number of instances; `None` for one without index.
    pub(super) count: Option<usize>,
    pub(super) span: Span,
}

/// An end that a port is connected to.
#[derive(Clone, Debug)]
pub(crate) struct Connection {
    /// The line of the use, as a position in [`Structure::lines`].
    line: usize,
    pub(crate) port: String,
    pub(crate) value: RawValue,
    /// Its full name.
    pub(crate) target: String,
}

impl Connection {
    pub(super) fn new(line: usize, port: &str, value: RawValue, target: String) -> Self {
        Self { line, port: port.to_owned(), value, target }
    }
}

/// The part of a path before the first `.` or `[`.
pub(super) fn root(path: &str) -> &str {
    path.split(['.', '[']).next().unwrap_or(path)
}

impl Structure {
    /// Notes the area in m^2 of the surface at which this path of an enclosure ends.
    pub(crate) fn note_surface_area(&mut self, path: String, area: f64, at: &Span) {
        self.surface_areas.insert(path, (area, at.clone()));
    }

    /// The area in m^2 of the surface at which this path of an enclosure ends.
    pub(crate) fn surface_area(&self, path: &str) -> Option<&(f64, Span)> {
        self.surface_areas.get(path)
    }

    fn instance(&self, copy: CopyId) -> Option<(&Instance, &Inside)> {
        match self.copies.get(copy.index()?)? {
            Copied::Instance(instance) => Some((instance, self.insides.get(instance.inside)?)),
            Copied::Value { around, .. } => self.instance(*around),
        }
    }

    /// The number of the instance that a place is read for; `None` if there is none, or if `index`
    /// is a name of the template.
    pub(crate) fn index_at(&self, place: &Span) -> Option<usize> {
        let index = match self.copies.get(place.copy.index()?)? {
            Copied::Instance(instance) => instance.index?,
            Copied::Value { index, .. } => *index,
        };
        self.meaning(place, INDEX).is_none().then_some(index)
    }

    /// Notes that a value is read for one of several instances: `named` has the name of the
    /// instance, and the line of the value.
    pub(super) fn copy_of(
        &mut self,
        files: &mut Files,
        named: (String, Span),
        index: usize,
    ) -> CopyId {
        let around = named.1.copy;
        self.copies.push(Copied::Value { around, index });
        files.add_copy(named.0, named.1)
    }

    /// The full name of a name at `place`, if that is inside a template and the name belongs to it.
    pub(crate) fn meaning(&self, place: &Span, name: &str) -> Option<String> {
        let (instance, inside) = self.instance(place.copy)?;
        let first = root(name);
        if let Some(port) = inside.ports.iter().position(|port| port == first) {
            return Some(format!("{}{}", instance.ports.get(port)?, name.get(first.len()..)?));
        }
        inside.own.contains(first).then(|| format!("{}.{name}", instance.path))
    }

    /// The full name of a name at `place`.
    pub(crate) fn resolve(&self, place: &Span, name: &str) -> String {
        self.meaning(place, name).unwrap_or_else(|| name.to_owned())
    }

    /// The full name of a name at `place`; `None` for a foreign name in a template.
    pub(crate) fn inside<'n>(&self, place: &Span, name: &'n str) -> Option<Cow<'n, str>> {
        let own = || self.template_at(place).is_none().then_some(Cow::Borrowed(name));
        self.meaning(place, name).map(Cow::Owned).or_else(own)
    }

    /// The template that contains a place.
    pub(crate) fn template_at(&self, place: &Span) -> Option<&str> {
        self.instance(place.copy).map(|(_, inside)| inside.template.as_str())
    }

    /// The name of the instance that a place is read for.
    pub(crate) fn instance_at(&self, place: &Span) -> Option<&str> {
        self.instance(place.copy).map(|(instance, _)| instance.path.as_str())
    }

    /// The names that belong to the template at `place`, sorted; nothing may depend on hash order.
    pub(crate) fn names_at(&self, place: &Span) -> Vec<&str> {
        let Some((_, inside)) = self.instance(place.copy) else { return Vec::new() };
        let mut names: Vec<&str> =
            inside.own.iter().chain(&inside.ports).map(String::as_str).collect();
        names.sort_unstable();
        names
    }

    /// True if `full` names a part of the instance at `place`, or of the target of one of its
    /// ports.
    pub(crate) fn belongs(&self, place: &Span, full: &str) -> bool {
        let under = |whole: &str| {
            full.strip_prefix(whole)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        self.instance(place.copy).is_some_and(|(instance, _)| {
            under(&instance.path) || instance.ports.iter().any(|port| under(port))
        })
    }

    /// True if a path is part of a use that could not be read.
    pub(crate) fn is_lost(&self, path: &str) -> bool {
        self.lost.iter().any(|lost| {
            path.strip_prefix(lost.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        })
    }

    /// The full names of all instances of a family, `cell[*].T`, in order; `None` if it is none.
    pub(crate) fn members(&self, place: &Span, pattern: &str) -> Option<Vec<String>> {
        pattern.contains("[*]").then(|| self.all_of(&self.resolve(place, pattern)))?
    }

    /// The same for the full name of a family.
    pub(crate) fn all_of(&self, full: &str) -> Option<Vec<String>> {
        if !full.contains("[*]") {
            return None;
        }
        let mut found = vec![String::new()];
        for part in full.split('.') {
            found = match part.strip_suffix("[*]") {
                None => found.iter().map(|before| format!("{before}{part}.")).collect(),
                Some(name) => {
                    let used = |before: &String| format!("{before}{name}");
                    let counts: Option<Vec<(String, usize)>> = found
                        .iter()
                        .map(|before| Some((used(before), self.count(&used(before))??)))
                        .collect();
                    let all = |(used, count): (String, usize)| {
                        (1..=count).map(move |index| format!("{used}[{index}]."))
                    };
                    counts?.into_iter().flat_map(all).collect()
                }
            };
        }
        Some(found.into_iter().map(|name| name.trim_end_matches('.').to_owned()).collect())
    }

    /// Notes a name whose element cannot be read.
    pub(crate) fn lose(&mut self, name: &str) {
        self.lost.push(name.to_owned());
    }

    /// True if a use could not be read.
    pub(crate) fn has_lost(&self) -> bool {
        !self.lost.is_empty()
    }

    /// Every connection with the line of its use.
    pub(crate) fn connections(&self) -> impl Iterator<Item = (&RawEntry, &Connection)> {
        self.connections
            .iter()
            .filter_map(|connection| Some((self.lines.get(connection.line)?, connection)))
    }

    /// The required type of a parameter of an instance, and the place of that type.
    pub(crate) fn type_of(&self, parameter: &str) -> Option<&(Type, Span)> {
        self.types.get(parameter)
    }

    /// The `±` that a value of a parameter of an instance has if none is written with it.
    pub(crate) fn deviation_of(&self, parameter: &str) -> Option<Spread> {
        self.deviations.get(parameter).copied()
    }

    /// The number of instances of the use of this full name.
    pub(super) fn count(&self, name: &str) -> Option<Option<usize>> {
        self.uses.get(name).map(|used| used.count)
    }
}
