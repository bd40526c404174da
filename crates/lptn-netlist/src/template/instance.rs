//! Makes the elements of every instance.

use super::definition::{Template, taken_twice};
use super::plan::{MOST_INSTANCES, Plan, of_instance, plan};
use super::structure::{Connection, Copied, INDEX, Inside, Instance, Structure, Used};
use foldhash::{HashMap, HashMapExt as _, HashSet};
use lptn_data::{CopyId, Diagnostic, Files, Span};

use crate::format::{NetlistFormat, Role};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::template::USE;

/// The surroundings of instances: prefix of their names, and instance of their text.
struct Around {
    prefix: String,
    copy: CopyId,
}

/// Adds the elements of instances after those of the file.
pub(super) struct Maker<'r, 'w> {
    files: &'w mut Files,
    format: &'w NetlistFormat,
    templates: &'r [Template<'r>],
    /// Number of instances that one instance of each template makes.
    sizes: &'w [usize],
    raw: &'w mut RawNetlist,
    /// The sections of the netlist by name.
    sections: HashMap<String, usize>,
    /// The position of the names inside each template, once it is used.
    insides: HashMap<usize, usize>,
    structure: Structure,
    problems: Vec<Diagnostic>,
}

impl<'r, 'w> Maker<'r, 'w> {
    pub(super) fn new(
        (files, format): (&'w mut Files, &'w NetlistFormat),
        (templates, sizes): (&'r [Template<'r>], &'w [usize]),
        raw: &'w mut RawNetlist,
    ) -> Self {
        let entries = raw.top.entries.iter().enumerate();
        let sections = entries.map(|(position, entry)| (entry.key.clone(), position)).collect();
        let (structure, problems) = (Structure::default(), Vec::new());
        Self {
            files,
            format,
            templates,
            sizes,
            raw,
            sections,
            insides: HashMap::new(),
            structure,
            problems,
        }
    }

    /// The uses of the file itself.
    pub(super) fn top(&mut self, uses: &[RawEntry]) {
        if uses.is_empty() {
            return;
        }
        let taken = elements(self.raw, self.format);
        let clashes = uses.iter().filter_map(|entry| {
            let (kind, span) = taken.get(entry.key.as_str())?;
            Some(taken_twice((&entry.key, &entry.key_span), USE.name, (kind, span)))
        });
        self.problems.extend(clashes);
        let around = Around { prefix: String::new(), copy: CopyId::WRITTEN };
        uses.iter().for_each(|entry| self.make(entry, &around));
    }

    /// The instances, the errors, and the templates that were named.
    pub(super) fn finish(self) -> (Structure, Vec<Diagnostic>, HashSet<usize>) {
        let templates = self.templates.iter().enumerate();
        let broken =
            templates.filter(|(_, template)| template.broken).map(|(position, _)| position);
        let used = self.insides.keys().copied().chain(broken).collect();
        (self.structure, self.problems, used)
    }

    fn make(&mut self, entry: &RawEntry, around: &Around) {
        let name = format!("{}{}", around.prefix, entry.key);
        let entry = copied(entry, around.copy);
        let before = self.problems.len();
        let plan = plan(self.templates, &entry, &mut self.problems);
        let made = plan.as_ref().map_or(0, |plan| {
            plan.count
                .unwrap_or(1)
                .saturating_mul(self.sizes.get(plan.position).copied().unwrap_or(1))
        });
        let room = MOST_INSTANCES - self.structure.instances.min(MOST_INSTANCES);
        if made > room && self.problems.len() == before {
            self.problems.push(too_many(&entry));
        }
        let Some(plan) = plan.filter(|_| self.problems.len() == before) else {
            // the template was meant to be used
            self.note_template(&entry);
            return self.structure.lost.push(name);
        };
        let used = Used { count: plan.count, span: entry.key_span.clone() };
        self.structure.uses.insert(name.clone(), used);
        let inside = self.inside(&plan);
        let line = self.structure.lines.len();
        self.structure.lines.push(entry.clone());
        for number in 0..plan.count.unwrap_or(1) {
            let path = match plan.count {
                Some(_) => format!("{name}[{}]", number + 1),
                None => name.clone(),
            };
            let copy = self.files.add_copy(path.clone(), entry.key_span.clone());
            let ports = self.ports((&plan, number), line);
            let index = plan.count.map(|_| number + 1);
            let instance = Instance { path: path.clone(), inside, ports, index };
            self.structure.copies.push(Copied::Instance(instance));
            self.structure.instances += 1;
            self.parameters((&plan, number), (&path, &entry.key_span), copy);
            for (section, table) in &plan.template.sections {
                table
                    .entries
                    .iter()
                    .for_each(|element| self.element(section, element, (&path, copy)));
            }
            let around = Around { prefix: path + ".", copy };
            plan.template.uses.iter().for_each(|entry| self.make(entry, &around));
        }
    }

