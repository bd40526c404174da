//! Parts that the pictures of the fits have in common.

use lptn_plot::figure::{Axis, Panel};

/// Height of a panel of residuals.
const RESIDUALS: f64 = 0.35;

/// An empty panel over time, of differences in `unit`.
pub(crate) fn differences(name: &str, unit: &str) -> Panel {
    let axis = Axis::linear(name, unit);
    Panel { share: RESIDUALS, ..Panel::new(Axis::time(), axis) }
}
