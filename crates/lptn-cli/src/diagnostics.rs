//! Diagnostics the way rustc shows its own, and as JSON.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use lptn_netlist::{Diagnostic, FileId, Files, Label, Severity, Span};
use lptn_report::{Json, JsonWriter};
use serde_json::{Value, json};

use crate::exit::Exit;

/// A diagnostic with its lines, help and notes; without a line break at the end.
pub(crate) fn render(files: &Files, diagnostic: &Diagnostic, styled: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group =
        Group::with_title(level.primary_title(diagnostic.message.as_str()).id(diagnostic.code));
    for file in files_of(diagnostic) {
        let labels: Vec<&Label> =
            diagnostic.labels.iter().filter(|label| label.span.file == file).collect();
        if files.text(file).len() < LONG {
            group = group.element(snippet(files, (0, files.text(file)), &labels));
        } else {
            // the renderer looks at every line it is given
            group = group
                .elements(labels.iter().map(|label| snippet(files, line(files, label), &[*label])));
        }
    }
    group = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(help.as_str())));
    group = group.elements(diagnostic.notes.iter().map(|note| Level::NOTE.message(note.as_str())));
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

/// The files that labels are in, that of the primary label first.
fn files_of(diagnostic: &Diagnostic) -> Vec<FileId> {
    let mut labels: Vec<&Label> = diagnostic.labels.iter().collect();
    labels.sort_by_key(|label| !label.primary);
    let mut found = Vec::new();
    for label in labels {
        if !found.contains(&label.span.file) {
            found.push(label.span.file);
        }
    }
    found
}

/// Of texts longer than this, in bytes, only the lines with labels are shown.
const LONG: usize = 200_000;

/// The line in which a label begins, and its first byte.
fn line<'a>(files: &'a Files, label: &Label) -> (usize, &'a str) {
    let text = files.text(label.span.file);
    let range = inside(&label.span.range, text);
    let start = text[..range.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[range.end..].find('\n').map_or(text.len(), |at| range.end + at);
    (start, &text[start..end])
}

/// The labels in a part of their text, which begins at this byte.
fn snippet<'a>(
    files: &'a Files,
    (start, text): (usize, &'a str),
    labels: &[&'a Label],
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let annotations = labels.iter().map(|label| {
        let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let range = label.span.range.start.saturating_sub(start)
            ..label.span.range.end.saturating_sub(start);
        kind.span(inside(&range, text)).label(Some(label.text.as_str()).filter(|t| !t.is_empty()))
    });
    let annotations: Vec<_> = annotations.collect();
    let snippet = Snippet::source(text).annotations(annotations);
    let Some(first) = labels.first() else { return snippet };
    let number = if start == 0 { 1 } else { files.line_column(&first.span).0 };
    snippet.line_start(number).path(files.name(first.span.file))
}

/// The range cut to the text, so that a wrong span is shown somewhere and never ends the program.
fn inside(range: &Range<usize>, text: &str) -> Range<usize> {
    let border = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    border(range.start)..border(range.end.max(range.start))
}

/// The same for programs: lines and columns count from 1, columns in characters; the end is behind
/// the last character. `fix` is what to write, and in place of what, where the help proposes that.
pub(crate) fn json(files: &Files, diagnostic: &Diagnostic) -> Value {
    let places: Vec<Value> = diagnostic.labels.iter().map(|label| place(files, label)).collect();
    json!({
        "severity": match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        },
        "code": diagnostic.code,
        "message": diagnostic.message,
        "places": places,
        "help": diagnostic.help,
        "fix": fix(files, diagnostic),
        "notes": diagnostic.notes,
    })
}

/// The text that a help proposes by `did you mean ..?`, and the place whose text it replaces: the
/// whole string or heading where the text comes with its quotes or brackets.
fn fix(files: &Files, diagnostic: &Diagnostic) -> Option<Value> {
    let meant = diagnostic.help.as_deref()?.strip_prefix("did you mean ")?.strip_suffix('?')?;
    let meant = within(meant, "`", "`").unwrap_or(meant);
    if meant.contains('`') {
        return None;
    }
    let Some(span) = diagnostic.place() else { return Some(json!({ "text": meant })) };
    let (text, Range { start, end }) = (files.text(span.file), span.range.clone());
    let (before, after) = (text.get(..start)?, text.get(end..)?);
    let is_string = |text: &str| within(text, "\"", "\"").is_some();
    // of `key = "word"` the word is proposed
    let value = meant.split_once(" = ").map(|(_, value)| value);
    let value = value.filter(|value| is_string(value) && is_string(files.at(span)));
    let meant = value.unwrap_or(meant);
    let mut text = meant.to_owned();
    let mut range = start..end;
    if is_string(files.at(span)) && !is_string(meant) {
        text = format!("\"{meant}\"");
    } else if is_string(meant) && !is_string(files.at(span)) {
        // a quantity is proposed as a whole, and the place is its unit
        range = before.rfind(['"', '\n']).filter(|at| before[*at..].starts_with('"'))?
            ..end + after.find(['"', '\n']).filter(|at| after[*at..].starts_with('"'))? + 1;
    } else if within(meant, "[", "]").is_some() && before.ends_with('[') && after.starts_with(']') {
        range = start - 1..end + 1;
    }
    let span = Span { range, ..span.clone() };
    let label = Label { span, text: String::new(), primary: true };
    Some(json!({ "text": text, "place": place(files, &label) }))
}

/// What stands between two marks.
fn within<'a>(text: &'a str, open: &str, close: &str) -> Option<&'a str> {
    text.strip_prefix(open)?.strip_suffix(close)
}

fn place(files: &Files, label: &Label) -> Value {
    let (line, column) = files.line_column(&label.span);
    let end = label.span.range.end;
    let (end_line, end_column) = files.line_column(&Span::new(label.span.file, end..end));
    json!({
        "file": files.name(label.span.file),
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
        "text": files.at(&label.span),
        "label": label.text,
        "primary": label.primary,
    })
}

/// How the object of a result begins: the version of its format, the network that it is about, and
/// its warnings.
pub(crate) fn head(
    json: &mut Json<'_>,
    network: Option<&str>,
    (files, warnings): (&Files, &[Diagnostic]),
) -> std::io::Result<()> {
    json.member("format", &1)?;
    json.member("network", &network)?;
    json.member("warnings", &list(files, warnings))
}

/// That a command failed, and why, in its object.
pub(crate) fn failed<W: std::io::Write>(
    json: &mut JsonWriter<W>,
    exit: Exit,
    errors: &Value,
) -> std::io::Result<()> {
    json.member("ok", &false)?;
    json.member("exit", &(exit as u8))?;
    json.member("errors", errors)
}

/// A list of diagnostics as JSON.
pub(crate) fn list(files: &Files, diagnostics: &[Diagnostic]) -> Value {
    diagnostics.iter().map(|diagnostic| json(files, diagnostic)).collect()
}
