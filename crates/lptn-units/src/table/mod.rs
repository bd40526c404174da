//! Tabulated functions of one number ([`Table1`]) and of two ([`Table2`]).
//!
//! All numbers are in SI units; a table knows nothing of units.
//! [`Scope::table`](crate::Scope::table) gives the types of its arguments and its result.

mod axis;
mod double_log;
mod enclose;
mod error;
mod one;
mod pchip;
mod power_law;
mod two;

use std::sync::Arc;

use crate::types::Type;
use crate::unit::Unit;

use axis::place;
pub use axis::{Interpolation, Outside};
pub use double_log::DoubleLog;
pub use error::TableError;
pub use one::Table1;
pub use power_law::PowerLaw;
pub use two::Table2;

/// A function of one number or of two that is given by numbers.
#[derive(Clone, PartialEq, Debug)]
pub enum LookupTable {
    /// A function of one number.
    One(Table1),
    /// A function of two numbers.
    Two(Table2),
    /// A function of one number by a formula instead of points.
    DoubleLog(DoubleLog),
    /// A power of one number.
    PowerLaw(PowerLaw),
}

impl LookupTable {
    /// Number of its arguments: 1 or 2.
    pub fn dimension(&self) -> usize {
        match self {
            Self::One(_) | Self::DoubleLog(_) | Self::PowerLaw(_) => 1,
            Self::Two(_) => 2,
        }
    }

    /// The knots along one argument, rising; empty for an argument that it does not have. The table
    /// is smooth between them, all derivatives included.
    pub fn knots(&self, argument: usize) -> &[f64] {
        match (self, argument) {
            (Self::One(table), 0) => table.knots(),
            (Self::DoubleLog(line), 0) => line.range(),
            (Self::PowerLaw(law), 0) => law.range(),
            (Self::Two(table), 0) => table.x_knots(),
            (Self::Two(table), 1) => table.y_knots(),
            _ => &[],
        }
    }

    /// Number of the knots along one argument that are not above `value`: constant within one
    /// smooth piece.
    pub(crate) fn piece(&self, argument: usize, value: f64) -> usize {
        self.knots(argument).partition_point(|knot| *knot <= value)
    }

    /// True if it has a value at this `value` of the argument, as far as that one decides.
    pub(crate) fn reaches(&self, argument: usize, value: f64) -> bool {
        place(self.knots(argument), value, self.outside()).is_some()
    }

    /// The same, with its end values outside its knots; a formula is as it is.
    pub(crate) fn holding(&self) -> Self {
        match self {
            Self::One(table) => Self::One(table.holding()),
            Self::Two(table) => Self::Two(table.holding()),
            other => other.clone(),
        }
    }

    /// Its behaviour outside its knots.
    pub fn outside(&self) -> Outside {
        match self {
            Self::One(table) => table.outside(),
            Self::Two(table) => table.outside(),
            Self::DoubleLog(_) | Self::PowerLaw(_) => Outside::Error,
        }
    }
}

/// A table in scope, with the types of its arguments and its value.
#[derive(Clone, Debug)]
pub struct TableSymbol {
    /// The numbers, in SI units.
    pub table: Arc<LookupTable>,
    /// The type of each argument, as many as [`LookupTable::dimension`]; one that is missing is a
    /// plain number.
    pub arguments: Vec<Type>,
    /// The type of the value.
    pub ty: Type,
    /// The usual units, arguments first, then the value; empty if unknown. They are not used in
    /// computations.
    pub units: Vec<Unit>,
}

impl TableSymbol {
    /// The type of one argument.
    pub(crate) fn argument(&self, index: usize) -> Type {
        self.arguments.get(index).copied().unwrap_or(Type::SCALAR)
    }
}
