//! Reason why a command ended early.

use std::{fmt, io};

use lptn_netlist::{Diagnostic, Files, ReadError, Rejected};
use lptn_units::{Class, Help, Problem};

use crate::exit::Exit;

/// Problems to print, and the exit code.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Exit code of the command.
    pub exit: Exit,
    /// The files that places are in.
    pub files: Files,
    /// The problems, at least one.
    pub diagnostics: Vec<Diagnostic>,
}

impl Failure {
    /// One diagnostic about no file.
    pub fn new(exit: Exit, diagnostic: Diagnostic) -> Self {
        Self::at(exit, Files::new(), diagnostic)
    }

    /// A question that cannot be asked in this way, about no file.
    pub fn refused(code: &'static str, message: impl Into<String>, help: impl Help) -> Self {
        Self::new(Exit::Input, Diagnostic::error(code, message).help(help))
    }

    /// A problem in its own words, about no file.
    pub fn of(problem: &dyn Problem) -> Self {
        Self::new(problem.class().into(), told(problem))
    }

    /// A file or folder that cannot be read.
    pub fn cannot_read(name: impl fmt::Display, error: &io::Error, help: impl Help) -> Self {
        Self::refused("input::cannot_read", format!("cannot read {name}: {}", reason(error)), help)
    }

    /// The same failure with another help text.
    pub fn with_help(mut self, help: &str) -> Self {
        self.diagnostics.iter_mut().for_each(|problem| problem.help = Some(help.into()));
        self
    }

    /// One diagnostic about a place in `files`.
    pub fn at(exit: Exit, files: Files, diagnostic: Diagnostic) -> Self {
        Self { exit, files, diagnostics: vec![diagnostic] }
    }
}

/// The first problem.
impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostics.first().map_or(Ok(()), |first| f.write_str(&first.message))
    }
}

impl std::error::Error for Failure {}

impl Problem for Failure {
    fn code(&self) -> &'static str {
        self.diagnostics.first().map_or("", |first| first.code)
    }

    fn help(&self) -> Option<String> {
        self.diagnostics.first()?.help.clone()
    }

    fn class(&self) -> Class {
        match self.exit {
            Exit::Done | Exit::No => Class::No,
            Exit::Input => Class::Input,
            Exit::Failed => Class::Numbers,
            Exit::Interrupted => Class::Interrupted,
        }
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
            ReadError::Io { path, error } => Self::cannot_read(path.display(), &error, None),
        }
    }
}

/// A problem with its code and help.
pub fn told(problem: &dyn Problem) -> Diagnostic {
    Diagnostic::error(problem.code(), problem.to_string()).help(problem.help())
}

/// The reason of an i/o error in words that fit into a sentence.
pub fn reason(error: &io::Error) -> String {
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
