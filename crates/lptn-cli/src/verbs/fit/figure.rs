//! What the pictures of the fits have in common.

use lptn_plot::figure::{Axis, Panel};
use lptn_units::Unit;

use crate::words::difference;

/// Height of a panel of residuals.
const RESIDUALS: f64 = 0.35;

/// An empty panel over time, of differences of temperatures that are shown in `unit`.
pub(crate) fn differences(name: &str, unit: &Unit) -> Panel {
    let axis = Axis::linear(name, difference(unit));
    Panel { share: RESIDUALS, ..Panel::new(Axis::time(), axis) }
}
