//! Diagnostics as JSON.

use std::ops::Range;

use lptn_netlist::{Diagnostic, Files, Label, Severity, Span};
use lptn_report::{Json, JsonWriter};
use serde_json::{Value, json};

use crate::exit::Exit;

/// A diagnostic as an object.
/// Lines and columns count from 1, columns in characters; the end is after the last character.
/// `fix` is the text to write and the text that it replaces, if the help has one.
pub fn json(files: &Files, diagnostic: &Diagnostic) -> Value {
    let places: Vec<Value> = diagnostic.labels.iter().map(|label| place(files, label)).collect();
    json!({
        "severity": match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        },
        "code": diagnostic.code,
        "message": diagnostic.message,
        "places": places,
        "help": diagnostic.help,
        "fix": fix(files, diagnostic),
        "notes": diagnostic.notes,
    })
}

/// The text that a help proposes by `did you mean …?`, and the place whose text it replaces.
/// If the text has its quotes or brackets, that is the whole string or heading.
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
    // the word is proposed for `key = "word"`
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

/// The text between two marks.
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

/// Begins the object of a result: the version of its format, its network, and its warnings.
pub fn head(
    json: &mut Json<'_>,
    network: Option<&str>,
    (files, warnings): (&Files, &[Diagnostic]),
) -> std::io::Result<()> {
    json.member("format", &1)?;
    json.member("network", &network)?;
    json.member("warnings", &list(files, warnings))
}

/// Writes the failure of a command and its reasons into its object.
pub fn failed<W: std::io::Write>(
    json: &mut JsonWriter<W>,
    exit: Exit,
    errors: &Value,
) -> std::io::Result<()> {
    json.member("ok", &false)?;
    json.member("exit", &(exit as u8))?;
    json.member("errors", errors)
}

/// A list of diagnostics as JSON.
pub fn list(files: &Files, diagnostics: &[Diagnostic]) -> Value {
    diagnostics.iter().map(|diagnostic| json(files, diagnostic)).collect()
}
