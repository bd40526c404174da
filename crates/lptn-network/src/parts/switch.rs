//! Switches: comparisons of temperatures. Their truth is fixed between events.

use std::sync::Arc;

use lptn_units::{Comparison, Program};

use crate::id::{Field, Item};

/// A comparison whose truth changes at times that are not known in advance.
#[derive(Clone, Debug)]
pub struct Switch {
    /// The source or conductor it belongs to.
    pub item: Item,
    /// The field that contains it.
    pub field: Field,
    /// Left side minus right side.
    pub difference: Arc<Program>,
    /// The relation of the sides: less or greater, never equality.
    pub relation: Comparison,
}

impl Switch {
    /// True if the comparison is true when left minus right is `difference`.
    pub fn holds(&self, difference: f64) -> bool {
        self.relation.holds(difference, 0.0)
    }
}
