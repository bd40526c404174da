//! An input that has no value during a run.

use std::fmt;

use lptn_units::EvalError;

use crate::id::{Field, Item};

/// A source or boundary whose value could not be had during a run.
#[derive(Clone, Debug)]
pub struct InputError {
    /// The source or boundary.
    pub item: Item,
    /// Its field.
    pub field: Field,
    /// Its name.
    pub name: String,
    /// What went wrong.
    pub problem: InputProblem,
}

/// Why an input has no value.
#[derive(Clone, Debug)]
pub enum InputProblem {
    /// The expression gave an infinite number or none.
    NotFinite(f64),
    /// A temperature below 0 K.
    BelowAbsoluteZero(f64),
    /// The expression could not be evaluated.
    Evaluation(EvalError),
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` of `{}` ", self.field.key(), self.name)?;
        match &self.problem {
            InputProblem::NotFinite(value) => write!(f, "is {value}"),
            InputProblem::BelowAbsoluteZero(value) => write!(f, "is below absolute zero: {value} K"),
            InputProblem::Evaluation(error) => write!(f, "cannot be evaluated: {error}"),
        }
    }
}

impl std::error::Error for InputError {}
