//! A tabulated function of two numbers.

use super::axis::{Outside, Place, line, place};
use super::error::TableError;
use super::error::{check_finite, check_knots};

/// A function of two numbers over a grid of points, bilinear in each of its cells.
///
/// ```
/// use lptn_units::{Outside, Table2};
///
/// let (x, y) = (vec![0.0, 1.0], vec![0.0, 2.0]);
/// let map = Table2::new(x, y, vec![0.0, 4.0, 10.0, 16.0], Outside::Error)?;
/// assert_eq!(map.value_and_slopes(0.5, 1.0), Some((7.5, [11.0, 2.5])));
/// assert_eq!(map.value_and_slopes(0.5, 3.0), None);
/// # Ok::<(), lptn_units::TableError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Table2 {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    outside: Outside,
}

/// A place on one axis: the interval, the number limited to the knots, and true if between them.
struct Held {
    interval: usize,
    at: f64,
    inside: bool,
}

impl Table2 {
    /// The same, with its end values outside its knots.
    pub(super) fn holding(&self) -> Self {
        Self { outside: Outside::Hold, ..self.clone() }
    }

    /// The function with the value `z[i * y.len() + j]` at `(x[i], y[j])`, `x` and `y` rising.
    ///
    /// # Errors
    ///
    /// Per argument, fewer than two knots, numbers that are not finite or do not rise; then, values
    /// that are not as many as the points of the grid, or not finite.
    pub fn new(
        x: Vec<f64>,
        y: Vec<f64>,
        z: Vec<f64>,
        outside: Outside,
    ) -> Result<Self, TableError> {
        for (argument, knots) in [&x, &y].into_iter().enumerate() {
            check_knots(knots)
                .map_err(|error| TableError::Argument { argument, error: Box::new(error) })?;
        }
        if x.len().checked_mul(y.len()) != Some(z.len()) {
            return Err(TableError::LengthsDiffer);
        }
        check_finite(&z)?;
        Ok(Self { x, y, z, outside })
    }

    /// The value at `(x, y)` and its slopes along `x` and `y`. At a knot the slope is that of the
    /// cell above it, at the last knot that of the cell below; along an argument beyond ends with
    /// [`Outside::Hold`] it is 0.
    ///
    /// `None` if an argument is outside its knots with [`Outside::Error`], or not finite.
    pub fn value_and_slopes(&self, x: f64, y: f64) -> Option<(f64, [f64; 2])> {
        let (in_x, in_y) = (self.hold(&self.x, x)?, self.hold(&self.y, y)?);
        let (i, j) = (in_x.interval, in_y.interval);
        let (xs, ys) = ([self.x[i], self.x[i + 1]], [self.y[j], self.y[j + 1]]);
        let row = |i: usize| {
            let start = i * self.y.len() + j;
            [self.z[start], self.z[start + 1]]
        };
        let (low, high) = (row(i), row(i + 1));
        let (left, left_slope) = line(ys, low, in_y.at);
        let (right, right_slope) = line(ys, high, in_y.at);
        let (value, along_x) = line(xs, [left, right], in_x.at);
        let (along_y, _) = line(xs, [left_slope, right_slope], in_x.at);
        let kept = |slope: f64, held: &Held| if held.inside { slope } else { 0.0 };
        Some((value, [kept(along_x, &in_x), kept(along_y, &in_y)]))
    }

    /// The knots of the first argument, rising.
    pub fn x_knots(&self) -> &[f64] {
        &self.x
    }

    /// The knots of the second argument, rising.
    pub fn y_knots(&self) -> &[f64] {
        &self.y
    }

    /// The values, row by row: all of the first `x`, then all of the second.
    pub fn values(&self) -> &[f64] {
        &self.z
    }

    /// Its behaviour outside its points.
    pub fn outside(&self) -> Outside {
        self.outside
    }

    fn hold(&self, knots: &[f64], at: f64) -> Option<Held> {
        Some(match place(knots, at, self.outside)? {
            Place::In(interval) => Held { interval, at, inside: true },
            Place::Below => Held { interval: 0, at: *knots.first()?, inside: false },
            Place::Above => Held { interval: knots.len() - 2, at: *knots.last()?, inside: false },
        })
    }
}
