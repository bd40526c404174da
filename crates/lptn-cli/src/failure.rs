//! Why a command ended early.

use lptn_netlist::{Diagnostic, Files, ReadError, Rejected};
use lptn_units::Problem;

use crate::exit::Exit;

/// What is printed, and the exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) exit: Exit,
    pub(crate) files: Files,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Failure {
    /// One diagnostic about no file.
    pub(crate) fn new(exit: Exit, diagnostic: Diagnostic) -> Self {
        Self::at(exit, Files::new(), diagnostic)
    }

    /// What is wrong, in its own words, about no file.
    pub(crate) fn of(exit: Exit, problem: &dyn Problem) -> Self {
        Self::new(exit, told(problem))
    }

    /// One diagnostic about a place in `files`.
    pub(crate) fn at(exit: Exit, files: Files, diagnostic: Diagnostic) -> Self {
        Self { exit, files, diagnostics: vec![diagnostic] }
    }
}

impl From<Rejected> for Failure {
    fn from(rejected: Rejected) -> Self {
        Self { exit: Exit::Input, files: rejected.files, diagnostics: rejected.diagnostics }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Rejected(rejected) => rejected.into(),
            ReadError::Io { path, error } => {
                let message = format!("cannot read {}: {}", path.display(), reason(&error));
                Self::new(Exit::Input, Diagnostic::error("input::cannot_read", message))
            }
        }
    }
}

/// A problem with its code and help.
pub(crate) fn told(problem: &dyn Problem) -> Diagnostic {
    let diagnostic = Diagnostic::error(problem.code(), problem.to_string());
    match problem.help() {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

/// The reason of an i/o error in words that fit into a sentence.
pub(crate) fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or_default();
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn reasons_fit_into_a_sentence() {
        let missing = std::fs::read("no such file").unwrap_err();
        assert_eq!(reason(&missing), "no such file or directory");
    }
}
