//! Parts that the pictures of the fits have in common.

use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_plot::thinned;

/// Height of a panel of residuals.
const RESIDUALS: f64 = 0.35;

/// An empty panel over time, of differences in `unit`.
pub(crate) fn differences(name: &str, unit: &str) -> Panel {
    let axis = Axis::linear(name, unit);
    Panel { share: RESIDUALS, ..Panel::new(Axis::time(), axis) }
}

/// Stretches of a record of which a page has the first, lowest, highest and last value, so that
/// records of many rows can be sent. Records of at most four times as many rows are whole.
const STRETCHES: usize = 250;

/// The points of a curve over time that a page has.
pub(crate) fn sparse(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    thinned(points, STRETCHES)
}

/// Values of a record as dots.
pub(crate) fn dots(name: &str, points: &[(f64, f64)]) -> Curve {
    Curve::line(name, sparse(points)).looks(Look::Dots)
}

/// The note of a page without all rows of a record; empty otherwise.
pub(crate) fn sparse_note(rows: usize) -> &'static str {
    match rows > 4 * STRETCHES {
        true => {
            "of many rows, the first, lowest, highest and last of each 1/250 of the time are drawn"
        }
        false => "",
    }
}
