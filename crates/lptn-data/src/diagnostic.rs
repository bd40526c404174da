//! Diagnostics of a netlist: one type for errors and warnings of every stage.

use std::fmt;

use lptn_units::{Help, suggest};

use crate::file::{Files, Span};

/// The severity of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The netlist cannot be used.
    Error,
    /// The netlist can be used, but is probably not what was meant.
    Warning,
    /// Nothing is wrong: a statement about how something was read.
    Note,
}

/// A place with a few words about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The words; may be empty.
    pub text: String,
    /// True if the problem is here; other places only explain it.
    pub primary: bool,
}

/// One problem with its place and remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// A stable `area::problem`.
    pub code: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The problem as a sentence without capital and full stop.
    pub message: String,
    /// The places, the primary one first. Empty if there is no place.
    pub labels: Vec<Label>,
    /// The remedy, with a text that can be pasted if possible.
    pub help: Option<String>,
    /// Additional information.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// An error without a place.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self {
            code,
            severity: Severity::Error,
            message,
            labels: Vec::new(),
            help: None,
            notes: Vec::new(),
        }
    }

    /// A warning without a place.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// An error at its place, with its remedy.
    pub fn wrong(
        code: &'static str,
        message: impl Into<String>,
        at: &Span,
        help: impl Help,
    ) -> Self {
        Self::error(code, message).at(at.clone(), "").help(help)
    }

    /// A warning at its place, with its remedy.
    pub fn doubt(
        code: &'static str,
        message: impl Into<String>,
        at: &Span,
        help: impl Help,
    ) -> Self {
        Self { severity: Severity::Warning, ..Self::wrong(code, message, at, help) }
    }

    /// Adds the place of the problem, if there is one.
    #[must_use]
    pub fn at(self, span: impl Into<Option<Span>>, text: impl Into<String>) -> Self {
        self.label(span.into(), text.into(), true)
    }

    /// Adds a place that explains the problem, if there is one.
    #[must_use]
    pub fn also(self, span: impl Into<Option<Span>>, text: impl Into<String>) -> Self {
        self.label(span.into(), text.into(), false)
    }

    /// Adds several places; the first is that of the problem.
    #[must_use]
    pub fn places(self, places: impl IntoIterator<Item = (Span, String)>) -> Self {
        let places = places.into_iter().enumerate();
        places.fold(self, |problem, (n, (span, text))| problem.label(Some(span), text, n == 0))
    }

    /// Sets the remedy, if one is known.
    #[must_use]
    pub fn help(mut self, help: impl Help) -> Self {
        self.help = help.words().or(self.help);
        self
    }

    /// Adds a note.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Suggests the nearest of the names to `wrong`, else `otherwise`.
    #[must_use]
    pub fn did_you_mean<'n>(
        self,
        wrong: &str,
        names: impl IntoIterator<Item = &'n str>,
        otherwise: impl FnOnce() -> String,
    ) -> Self {
        match suggest(wrong, names.into_iter()) {
            Some(near) => self.help(format!("did you mean `{near}`?")),
            None => self.help(otherwise()),
        }
    }

    /// The place of the problem, if it has one.
    pub fn place(&self) -> Option<&Span> {
        self.labels.iter().find(|label| label.primary).map(|label| &label.span)
    }

    fn label(mut self, span: Option<Span>, text: String, primary: bool) -> Self {
        self.labels.extend(span.map(|span| Label { span, text, primary }));
        self
    }
}

impl fmt::Display for Diagnostic {
    /// `error[code]: message`; [`Files::plain`] adds the places.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        write!(f, "{severity}[{}]: {}", self.code, self.message)
    }
}

impl Files {
    /// Adds the template's instance for which the place is read, with the number of others, and the
    /// place where the instance is made.
    fn with_copies(&self, mut diagnostic: Diagnostic, others: usize) -> Diagnostic {
        let mut copy = diagnostic.place().and_then(|place| self.copy(place.copy));
        if copy.is_none() || diagnostic.labels.iter().any(|label| label.text.ends_with(USED)) {
            return diagnostic;
        }
        // related places of several instances are one place in the template
        let mut seen: Vec<Label> = Vec::new();
        diagnostic.labels.retain(|label| {
            let new = !seen.iter().any(|other| other.span.is_same_text(&label.span));
            seen.push(label.clone());
            new
        });
        let mut more = if others > 0 { format!(" and {others} more") } else { String::new() };
        while let Some(instance) = copy {
            let text = format!("in `{}`{}{USED}", instance.name, std::mem::take(&mut more));
            diagnostic = diagnostic.also(instance.made.clone(), text);
            copy = self.copy(instance.made.copy);
        }
        diagnostic
    }

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

/// The label of the place where an instance is made.
const USED: &str = ", used here";

/// Sorts by place and drops repetitions. A problem in a template is reported once, with its
/// instance.
pub fn arrange(files: &Files, diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by_key(|d| d.place().map(Span::order));
    diagnostics.dedup_by(|b, a| a.code == b.code && a.place().is_some() && a.place() == b.place());
    once_for_all_copies(files, diagnostics);
}

fn once_for_all_copies(files: &Files, diagnostics: &mut Vec<Diagnostic>) {
    let mut kept: Vec<(Diagnostic, usize)> = Vec::with_capacity(diagnostics.len());
    // the kept ones of the last place
    let mut here = 0;
    for diagnostic in diagnostics.drain(..) {
        let same = |other: &Diagnostic| match (diagnostic.place(), other.place()) {
            (Some(a), Some(b)) => a.is_same_text(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        if kept.last().is_some_and(|(last, _)| !same(last)) {
            here = kept.len();
        }
        let in_copy = diagnostic.place().is_some_and(|place| files.copy(place.copy).is_some());
        let first = kept.get_mut(here..).unwrap_or_default().iter_mut();
        match first.filter(|_| in_copy).find(|(other, _)| other.code == diagnostic.code) {
            Some((_, others)) => *others += 1,
            None => kept.push((diagnostic, 0)),
        }
    }
    diagnostics
        .extend(kept.into_iter().map(|(diagnostic, others)| files.with_copies(diagnostic, others)));
}
