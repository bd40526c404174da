//! A problem of a network with the names that its message needs.

use std::fmt;

use lptn_units::{Problem, Problems};

use crate::error::BuildErrorKind;
use crate::error_words::Say;
use crate::id::{Field, Item};

/// All problems found while a network was built; never empty.
pub type BuildErrors = Problems<BuildError>;

/// One problem: its kind, and the names that a message needs.
#[derive(Clone, Debug)]
pub struct BuildError {
    /// The kind of problem, with its values in SI units.
    pub kind: BuildErrorKind,
    /// The name of the item it is about.
    pub name: String,
}

impl BuildError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        self.kind.code()
    }

    /// The item and field of the problem, if it is at one item.
    pub fn place(&self) -> Option<(Item, Field)> {
        self.kind.place()
    }

    /// A remedy, in words that can be pasted if possible.
    pub fn help(&self) -> Option<String> {
        self.kind.help(&Say::new(&self.name))
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.kind.message(&Say::new(&self.name)))
    }
}

impl std::error::Error for BuildError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            BuildErrorKind::Evaluation { error, .. } => Some(error),
            _ => None,
        }
    }
}

impl Problem for BuildError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn help(&self) -> Option<String> {
        self.help()
    }
}
