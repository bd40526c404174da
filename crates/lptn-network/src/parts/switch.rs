//! Switches: comparisons of temperatures. Their truth is held between events.

use std::sync::Arc;

use lptn_units::{Comparison, Program};

use crate::id::{Field, Item};

/// A comparison whose truth changes at times that are not known beforehand.
#[derive(Clone, Debug)]
pub struct Switch {
    /// The source or conductor it belongs to.
    pub item: Item,
    /// The field it stands in.
    pub field: Field,
    /// Left side minus right side.
    pub difference: Arc<Program>,
    /// How the sides are compared: less or greater, never for equality.
    pub relation: Comparison,
}

impl Switch {
    /// Whether the comparison holds where left minus right is `difference`.
    pub fn holds(&self, difference: f64) -> bool {
        self.relation.holds(difference, 0.0)
    }
}
