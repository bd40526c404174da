//! The same key or heading twice: TOML forbids it, and the parser does not report the first one.

use lptn_data::{Diagnostic, Span};

use crate::raw::{RawKind, RawTable};

pub(crate) const CODE: &str = "netlist::duplicate_key";

/// Explains a second key or heading at `second`.
pub(crate) fn explain(text: &str, second: &Span, top: &RawTable) -> Diagnostic {
    let name = text.get(second.range.clone()).unwrap_or("");
    let headings = headings(text, second);
    match headings.iter().find(|heading| heading.contains(&second.range.start)) {
        Some(this) => heading(text, second, this, &headings),
        None => key(name, second, first_key(name, second, top)),
    }
}

fn key(name: &str, second: &Span, first: Option<Span>) -> Diagnostic {
    let error = Diagnostic::error(CODE, format!("`{name}` is given twice"))
        .at(second.clone(), "given again");
    let error = error.also(first, "first given here");
    error.help("remove one of the two, or give one another name")
}

fn heading(text: &str, second: &Span, this: &Range, headings: &[Range]) -> Diagnostic {
    let path = |range: &Range| normal(text.get(range.clone()).unwrap_or(""));
    let name = path(this);
    let first = headings.iter().find(|h| h.start < this.start && path(h) == name);
    let message = format!("`[{name}]` is opened twice");
    let error = Diagnostic::error(CODE, message).at(second.clone(), "opened again");
    let error = match first {
        Some(first) => error.also(Span::new(second.file, first.clone()), "first opened here"),
        None => error,
    };
    if name.contains('.') {
        error.help("give one of the two another name")
    } else {
        error.help(format!("put the entries of both below one `[{name}]`"))
    }
}

type Range = std::ops::Range<usize>;

/// `node . steel` and `node."steel"` are the same heading.
fn normal(path: &str) -> String {
    let path = path.trim_matches(['[', ']', ' ', '\t']);
    let parts: Vec<&str> =
        path.split('.').map(|part| part.trim().trim_matches(['"', '\''])).collect();
    parts.join(".")
}

/// The headings up to the end of the line of `last`: lines that begin with a bracket.
fn headings(text: &str, last: &Span) -> Vec<Range> {
    let mut at = 0;
    let mut found = Vec::new();
    for line in text.split_inclusive('\n') {
        let indent = line.len() - line.trim_start().len();
        if line.trim_start().starts_with('[') {
            let end = line.find(']').map_or(line.trim_end().len(), |end| end + 1);
            found.push(at + indent..at + end.max(indent));
        }
        at += line.len();
        if at > last.range.start {
            break;
        }
    }
    found
}

/// The key of this name in the innermost table around `second`, if it is before it.
fn first_key(name: &str, second: &Span, table: &RawTable) -> Option<Span> {
    let at = second.range.start;
    let inner = table.entries.iter().filter_map(|entry| match &entry.value.kind {
        RawKind::Table(table) => Some((entry, table)),
        _ => None,
    });
    // an inline table encloses its entries; those of a heading follow it, up to the next heading
    let around = inner.filter(|(entry, _)| entry.key_span.range.start < at).filter(|(_, table)| {
        let ends = table.entries.iter().map(|e| e.key_span.range.start).any(|start| start < at);
        ends && (table.span.range.contains(&at) || is_heading(table))
    });
    let deepest = around
        .filter_map(|(_, table)| first_key(name, second, table))
        .max_by_key(|s| s.range.start);
    let name = name.trim_matches(['"', '\'']);
    let own = || table.get(name).map(|entry| entry.key_span.clone()).filter(|s| s.range.start < at);
    deepest.or_else(own)
}

/// True if a heading opened the table: its entries follow it instead of being inside.
fn is_heading(table: &RawTable) -> bool {
    table.entries.first().is_some_and(|entry| entry.key_span.range.start >= table.span.range.end)
}
