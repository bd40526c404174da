//! `[template.NAME]`: the contents of a part, before it is used.

use lptn_data::{Diagnostic, nearest};
use lptn_network::is_name;
use lptn_units::{RESERVED, Spread, Type, Unit, parse_quantity};

use super::{TEMPLATE, USE};
use crate::fields::{Fields, Owner, wrong_shape};
use crate::format::{NetlistFormat, SectionDeclaration, text};
use crate::names::ValueKind;
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

const PORT: &str = "port";

/// A parameter of a template without a value: `R = { unit = "K/W" }`.
pub(super) const OPEN_PARAMETER: SectionDeclaration = SectionDeclaration {
    name: "param",
    keys: &[text("unit", "unit", "the unit of the values that it is set to", "\"K/W\"").needed()],
    example: "{ unit = \"K/W\" }",
    elsewhere: &[
        ("value", "a default value is written alone: `m = \"0.2 kg\"`"),
        ("default", "a default value is written alone: `m = \"0.2 kg\"`"),
    ],
    ..SectionDeclaration::NEW
};

/// A template, checked as far as possible without its uses.
#[derive(Debug)]
pub(super) struct Template<'r> {
    /// Its line.
    pub(super) entry: &'r RawEntry,
    pub(super) parameters: Vec<Parameter<'r>>,
    /// The names of its ports, in order.
    pub(super) ports: Vec<(&'r str, &'r RawValue)>,
    /// Its sections of elements, in order.
    pub(super) sections: Vec<(&'r RawEntry, &'r RawTable)>,
    /// The templates that it uses.
    pub(super) uses: &'r [RawEntry],
    /// True if it has an error: then it cannot be used.
    pub(super) broken: bool,
}

/// A parameter of a template.
#[derive(Debug)]
pub(super) struct Parameter<'r> {
    pub(super) entry: &'r RawEntry,
    /// True if it has a value.
    pub(super) default: bool,
    /// Its type, if written: that of its value, or of its unit.
    pub(super) ty: Option<Type>,
    /// The `±` of its value.
    pub(super) deviation: Option<Spread>,
}

