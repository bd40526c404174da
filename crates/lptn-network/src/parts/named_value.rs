//! Named values: expressions in the place of their names.

use std::sync::Arc;

use lptn_units::{Expression, Type};

/// A named expression over parameters, signals, controls, states and temperatures.
#[derive(Clone, Debug)]
pub struct NamedValue {
    /// Its name, unique among parameters, signals, tables, controls, states and reports.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its text.
    pub text: String,
    /// Its meaning; names of other values in it are replaced by theirs.
    pub(crate) meaning: Arc<Expression>,
}
