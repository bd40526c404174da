//! What the results have to keep, and what is reported of them.

use lptn_units::Type;

use crate::id::Field;
use crate::value::Value;

/// The side on which a limited quantity has to stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// It has to stay below the value.
    Below,
    /// It has to stay above the value.
    Above,
}

impl Bound {
    /// The field that holds the value.
    pub fn field(self) -> Field {
        match self {
            Self::Below => Field::Below,
            Self::Above => Field::Above,
        }
    }
}

/// What a broken limit means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitSeverity {
    /// A broken limit ends with exit code 1.
    Error,
    /// A broken limit is printed, and the exit code stays 0.
    Warning,
}

/// A quantity of the results that has to stay below or above a value.
#[derive(Clone, Debug)]
pub struct Limit {
    /// Its name, unique among nodes, boundaries and elements.
    pub name: String,
    /// The quantity: an expression over parameters, `t`, signals, tables, temperatures and heat
    /// flows of the results.
    pub of: Value,
    /// The type of `of` and of `value`.
    pub ty: Type,
    /// The side on which it has to stay.
    pub bound: Bound,
    /// What it has to stay below or above; constant for one set of parameters unless `compares`.
    pub value: Value,
    /// Whether `value` is a result too: what a study requires compares any two. A limit of the
    /// builder does not.
    pub compares: bool,
    /// Whether it is the mean over time that has to be kept, and not every moment: `of` and `value`
    /// are then what the mean is taken of.
    pub of_mean: bool,
    /// What it means if it is broken.
    pub severity: LimitSeverity,
    /// `of` as it was written.
    pub text: String,
}

impl Limit {
    /// What is compared: the quantity, and what it has to stay below or above.
    pub fn sides(&self) -> [&Value; 2] {
        [&self.of, &self.value]
    }

    /// The type of the limit's margin: like `of`, but for temperatures a difference.
    pub fn margin_type(&self) -> Type {
        Type { absolute: false, ..self.ty }
    }
}

/// A named quantity that follows from the results: a column of its own.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// An expression over parameters, `t`, signals, tables, temperatures and heat flows of the
    /// results.
    pub value: Value,
    /// The type of its value.
    pub ty: Type,
    /// The expression as it was written.
    pub text: String,
}
