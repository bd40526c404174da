//! `format = 1`, with which every file begins.

use lptn_data::{Diagnostic, Span};

use crate::fields::wrong_shape;
use crate::format::MINIMAL;
use crate::raw::{RawEntry, RawKind};

pub(crate) const MISSING_FORMAT: &str = "netlist::missing_format";

/// The error about the `format` of an included file, which begins at `start`.
pub(crate) fn check_head(entries: &[RawEntry], start: Span) -> Option<Diagnostic> {
    match entries.iter().find(|entry| entry.key == "format") {
        Some(entry) => check_format(entry),
        None if entries.is_empty() => Some(missing_format(entries, None).at(start, "belongs here")),
        None => Some(missing_format(entries, misplaced_format(entries))),
    }
}

pub(crate) fn check_format(entry: &RawEntry) -> Option<Diagnostic> {
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
pub(crate) fn misplaced_format(entries: &[RawEntry]) -> Option<(&str, &RawEntry)> {
    entries.iter().find_map(|entry| match &entry.value.kind {
        RawKind::Table(table) => table.get("format").map(|format| (entry.key.as_str(), format)),
        _ => None,
    })
}

pub(crate) fn missing_format(
    entries: &[RawEntry],
    inside: Option<(&str, &RawEntry)>,
) -> Diagnostic {
    let error = Diagnostic::error(MISSING_FORMAT, "`format = 1` is missing")
        .help("make `format = 1` the first line, above the first [section]");
    match (inside, entries.first()) {
        (Some((section, format)), _) => error
            .at(format.key_span.clone(), format!("below `[{section}]` it belongs to that section")),
        (None, Some(first)) => {
            let start = Span::new(first.key_span.file, 0..0);
            error.at(start, "belongs here")
        }
        (None, None) => error,
    }
}

/// Error for an empty text.
pub(crate) fn empty(text: &str, at: Span) -> Diagnostic {
    let what = if text.trim().is_empty() { "is empty" } else { "contains nothing but comments" };
    Diagnostic::error("netlist::empty", format!("the netlist {what}"))
        .at(at, "")
        .help(MINIMAL.trim_end())
}
