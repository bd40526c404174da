//! The top level: `format`, the title, and which sections there are.

use lptn_data::{Diagnostic, Span, list};
use lptn_units::suggest;

use crate::fields::wrong_shape;
use crate::raw::{RawEntry, RawKind};
use crate::vocabulary::{MINIMAL, SECTIONS, SECTIONS_LATER, TOP_KEYS};
use crate::work::{Elaboration, MISSING_FORMAT};

impl Elaboration<'_> {
    pub(crate) fn top_level(&mut self) {
        let entries = &self.raw.top.entries;
        match entries.iter().find(|entry| entry.key == "format") {
            Some(entry) => self.problems.extend(check_format(entry)),
            None => {
                let inside = misplaced_format(entries);
                self.doubts.format = inside.map(|(_, entry)| whole(entry));
                self.problems.push(missing_format(entries, inside));
            }
        }
        for entry in entries.iter().filter(|entry| entry.key != "format") {
            if SECTIONS.contains(&entry.key.as_str()) {
                let problem = check_section(entry);
                self.doubts.sections |= problem.is_some();
                if problem.is_some() {
                    self.names.hide(entry);
                }
                self.problems.extend(problem);
            } else if entry.key == "include" {
                // what it names is in already, or the text is broken elsewhere
            } else if TOP_KEYS.contains(&entry.key.as_str()) {
                self.words(entry);
            } else {
                self.doubts.sections = true;
                self.names.hide(entry);
                self.problems.push(unknown(entry));
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
                self.report(wrong_shape(&format!("`{}`", entry.key), &entry.value, "a string", &sample));
            }
        }
    }
}

/// What is wrong with the `format` of an included file, which begins at `start`.
pub(crate) fn check_head(entries: &[RawEntry], start: Span) -> Option<Diagnostic> {
    match entries.iter().find(|entry| entry.key == "format") {
        Some(entry) => check_format(entry),
        None if entries.is_empty() => Some(missing_format(entries, None).at(start, "belongs here")),
        None => Some(missing_format(entries, misplaced_format(entries))),
    }
}

fn check_format(entry: &RawEntry) -> Option<Diagnostic> {
    let given = match &entry.value.kind {
        RawKind::Integer(number) if number == "1" => return None,
        RawKind::Integer(number) => number.clone(),
        _ => return Some(wrong_shape("`format`", &entry.value, "the number 1", "format = 1")),
    };
    let message = format!("format {given} is not known to this version of lptn");
    Some(
        Diagnostic::error("netlist::unsupported_format", message)
            .at(entry.value.span.clone(), "this version reads format 1")
            .help("write `format = 1`, or use a newer lptn"),
    )
}

/// `format` below a heading, with the section that it then belongs to.
fn misplaced_format(entries: &[RawEntry]) -> Option<(&str, &RawEntry)> {
    entries.iter().find_map(|entry| match &entry.value.kind {
        RawKind::Table(table) => table.get("format").map(|format| (entry.key.as_str(), format)),
        _ => None,
    })
}

fn whole(entry: &RawEntry) -> Span {
    entry.key_span.with(entry.key_span.range.start..entry.value.span.range.end)
}

fn missing_format(entries: &[RawEntry], inside: Option<(&str, &RawEntry)>) -> Diagnostic {
    let error = Diagnostic::error(MISSING_FORMAT, "`format = 1` is missing")
        .help("make `format = 1` the first line, above the first [section]");
    match (inside, entries.first()) {
        (Some((section, format)), _) => {
            error.at(format.key_span.clone(), format!("below `[{section}]` it belongs to that section"))
        }
        (None, Some(first)) => {
            let start = Span::new(first.key_span.file, 0..0);
            error.at(start, "belongs here")
        }
        (None, None) => error,
    }
}

fn check_section(entry: &RawEntry) -> Option<Diagnostic> {
    let name = &entry.key;
    let error =
        |message: String| Diagnostic::error("netlist::not_a_table", message).at(entry.key_span.clone(), "");
    match &entry.value.kind {
        RawKind::Table(_) => None,
        RawKind::Array(_) => Some(
            error(format!("`[[{name}]]` is a list, but `{name}` is a section"))
                .help(format!("write `[{name}]` once; each entry below it has a name of its own")),
        ),
        other => Some(
            error(format!("`{name}` is a section, got {}", other.with_article()))
                .help(format!("open the section with the heading `[{name}]`")),
        ),
    }
}

/// What sections are called elsewhere.
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

fn unknown(entry: &RawEntry) -> Diagnostic {
    let (name, place) = (entry.key.as_str(), entry.key_span.clone());
    let is_table = matches!(entry.value.kind, RawKind::Table(_) | RawKind::Array(_));
    if SECTIONS_LATER.contains(&name) {
        return Diagnostic::error("netlist::not_supported_yet", format!("`[{name}]` is not supported yet"))
            .at(place, "")
            .help(format!("the sections so far are {}", list(&SECTIONS)));
    }
    let (code, message) = if is_table {
        ("netlist::unknown_section", format!("there is no section `[{name}]`"))
    } else {
        ("netlist::unknown_key", format!("there is no key `{name}` at the top of a netlist"))
    };
    let other = OTHER_NAMES.iter().find(|(other, _)| name.eq_ignore_ascii_case(other)).filter(|_| is_table);
    let known = SECTIONS.iter().chain(&SECTIONS_LATER).chain(&TOP_KEYS).copied();
    let near = other.map(|(_, section)| *section).or_else(|| suggest(name, known));
    let help = match near {
        Some(near) if TOP_KEYS.contains(&near) => format!("did you mean `{near}`?"),
        Some(near) => format!("did you mean `[{near}]`?"),
        None if is_table => format!("the sections are {}", list(&SECTIONS)),
        None => format!("a parameter belongs below the heading `[param]`; here stand {}", list(&TOP_KEYS)),
    };
    Diagnostic::error(code, message).at(place, "").help(help)
}

/// A text without anything in it.
pub(crate) fn empty(text: &str, at: Span) -> Diagnostic {
    let what = if text.trim().is_empty() { "is empty" } else { "holds nothing but comments" };
    Diagnostic::error("netlist::empty", format!("the netlist {what}")).at(at, "").help(MINIMAL.trim_end())
}
