//! The names that an expression may use.

use std::sync::Arc;

use crate::expr::Expression;
use crate::table::TableSymbol;
use crate::types::Type;

/// Names with a fixed meaning, which no parameter, signal, control or table may take: the time `t`,
/// `pi`, the temperatures of the element at hand, and all functions but `sum`, which only a table may
/// not be called.
pub const RESERVED: &[&str] = &[
    "t", "pi", "T", "T_from", "T_to", "T_mean", "dT", "abs", "min", "max", "mean", "sqrt", "exp",
    "ln", "sin", "cos", "tanh", "if", "kelvin", "absolute",
];

/// A name in scope: the slot of its value, and its type.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Symbol {
    /// Index of the value among the slots given to [`Program::eval`](crate::Program::eval).
    pub slot: u32,
    /// The type of its value.
    pub ty: Type,
    /// Index to load instead inside the two operands of a comparison. An integrator keeps the truth
    /// of comparisons fixed between events by freezing the values in these slots.
    pub in_comparison: Option<u32>,
}

/// No names except functions: the scope of a constant expression.
#[derive(Clone, Copy, Debug)]
pub struct NoNames;

impl Scope for NoNames {
    fn symbol(&self, _: &str) -> Option<Symbol> {
        None
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The names an expression may use. `pi` and the functions need not be among them.
pub trait Scope {
    /// The meaning of a name: `omega`, `steel.T`, `ring[1,2,3].T`.
    fn symbol(&self, name: &str) -> Option<Symbol>;
    /// Every name, for "did you mean"; tables are not among them.
    fn names(&self) -> Vec<String>;

    /// The expression that a name represents, if any. Its own names represent no others.
    fn meaning(&self, name: &str) -> Option<Arc<Expression>> {
        let _ = name;
        None
    }

    /// The meaning of a name that is called: `loss(speed)`. No name is both a symbol and a table.
    fn table(&self, name: &str) -> Option<TableSymbol> {
        let _ = name;
        None
    }

    /// Every table, for "did you mean".
    fn table_names(&self) -> Vec<String> {
        Vec::new()
    }
}
