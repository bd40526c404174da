//! What is said about a netlist: one type for errors and warnings, of every stage.

use std::fmt;

use crate::file::{Files, Span};

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The netlist cannot be used.
    Error,
    /// The netlist can be used, but is probably not what was meant.
    Warning,
}

/// A place with a few words about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The words; may be empty.
    pub text: String,
    /// Whether the problem is here; other places only explain it.
    pub primary: bool,
}

/// One problem: what, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// A stable `area::problem`.
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, as a sentence without capital and full stop.
    pub message: String,
    /// Where; the primary place first. Empty if there is no place.
    pub labels: Vec<Label>,
    /// What to do, with a text that can be pasted where possible.
    pub help: Option<String>,
    /// What else is worth knowing.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// An error without a place.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, severity: Severity::Error, message, labels: Vec::new(), help: None, notes: Vec::new() }
    }

    /// A warning without a place.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// Adds the place of the problem.
    #[must_use]
    pub fn at(self, span: Span, text: impl Into<String>) -> Self {
        self.label(span, text.into(), true)
    }

    /// Adds a place that explains the problem.
    #[must_use]
    pub fn also(self, span: Span, text: impl Into<String>) -> Self {
        self.label(span, text.into(), false)
    }

    /// Sets what to do about it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds what else is worth knowing.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// The place of the problem, if it has one.
    pub fn place(&self) -> Option<&Span> {
        self.labels.iter().find(|label| label.primary).map(|label| &label.span)
    }

    fn label(mut self, span: Span, text: String, primary: bool) -> Self {
        self.labels.push(Label { span, text, primary });
        self
    }
}

impl fmt::Display for Diagnostic {
    /// `error[code]: message`; [`Files::plain`] adds the places.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        write!(f, "{severity}[{}]: {}", self.code, self.message)
    }
}

impl Files {
    /// A diagnostic with its places, help and notes as plain text, without a newline at the end.
    pub fn plain(&self, diagnostic: &Diagnostic) -> String {
        let mut text = diagnostic.to_string();
        for label in &diagnostic.labels {
            let (line, column) = self.line_column(&label.span);
            let arrow = if label.primary { "-->" } else { ":::" };
            text += &format!("\n {arrow} {}:{line}:{column}", self.name(label.span.file));
            if !label.text.is_empty() {
                text += &format!(": {}", label.text);
            }
        }
        let indented = |words: &str| words.replace('\n', "\n      ").replace("      \n", "\n");
        if let Some(help) = &diagnostic.help {
            text += &format!("\n  = help: {}", indented(help));
        }
        for note in &diagnostic.notes {
            text += &format!("\n  = note: {}", indented(note));
        }
        text
    }
}

/// Sorts by place, and drops what says the same of the same place.
pub(crate) fn arrange(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by_key(|d| d.place().map(Span::order));
    diagnostics.dedup_by(|b, a| a.code == b.code && a.place().is_some() && a.place() == b.place());
}
