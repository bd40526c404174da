//! Diagnostics the way rustc shows its own.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use lptn_netlist::{Diagnostic, FileId, Files, Label, Severity};

/// A diagnostic with its lines, help and notes; without a line break at the end.
pub(crate) fn render(files: &Files, diagnostic: &Diagnostic, styled: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let mut group =
        Group::with_title(level.primary_title(diagnostic.message.as_str()).id(diagnostic.code));
    for file in files_of(diagnostic) {
        let labels: Vec<&Label> =
            diagnostic.labels.iter().filter(|label| label.span.file == file).collect();
        if files.text(file).len() < LONG {
            group = group.element(snippet(files, (0, files.text(file)), &labels));
        } else {
            // the renderer processes every line it is given
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

/// Texts longer than this, in bytes, are shown only by the lines with labels.
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
