//! Limits of the results, and reports.

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
    /// The field of the value.
    pub fn field(self) -> Field {
        match self {
            Self::Below => Field::Below,
            Self::Above => Field::Above,
        }
    }
}

/// The consequence of a broken limit.
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
    /// The bound for `of`; constant for one set of parameters unless `compares`.
    pub value: Value,
    /// True if `value` is a result too: a requirement of a study compares any two results. A limit
    /// of the builder does not.
    pub compares: bool,
    /// True if the mean over time has to be kept, and not every moment: the mean is taken of `of`
    /// and `value`.
    pub of_mean: bool,
    /// The consequence if it is broken.
    pub severity: LimitSeverity,
    /// `of` as it was written.
    pub text: String,
}

impl Limit {
    /// The quantity, and the value that it has to stay below or above.
    pub fn sides(&self) -> [&Value; 2] {
        [&self.of, &self.value]
    }

    /// The type of the limit's margin: that of `of`, a difference for temperatures.
    pub fn margin_type(&self) -> Type {
        Type { absolute: false, ..self.ty }
    }
}

/// A named quantity that follows from the results: a separate column.
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
