//! The top level: `format`, the title, and the sections.

use lptn_data::{Diagnostic, Span, list};
use lptn_units::suggest;

use crate::fields::wrong_shape;
use crate::format::{NetlistFormat, TOP_KEYS};
use crate::head::{check_format, misplaced_format, missing_format};
use crate::raw::{RawEntry, RawKind};
use crate::work::Elaboration;

impl Elaboration<'_> {
    pub(crate) fn top_level(&mut self) {
        let entries = &self.raw.top.entries;
        match entries.iter().find(|entry| entry.key == "format") {
            Some(entry) => self.problems.extend(check_format(entry)),
            None => {
                let inside = misplaced_format(entries);
                self.left_out.format = inside.map(|(_, entry)| whole(entry));
                self.problems.push(missing_format(entries, inside));
            }
        }
        for entry in entries.iter().filter(|entry| entry.key != "format") {
            if self.format.has(&entry.key) {
                let problem = check_section(entry);
                self.left_out.sections |= problem.is_some();
                if problem.is_some() {
                    self.names.hide(entry);
                }
                self.problems.extend(problem);
            } else if entry.key == "include" {
                // its files are included already, or the text is broken elsewhere
            } else if TOP_KEYS.contains(&entry.key.as_str()) {
                self.words(entry);
            } else {
                self.left_out.sections = true;
                self.names.hide(entry);
                self.problems.push(unknown(entry, self.format));
            }
        }
    }

    /// `title` or `description`.
    fn words(&mut self, entry: &RawEntry) {
        match &entry.value.kind {
            RawKind::String { text, .. } if entry.key == "title" => self.builder.title(text),
            RawKind::String { .. } => {}
            _ => {
                let sample = format!("{} = \"..\"", entry.key);
                self.report(wrong_shape(
                    &format!("`{}`", entry.key),
                    &entry.value,
                    "a string",
                    &sample,
                ));
            }
        }
    }
}

fn whole(entry: &RawEntry) -> Span {
    entry.key_span.with(entry.key_span.range.start..entry.value.span.range.end)
}

fn check_section(entry: &RawEntry) -> Option<Diagnostic> {
    let name = &entry.key;
    let error = |message: String| {
        Diagnostic::error("netlist::not_a_table", message).at(entry.key_span.clone(), "")
    };
    match &entry.value.kind {
        RawKind::Table(_) => None,
        RawKind::Array(_) => Some(
            error(format!("`[[{name}]]` is a list, but `{name}` is a section"))
                .help(format!("write `[{name}]` once; each entry below it has its own name")),
        ),
        other => Some(
            error(format!("`{name}` is a section, got {}", other.with_article()))
                .help(format!("open the section with the heading `[{name}]`")),
        ),
    }
}

/// Other names of sections.
const OTHER_NAMES: [(&str, &str); 16] = [
    ("resistance", "resistor"),
    ("resistances", "resistor"),
    ("conductor", "resistor"),
    ("conductance", "resistor"),
    ("link", "resistor"),
    ("capacity", "node"),
    ("capacitance", "node"),
    ("mass", "node"),
    ("ambient", "boundary"),
    ("environment", "boundary"),
    ("heat", "source"),
    ("load", "source"),
    ("loss", "source"),
    ("variables", "param"),
    ("simulation", "run"),
    ("solver", "run"),
];

fn unknown(entry: &RawEntry, format: &NetlistFormat) -> Diagnostic {
    let (name, place) = (entry.key.as_str(), entry.key_span.clone());
    let is_table = matches!(entry.value.kind, RawKind::Table(_) | RawKind::Array(_));
    if format.later.iter().any(|section| section.name == name) {
        return Diagnostic::error(
            "netlist::not_supported_yet",
            format!("`[{name}]` is not supported yet"),
        )
        .at(place, "")
        .help(format!("the sections are {}", list(&format.names())));
    }
    let (code, message) = if is_table {
        ("netlist::unknown_section", format!("there is no section `[{name}]`"))
    } else {
        ("netlist::unknown_key", format!("there is no key `{name}` at the top of a netlist"))
    };
    let other =
        OTHER_NAMES.iter().find(|(other, _)| name.eq_ignore_ascii_case(other)).filter(|_| is_table);
    let later = format.later.iter().map(|section| section.name);
    let known = format.names().into_iter().chain(later).chain(TOP_KEYS);
    let near = other.map(|(_, section)| *section).or_else(|| suggest(name, known));
    let help = match near {
        Some(near) if TOP_KEYS.contains(&near) => format!("did you mean `{near}`?"),
        Some(near) => format!("did you mean `[{near}]`?"),
        None if is_table => format!("the sections are {}", list(&format.names())),
        None => {
            format!("a parameter belongs below the heading `[param]`; here are {}", list(&TOP_KEYS))
        }
    };
    Diagnostic::error(code, message).at(place, "").help(help)
}
