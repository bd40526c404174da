//! One axis of a table: its knots, and the places between and beyond them.

/// The interpolation of a [`Table1`](crate::Table1) between its points.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Interpolation {
    /// Straight lines.
    Linear,
    /// Cubic pieces with a continuous first derivative that rise and fall only with the points.
    Pchip,
}

/// The behaviour of a table outside its points.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outside {
    /// No value. Up to 1e-14 of the larger end beyond it, which is rounding, is inside.
    Error,
    /// The value at the nearer end; its slope is 0.
    Hold,
}

/// The place of a number on one axis.
pub(super) enum Place {
    /// In the interval that begins with this knot; the last knot is in the last interval.
    In(usize),
    /// Before the first knot, whose value continues.
    Below,
    /// After the last knot, whose value continues.
    Above,
}

/// Largest distance of an argument beyond an end of its knots, relative to the larger end: the
/// rounding of a few operations, such as a speed computed from another speed and a ratio of gears.
const ROUNDING: f64 = 1e-14;

/// The place of `x` among knots that rise; `None` if the table has no value there, or `x` is not
/// finite.
pub(super) fn place(knots: &[f64], x: f64, outside: Outside) -> Option<Place> {
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
pub(super) fn line([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], x: f64) -> (f64, f64) {
    let slope = (y1 - y0) / (x1 - x0);
    let (before, after) = (x - x0, x1 - x);
    (if before <= after { y0 + slope * before } else { y1 - slope * after }, slope)
}
