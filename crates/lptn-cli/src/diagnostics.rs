//! Diagnostics the way rustc shows its own, and as JSON.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use lptn_netlist::{Diagnostic, FileId, Files, Label, Severity};
use serde_json::{Value, json};

/// A diagnostic with its lines, help and notes; without a line break at the end.
pub(crate) fn render(files: &Files, diagnostic: &Diagnostic, styled: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(diagnostic.message.as_str()).id(diagnostic.code));
    for file in files_of(diagnostic) {
        group = group.element(snippet(files, diagnostic, file));
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

fn snippet<'a>(
    files: &'a Files,
    diagnostic: &'a Diagnostic,
    file: FileId,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let text = files.text(file);
    let labels = diagnostic.labels.iter().filter(|label| label.span.file == file);
    let annotations = labels.map(|label| {
        let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        kind.span(inside(&label.span.range, text)).label(Some(label.text.as_str()).filter(|t| !t.is_empty()))
    });
    Snippet::source(text).path(files.name(file)).annotations(annotations)
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

/// The same for programs: lines and columns count from 1, columns in characters.
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
        "notes": diagnostic.notes,
    })
}

fn place(files: &Files, label: &Label) -> Value {
    let (line, column) = files.line_column(&label.span);
    json!({
        "file": files.name(label.span.file),
        "line": line,
        "column": column,
        "text": files.at(&label.span),
        "label": label.text,
        "primary": label.primary,
    })
}

/// A list of diagnostics as JSON.
pub(crate) fn list(files: &Files, diagnostics: &[Diagnostic]) -> Value {
    diagnostics.iter().map(|diagnostic| json(files, diagnostic)).collect()
}
