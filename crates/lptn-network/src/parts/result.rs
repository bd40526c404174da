//! Limits of the results, and reports.

use lptn_units::Type;

use crate::id::Field;
use crate::parts::functional::{Functional, OverTime};
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

    /// True if a functional has to stay on this side exactly if every value has to: the largest
    /// value is below a bound if all values are.
    pub fn is_of_moments(self, functional: Functional) -> bool {
        matches!(
            (self, functional),
            (Self::Below, Functional::Max) | (Self::Above, Functional::Min)
        )
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
    /// The type of both sides; a functional of `of` may have another type than `of`.
    pub ty: Type,
    /// The side on which it has to stay.
    pub bound: Bound,
    /// The bound for `of`; constant for one set of parameters unless `compares`.
    pub value: Value,
    /// True if `value` is a result too: a requirement of a study compares any two results. A limit
    /// of the builder does not.
    pub compares: bool,
    /// The functionals over time of `of` and of `value` that are compared, instead of both at every
    /// moment.
    pub over_time: [Option<OverTime>; 2],
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

    /// True if it has to be kept at every moment, and not by a number over time.
    pub fn is_of_moments(&self) -> bool {
        self.over_time.iter().all(Option::is_none)
    }

    /// The type of the limit's margin: that of `of`, a difference for temperatures.
    pub fn margin_type(&self) -> Type {
        Type { absolute: false, ..self.ty }
    }
}

/// A named quantity that follows from the results: a separate column, or a number over time.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// An expression over parameters, `t`, signals, tables, temperatures and heat flows of the
    /// results.
    pub value: Value,
    /// The type of its value; a functional may have another type than `value`.
    pub ty: Type,
    /// Its functional of `value` over a run, a cycle or a window, if it is one number and not a
    /// column.
    pub over_time: Option<OverTime>,
    /// The expression as it was written.
    pub text: String,
}

impl Report {
    /// The type of `value` at one moment.
    pub fn type_of_moments(&self) -> Type {
        self.over_time.as_ref().map_or(self.ty, |over_time| over_time.of_ty)
    }
}
