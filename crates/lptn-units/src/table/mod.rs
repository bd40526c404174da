//! Tabulated functions of one number ([`Table1`]) and of two ([`Table2`]).
//!
//! All numbers are in SI units; a table knows nothing of units. [`Scope::table`](crate::Scope::table) says
//! what its arguments and its result are.

mod enclose;
mod error;
mod one;
mod pchip;
mod two;

use std::sync::Arc;

use crate::types::Type;
use crate::unit::Unit;

pub use error::TableError;
pub use one::Table1;
pub use two::Table2;

/// How a [`Table1`] runs between its points.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Interpolation {
    /// Straight lines.
    Linear,
    /// Cubic pieces that are smooth to the first derivative and rise and fall only where the points do.
    Pchip,
}

/// What a table is outside its points.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outside {
    /// Nothing: it has no value there. Up to 1e-14 of the larger end beyond it, which is rounding, is inside.
    Error,
    /// The value at the nearer end; its slope is 0.
    Hold,
}

/// A table of either kind.
#[derive(Clone, PartialEq, Debug)]
pub enum Table {
    /// A function of one number.
    One(Table1),
    /// A function of two numbers.
    Two(Table2),
}

impl Table {
    /// How many arguments it takes: 1 or 2.
    pub fn dimension(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Two(_) => 2,
        }
    }

    /// The knots along one argument, rising; empty for an argument that it does not have. The table is smooth
    /// between them, all derivatives included.
    pub fn knots(&self, argument: usize) -> &[f64] {
        match (self, argument) {
            (Self::One(table), 0) => table.knots(),
            (Self::Two(table), 0) => table.x_knots(),
            (Self::Two(table), 1) => table.y_knots(),
            _ => &[],
        }
    }

    /// Has it a value where this argument is `value`, as far as that one counts?
    pub(crate) fn reaches(&self, argument: usize, value: f64) -> bool {
        place(self.knots(argument), value, self.outside()).is_some()
    }

    /// What it is outside its knots.
    pub fn outside(&self) -> Outside {
        match self {
            Self::One(table) => table.outside(),
            Self::Two(table) => table.outside(),
        }
    }
}

/// A table in scope: what it is, and what it takes and gives.
#[derive(Clone, Debug)]
pub struct TableSymbol {
    /// The numbers, in SI units.
    pub table: Arc<Table>,
    /// The type of each argument, as many as [`Table::dimension`]; one that is missing is a plain number.
    pub arguments: Vec<Type>,
    /// The type of the value.
    pub ty: Type,
    /// The units in which people give them, arguments first, then the value; none where that is not known. Nothing is
    /// computed with them.
    pub units: Vec<Unit>,
}

impl TableSymbol {
    /// The type of one argument.
    pub(crate) fn argument(&self, index: usize) -> Type {
        self.arguments.get(index).copied().unwrap_or(Type::SCALAR)
    }
}

/// Where a number stands on one axis.
enum Place {
    /// In the interval that begins with this knot; the last knot is in the last interval.
    In(usize),
    /// Before the first knot, which is held.
    Below,
    /// After the last knot, which is held.
    Above,
}

/// What an argument may be beyond an end of its knots, relative to the larger end: the rounding of a few
/// operations, such as a speed computed from another speed and a ratio of gears.
const ROUNDING: f64 = 1e-14;

/// The place of `x` among knots that rise; `None` where the table has no value, and for a number that is not
/// finite.
fn place(knots: &[f64], x: f64, outside: Outside) -> Option<Place> {
    let (&first, &last) = (knots.first()?, knots.last()?);
    if !x.is_finite() {
        return None;
    }
    let after = knots.partition_point(|knot| *knot <= x);
    let inside = Place::In(after.clamp(1, knots.len() - 1) - 1);
    let beyond = (first - x).max(x - last);
    match outside {
        _ if beyond <= 0.0 => Some(inside),
        Outside::Error => (beyond <= ROUNDING * first.abs().max(last.abs())).then_some(inside),
        Outside::Hold => Some(if x < first { Place::Below } else { Place::Above }),
    }
}

/// On a straight line through two points: value and slope, exact at both.
fn line([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], x: f64) -> (f64, f64) {
    let slope = (y1 - y0) / (x1 - x0);
    let (before, after) = (x - x0, x1 - x);
    (if before <= after { y0 + slope * before } else { y1 - slope * after }, slope)
}