impl<'r> Template<'r> {
    pub(super) fn name(&self) -> &'r str {
        &self.entry.key
    }

    pub(super) fn parameter(&self, name: &str) -> Option<&Parameter<'r>> {
        self.parameters.iter().find(|parameter| parameter.entry.key == name)
    }

    /// Reads a template and reports its errors.
    pub(super) fn read(
        entry: &'r RawEntry,
        format: &NetlistFormat,
        problems: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut template = Self {
            entry,
            parameters: Vec::new(),
            ports: Vec::new(),
            sections: Vec::new(),
            uses: &[],
            broken: false,
        };
        let before = problems.len();
        match &entry.value.kind {
            RawKind::Table(table) => {
                table.entries.iter().for_each(|part| template.part(part, format, problems))
            }
            kind => {
                problems.push(no_table(&format!("template `{}`", entry.key), &entry.value, kind))
            }
        }
        problems.extend(template.names());
        template.broken = problems.len() > before;
        template
    }

    fn part(&mut self, part: &'r RawEntry, format: &NetlistFormat, problems: &mut Vec<Diagnostic>) {
        let words = format!("`{}` of template `{}`", part.key, self.name());
        if part.key == PORT {
            return self.ports(part, problems);
        }
        if format.is_outside_templates(&part.key) || !format.has(&part.key) {
            return problems.push(unknown_part(self.name(), part, format));
        }
        let RawKind::Table(table) = &part.value.kind else {
            return problems.push(no_table(&words, &part.value, &part.value.kind));
        };
        match part.key.as_str() {
            name if name == ValueKind::Parameter.section() => {
                for entry in &table.entries {
                    let parameter = self.read_parameter(entry, problems);
                    self.parameters.extend(parameter);
                }
            }
            name if name == USE.name => self.uses = &table.entries,
            _ => self.sections.push((part, table)),
        }
    }

    fn ports(&mut self, part: &'r RawEntry, problems: &mut Vec<Diagnostic>) {
        let words = format!("`port` of template `{}`", self.name());
        let example = "port = [\"in\", \"out\"]";
        let RawKind::Array(list) = &part.value.kind else {
            return problems.push(wrong_shape(&words, &part.value, "a list of names", example));
        };
        for value in list {
            match &value.kind {
                RawKind::String { text, .. } => self.ports.push((text, value)),
                _ => problems.push(wrong_shape(&words, value, "a list of names", example)),
            }
        }
    }

    /// `m = "0.2 kg"` has a value; `R = { unit = "K/W" }` has to be set.
    fn read_parameter(
        &self,
        entry: &'r RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Parameter<'r>> {
        let owner = Owner::element("parameter", format!("{}.{}", self.name(), entry.key));
        let text = match &entry.value.kind {
            RawKind::Table(_) => {
                let fields = Fields::of(&OPEN_PARAMETER, owner, entry, problems)?;
                let raw = fields.require("unit", problems)?;
                let text = fields.text("unit", raw, problems)?;
                return match Unit::parse(text) {
                    Ok(unit) => {
                        let ty = Some(unit.ty);
                        Some(Parameter { entry, default: false, ty, deviation: None })
                    }
                    Err(error) => {
                        problems.push(
                            Place { owner: &fields.owner, key: "unit", raw }.unit_error(&error),
                        );
                        None
                    }
                };
            }
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => {
                let example = "m = \"0.2 kg\"";
                problems.push(wrong_shape(&owner.words(), &entry.value, "a value", example));
                return None;
            }
        };
        let known = parse_quantity(text, None).ok();
        let deviation = known.as_ref().and_then(|quantity| quantity.deviation);
        Some(Parameter { entry, default: true, ty: known.map(|quantity| quantity.ty), deviation })
    }

    /// Errors of the names inside.
    fn names(&self) -> Vec<Diagnostic> {
        let parameters = self.parameters.iter().map(|parameter| ("parameter", parameter.entry));
        let uses = self.uses.iter().map(|entry| (USE.name, entry));
        let all: Vec<(&str, &RawEntry)> = parameters.chain(self.elements()).chain(uses).collect();
        let mut problems: Vec<Diagnostic> = all
            .iter()
            .filter_map(|(kind, entry)| self.unusable((kind, &entry.key), &entry.key_span))
            .collect();
        for (position, (name, value)) in self.ports.iter().enumerate() {
            problems.extend(self.unusable(("port", name), &value.span));
            let earlier = self.ports.iter().take(position).find(|(other, _)| other == name);
            let first = earlier.map(|(_, value)| ("port", &value.span));
            let taken = all.iter().find(|(_, entry)| entry.key == *name);
            if let Some(first) = first.or(taken.map(|(kind, entry)| (*kind, &entry.key_span))) {
                problems.push(taken_twice((name, &value.span), "port", first));
            }
        }
        for entry in self.uses {
            if let Some((kind, other)) = self.elements().find(|(_, other)| other.key == entry.key) {
                problems.push(taken_twice(
                    (&entry.key, &entry.key_span),
                    USE.name,
                    (kind, &other.key_span),
                ));
            }
        }
        problems
    }

    /// The elements, each with its section.
    pub(super) fn elements(&self) -> impl Iterator<Item = (&'r str, &'r RawEntry)> {
        let sections = self.sections.iter();
        sections.flat_map(|(section, table)| {
            table.entries.iter().map(|entry| (section.key.as_str(), entry))
        })
    }

    fn unusable(&self, (kind, name): (&str, &str), span: &lptn_data::Span) -> Option<Diagnostic> {
        let words = format!("{kind} `{name}` of template `{}`", self.name());
        if !is_name(name) {
            let message = format!("{words} has an invalid name");
            let help = "use letters, digits and `_`, and no digit first";
            return Some(Diagnostic::wrong("network::bad_name", message, span, help));
        }
        let reserved = RESERVED.contains(&name);
        let message = format!("{words} has a name that is reserved in expressions");
        reserved.then(|| {
            let help = format!("choose another one, for example `{name}_1`");
            Diagnostic::wrong("network::reserved_name", message, span, help)
        })
    }
}

/// One name for two things.
pub(super) fn taken_twice(
    (name, span): (&str, &lptn_data::Span),
    kind: &str,
    (other, first): (&str, &lptn_data::Span),
) -> Diagnostic {
    let message = match kind == other {
        true => format!("two {kind}s are named `{name}`"),
        false => format!("the name `{name}` is taken twice: by a {other} and by a {kind}"),
    };
    Diagnostic::error("network::duplicate_name", message)
        .at(span.clone(), "named again")
        .also(first.clone(), "first named here")
        .help(format!("rename one of them, for example `{name}_2`"))
}

fn no_table(words: &str, value: &RawValue, kind: &RawKind) -> Diagnostic {
    let message = format!("{words} must be a table, got {}", kind.with_article());
    Diagnostic::wrong(
        "netlist::not_a_table",
        message,
        &value.span,
        format!("write it like this: `[template.planet]`, then {}", TEMPLATE.example),
    )
}

fn unknown_part(template: &str, part: &RawEntry, format: &NetlistFormat) -> Diagnostic {
    let key = part.key.as_str();
    if format.is_outside_templates(key) {
        let message = format!("`[{key}]` cannot be in template `{template}`");
        return Diagnostic::wrong(
            "netlist::not_in_template",
            message,
            &part.key_span,
            format!(
                "a template contains `param`, `port` and elements: move `[{key}]` to the top of \
                 the file"
            ),
        );
    }
    let inside = format.names().into_iter().filter(|section| !format.is_outside_templates(section));
    let inside: Vec<&str> = [PORT].into_iter().chain(inside).collect();
    let problem = Diagnostic::error(
        "netlist::unknown_section",
        format!("template `{template}` cannot contain `{key}`"),
    )
    .at(part.key_span.clone(), "");
    problem.help(nearest(key, inside.iter().copied(), "a template contains"))
}