    /// Notes the template of a use that cannot be made.
    fn note_template(&mut self, entry: &RawEntry) {
        let RawKind::Table(table) = &entry.value.kind else { return };
        let Some(RawKind::String { text, .. }) =
            table.get("template").map(|field| &field.value.kind)
        else {
            return;
        };
        if let Some(position) = self.templates.iter().position(|template| template.name() == text) {
            self.insides.entry(position).or_insert(usize::MAX);
        }
    }

    /// The names inside the template of a plan.
    fn inside(&mut self, plan: &Plan<'_>) -> usize {
        if let Some(known) = self.insides.get(&plan.position).filter(|known| **known != usize::MAX)
        {
            return *known;
        }
        let template = plan.template;
        let parameters = template.parameters.iter().map(|parameter| parameter.entry.key.clone());
        let elements = template.elements().map(|(_, entry)| entry.key.clone());
        let uses = template.uses.iter().map(|entry| entry.key.clone());
        let own = parameters.chain(elements).chain(uses).collect();
        let ports = template.ports.iter().map(|(port, _)| (*port).to_owned()).collect();
        let position = self.structure.insides.len();
        self.structure.insides.push(Inside { template: template.name().to_owned(), own, ports });
        self.insides.insert(plan.position, position);
        position
    }

    /// The full name of the target of each port of an instance.
    fn ports(&mut self, (plan, number): (&Plan<'_>, usize), line: usize) -> Vec<String> {
        let mut targets = Vec::new();
        for (port, _) in &plan.template.ports {
            let given = plan.connect.iter().find(|(name, _)| name == port);
            let value = given.and_then(|(_, values)| of_instance(values, number));
            let Some((value, RawKind::String { text, .. })) =
                value.map(|value| (value, &value.kind))
            else {
                targets.push(String::new()); // reported with the plan
                continue;
            };
            let target = self.structure.resolve(&value.span, text);
            let single = given.is_some_and(|(_, values)| values.len() == 1);
            if !(single && number > 0) {
                self.structure.connections.push(Connection::new(
                    line,
                    port,
                    value.clone(),
                    target.clone(),
                ));
            }
            targets.push(target);
        }
        targets
    }

    /// The parameters of an instance: those that are set, and the others as the template has them.
    fn parameters(
        &mut self,
        (plan, number): (&Plan<'_>, usize),
        (path, line): (&str, &Span),
        copy: CopyId,
    ) {
        let set: Vec<_> = plan.set.iter().map(|(_, values)| of_instance(values, number)).collect();
        let counts = plan.count.is_some() && set.iter().flatten().any(|value| mentions(value));
        let named = || (path.to_owned(), line.clone());
        let own = counts.then(|| self.structure.copy_of(self.files, named(), number + 1));
        for parameter in &plan.template.parameters {
            let (written, key) = (parameter.entry, format!("{path}.{}", parameter.entry.key));
            let given = plan.set.iter().position(|(given, _)| given.entry.key == written.key);
            let value = given.and_then(|given| set.get(given).copied().flatten());
            if let (Some(ty), true) = (parameter.ty, value.is_some()) {
                self.structure.types.insert(key.clone(), (ty, written.value.span.clone()));
            }
            if let (Some(deviation), true) = (parameter.deviation, value.is_some()) {
                self.structure.deviations.insert(key.clone(), deviation);
            }
            let value = match (value, own) {
                (Some(value), Some(own)) if mentions(value) => copied_value(value, own),
                (Some(value), _) => value.clone(),
                (None, _) => copied_value(&written.value, copy),
            };
            let key_span = written.key_span.for_copy(copy);
            self.push(
                (ValueKind::Parameter.section(), &written.key_span),
                RawEntry { key, key_span, value },
            );
        }
    }

    fn element(&mut self, section: &RawEntry, element: &RawEntry, (path, copy): (&str, CopyId)) {
        let mut entry = copied(element, copy);
        entry.key = format!("{path}.{}", element.key);
        self.push((&section.key, &section.key_span), entry);
    }

    /// Adds an entry to a section, after the existing ones.
    fn push(&mut self, (section, at): (&str, &Span), entry: RawEntry) {
        let entries = &mut self.raw.top.entries;
        let position = *self.sections.entry(section.to_owned()).or_insert_with(|| {
            let kind = RawKind::Table(RawTable { span: at.clone(), entries: Vec::new() });
            let value = RawValue { span: at.clone(), kind };
            entries.push(RawEntry { key: section.to_owned(), key_span: at.clone(), value });
            entries.len() - 1
        });
        if let Some(RawKind::Table(table)) =
            entries.get_mut(position).map(|entry| &mut entry.value.kind)
        {
            table.entries.push(entry);
        }
    }
}

/// The elements of the file by name, each with its section.
fn elements(raw: &RawNetlist, format: &NetlistFormat) -> HashMap<String, (String, Span)> {
    let known = |name: &str| format.role(name).is_none_or(|role| role == Role::Element);
    let sections = raw.top.entries.iter().filter(|section| known(&section.key));
    let elements = sections.filter_map(|section| match &section.value.kind {
        RawKind::Table(table) => Some((section, table)),
        _ => None,
    });
    let named = elements.flat_map(|(section, table)| {
        table
            .entries
            .iter()
            .map(|entry| (entry.key.clone(), (section.key.clone(), entry.key_span.clone())))
    });
    named.collect()
}

/// True if a value may read the number of its instance.
pub(super) fn mentions(value: &RawValue) -> bool {
    match &value.kind {
        RawKind::String { text, .. } => text.contains(INDEX),
        RawKind::Array(list) => list.iter().any(mentions),
        RawKind::Table(table) => table.entries.iter().any(|entry| mentions(&entry.value)),
        _ => false,
    }
}

/// An entry as it is read for an instance.
pub(super) fn copied(entry: &RawEntry, copy: CopyId) -> RawEntry {
    RawEntry {
        key: entry.key.clone(),
        key_span: entry.key_span.for_copy(copy),
        value: copied_value(&entry.value, copy),
    }
}

fn copied_value(value: &RawValue, copy: CopyId) -> RawValue {
    let kind = match &value.kind {
        RawKind::Array(list) => {
            RawKind::Array(list.iter().map(|value| copied_value(value, copy)).collect())
        }
        RawKind::Table(table) => {
            let entries = table.entries.iter().map(|entry| copied(entry, copy)).collect();
            RawKind::Table(RawTable { span: table.span.for_copy(copy), entries })
        }
        plain => plain.clone(),
    };
    RawValue { span: value.span.for_copy(copy), kind }
}

fn too_many(entry: &RawEntry) -> Diagnostic {
    let message = format!("templates make more than {MOST_INSTANCES} instances");
    Diagnostic::wrong(
        "netlist::count",
        message,
        &entry.key_span,
        "counts of templates inside each other multiply: make one of them smaller",
    )
}
