//! A tabulated function of one number.

use super::axis::{Interpolation, Outside, Place, line, place};
use super::error::TableError;
use super::error::{check_finite, check_knots};
use super::pchip;

/// A function of one number through two points or more.
///
/// ```
/// use lptn_units::{Interpolation, Outside, Table1};
///
/// let loss = Table1::new(vec![0.0, 10.0], vec![5.0, 25.0], Interpolation::Linear, Outside::Hold)?;
/// assert_eq!(loss.value_and_slope(5.0), Some((15.0, 2.0)));
/// assert_eq!(loss.value_and_slope(11.0), Some((25.0, 0.0)));
/// assert_eq!(loss.integral(0.0, 12.0), Some(150.0 + 50.0));
/// # Ok::<(), lptn_units::TableError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Table1 {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// The slope at every knot; empty for straight lines.
    pub(super) slopes: Vec<f64>,
    /// The integral from the first knot to each.
    areas: Vec<f64>,
    pub(super) outside: Outside,
}

impl Table1 {
    /// The same, with its end values outside its knots.
    pub(super) fn holding(&self) -> Self {
        Self { outside: Outside::Hold, ..self.clone() }
    }

    /// The function through the points `(x[i], y[i])`, `x` rising.
    ///
    /// # Errors
    ///
    /// Fewer than two points, lists of different length, numbers that are not finite, arguments
    /// that do not rise; in this order.
    pub fn new(
        x: Vec<f64>,
        y: Vec<f64>,
        interpolation: Interpolation,
        outside: Outside,
    ) -> Result<Self, TableError> {
        if x.len() < 2 || y.len() < 2 {
            return Err(TableError::TooShort);
        }
        if x.len() != y.len() {
            return Err(TableError::LengthsDiffer);
        }
        check_finite(&y)?;
        check_knots(&x)?;
        let slopes = match interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Pchip => pchip::slopes(&x, &y),
        };
        let mut table = Self { areas: vec![0.0; x.len()], x, y, slopes, outside };
        for i in 1..table.x.len() {
            table.areas[i] = table.areas[i - 1] + table.piece(i - 1, table.x[i - 1], table.x[i]);
        }
        Ok(table)
    }

    /// Value and slope at `x`. At a knot of straight lines the slope is that of the right piece, at
    /// the last knot that of the left one; beyond ends with [`Outside::Hold`] it is 0.
    ///
    /// `None` outside the knots with [`Outside::Error`], and for an `x` that is not finite.
    pub fn value_and_slope(&self, x: f64) -> Option<(f64, f64)> {
        match place(&self.x, x, self.outside)? {
            Place::In(piece) => Some(self.within(piece, x)),
            Place::Below => Some((*self.y.first()?, 0.0)),
            Place::Above => Some((*self.y.last()?, 0.0)),
        }
    }

    /// The same, faster if `x` is on the same piece as in the last call; `piece` is any number at
    /// first.
    pub fn value_and_slope_near(&self, x: f64, piece: &mut usize) -> Option<(f64, f64)> {
        let is_inside = |ends: &[f64]| ends[0] <= x && x < ends[1];
        if self.x.get(*piece..piece.saturating_add(2)).is_some_and(is_inside) {
            return Some(self.within(*piece, x));
        }
        if let Place::In(found) = place(&self.x, x, self.outside)? {
            *piece = found;
        }
        self.value_and_slope(x)
    }

    /// The integral from one number to another, exact except for rounding; the negative of itself
    /// with the limits exchanged. Limits in one interval lose nothing to cancellation, however near
    /// they are.
    ///
    /// `None` if a limit is outside the knots with [`Outside::Error`], or not finite.
    pub fn integral(&self, from: f64, to: f64) -> Option<f64> {
        if to < from {
            return self.integral(to, from).map(|integral| -integral);
        }
        let places = (place(&self.x, from, self.outside)?, place(&self.x, to, self.outside)?);
        let (first, last) = (*self.x.first()?, *self.x.last()?);
        let (low, high) = (*self.y.first()?, *self.y.last()?);
        Some(match places {
            (Place::Below, Place::Below) => low * (to - from),
            (Place::Above, _) => high * (to - from),
            (Place::Below, _) => low * (first - from) + self.integral(first, to)?,
            (_, Place::Above) => self.integral(from, last)? + high * (to - last),
            (Place::In(i), Place::In(j)) if i == j => self.piece(i, from, to),
            (Place::In(i), Place::In(j)) => {
                let whole = self.areas[j] - self.areas[i + 1];
                self.piece(i, from, self.x[i + 1]) + whole + self.piece(j, self.x[j], to)
            }
            (Place::In(_), Place::Below) => 0.0,
        })
    }

    /// The arguments, rising.
    pub fn knots(&self) -> &[f64] {
        &self.x
    }

    /// The value at each knot.
    pub fn values(&self) -> &[f64] {
        &self.y
    }

    /// The interpolation between its points.
    pub fn interpolation(&self) -> Interpolation {
        if self.slopes.is_empty() { Interpolation::Linear } else { Interpolation::Pchip }
    }

    /// Its behaviour outside its points.
    pub fn outside(&self) -> Outside {
        self.outside
    }

    /// In the interval that begins with knot `i`.
    fn within(&self, i: usize, x: f64) -> (f64, f64) {
        let ends = |list: &[f64]| [list[i], list[i + 1]];
        if self.slopes.is_empty() {
            line(ends(&self.x), ends(&self.y), x)
        } else {
            pchip::cubic(ends(&self.x), ends(&self.y), ends(&self.slopes), x)
        }
    }

    /// The integral over a part of one interval, by Simpson's rule, which is exact for cubics.
    fn piece(&self, i: usize, from: f64, to: f64) -> f64 {
        let value = |x: f64| self.within(i, x).0;
        (to - from) / 6.0 * (value(from) + 4.0 * value(from.midpoint(to)) + value(to))
    }
}
