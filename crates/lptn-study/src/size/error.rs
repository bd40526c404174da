//! Why a parameter cannot be sized.

use std::fmt;

use lptn_assembly::AssemblyError;
use lptn_network::{BuildErrors, Changing};
use lptn_solve::SteadyError;
use lptn_units::EvalError;

/// Why a parameter cannot be sized. That no value keeps the requirements is an answer and no error.
#[derive(Clone, Debug)]
pub enum SizeError {
    /// The range does not begin before it ends, or an end is not finite; in SI units.
    Range {
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Nothing is required.
    NoRequirement,
    /// What is required depends on inputs that change with time: there is no one steady state to judge. At least one.
    Changing(Vec<Changing>),
    /// The network does not exist for a value inside the range.
    Network {
        /// The value in SI units.
        value: f64,
        /// What it breaks.
        errors: BuildErrors,
    },
    /// The network cannot be assembled.
    Assembly(AssemblyError),
    /// The network has no steady state for a value inside the range.
    Steady {
        /// The value in SI units.
        value: f64,
        /// Why not.
        error: SteadyError,
    },
    /// A requirement has no value.
    Requirement {
        /// The requirement as it was written.
        text: String,
        /// What went wrong; `None` if it gave no finite number.
        error: Option<EvalError>,
    },
}

impl SizeError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Range { .. } => "size::range",
            Self::NoRequirement => "size::no_requirement",
            Self::Changing(_) => "size::inputs_change",
            Self::Network { .. } => "size::network",
            Self::Assembly(error) => error.code(),
            Self::Steady { error, .. } => error.code(),
            Self::Requirement { .. } => "size::requirement",
        }
    }
}

impl fmt::Display for SizeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range { from, to } => {
                write!(f, "the range has to begin before it ends, got {from} to {to}")
            }
            Self::NoRequirement => f.write_str("nothing is required, so nothing can be sized"),
            Self::Changing(_) => f.write_str(
                "what is required depends on inputs that change with time, and a steady state knows only one moment of \
                 them",
            ),
            Self::Network { value, errors } => write!(f, "there is no network at {value}: {errors}"),
            Self::Assembly(error) => error.fmt(f),
            Self::Steady { value, error } => write!(f, "there is no steady state at {value}: {error}"),
            Self::Requirement { text, error: Some(error) } => write!(f, "`{text}` has no value: {error}"),
            Self::Requirement { text, error: None } => write!(f, "`{text}` has no finite value"),
        }
    }
}

impl std::error::Error for SizeError {}
