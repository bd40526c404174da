//! Straight lines in a double logarithm, like the viscosity of oils over temperature.

use crate::taylor::Taylor;

/// A function of one number above 0 that is a straight line in the double logarithm:
/// `ln ln(y / unit + shift) = a - b ln x`.
#[derive(Clone, PartialEq, Debug)]
pub struct DoubleLog {
    points: [[f64; 2]; 2],
    shift: f64,
    unit: f64,
    /// a and b.
    line: [f64; 2],
    range: [f64; 2],
}

impl DoubleLog {
    /// The one through two points `[x, y]`, for `x` from the place at which `y` is `most` up to
    /// `last`; `None` unless `0 < x0 < x1 < last` and `unit < y1 < y0 < most`.
    ///
    /// * `shift`: the number added to `y / unit`, between 0 and 1
    /// * `unit`: the unit of `y`
    pub fn through(
        points: [[f64; 2]; 2],
        (shift, unit): (f64, f64),
        (most, last): (f64, f64),
    ) -> Option<Self> {
        let [[x0, y0], [x1, y1]] = points;
        let rises = 0.0 < x0 && x0 < x1 && x1 < last && (0.0..=1.0).contains(&shift);
        if !(rises && unit < y1 && y1 < y0 && y0 < most) {
            return None;
        }
        let level = |y: f64| (y / unit + shift).ln().ln();
        let b = (level(y0) - level(y1)) / (x1 / x0).ln();
        let a = level(y0) + b * x0.ln();
        let first = ((a - level(most)) / b).exp();
        Some(Self { points, shift, unit, line: [a, b], range: [first, last] })
    }

    /// The points that it goes through.
    pub fn points(&self) -> [[f64; 2]; 2] {
        self.points
    }

    /// The number added to `y / unit`.
    pub fn shift(&self) -> f64 {
        self.shift
    }

    /// The range of its argument.
    pub fn range(&self) -> &[f64] {
        &self.range
    }

    /// Its value and slope; `None` outside its range.
    pub fn value_and_slope(&self, x: f64) -> Option<(f64, f64)> {
        let [first, last] = self.range;
        let [a, b] = self.line;
        let inner = (first..=last).contains(&x).then(|| (a - b * x.ln()).exp())?;
        let sum = inner.exp();
        Some((self.unit * (sum - self.shift), -self.unit * sum * inner * b / x))
    }

    /// Bounds on its value for an argument with known bounds.
    pub(crate) fn enclose(&self, x: Taylor) -> Taylor {
        let ([first, last], [a, b]) = (self.range, self.line);
        match x.range() {
            Some([from, to]) if first <= from && to <= last => {
                let sum = (Taylor::constant(a) - Taylor::constant(b) * x.ln()).exp().exp();
                Taylor::constant(self.unit) * (sum - Taylor::constant(self.shift))
            }
            _ => Taylor::unknown(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::DoubleLog;
    use crate::taylor::Taylor;

    const POINTS: [[f64; 2]; 2] = [[313.15, 220e-6], [373.15, 19e-6]];

    fn oil() -> DoubleLog {
        DoubleLog::through(POINTS, (0.7, 1e-6), (20.0, 1000.0)).expect("an oil")
    }

    #[test]
    fn it_goes_through_its_points_with_the_slope_of_differences() {
        let oil = oil();
        for [x, y] in POINTS {
            let (value, slope) = oil.value_and_slope(x).expect("a value");
            assert!((value / y - 1.0).abs() < 1e-13, "{value}");
            let at = |x: f64| oil.value_and_slope(x).expect("a value").0;
            let difference = (at(x + 1e-3) - at(x - 1e-3)) / 2e-3;
            assert!((slope / difference - 1.0).abs() < 1e-8, "{slope} and {difference}");
        }
        // log10 log10 (nu + 0.7) in the middle of the logarithms of T is that of the ends
        let middle = (POINTS[0][0] * POINTS[1][0]).sqrt();
        let level = |y: f64| (y * 1e6 + 0.7).log10().log10();
        let found = level(oil.value_and_slope(middle).expect("a value").0);
        assert!((found - 0.5 * (level(POINTS[0][1]) + level(POINTS[1][1]))).abs() < 1e-14);
    }

    #[test]
    fn it_ends_where_the_oil_is_solid_and_is_enclosed_before() {
        let oil = oil();
        let first = oil.range()[0];
        assert!((oil.value_and_slope(first).expect("a value").0 / 20.0 - 1.0).abs() < 1e-9);
        assert_eq!(oil.value_and_slope(first - 1.0), None);
        let bounds = oil.enclose(Taylor::variable(320.0, 330.0)).range().expect("bounds");
        let at = |x: f64| oil.value_and_slope(x).expect("a value").0;
        assert!(bounds[0] <= at(330.0) && at(320.0) <= bounds[1]);
        assert_eq!(oil.enclose(Taylor::variable(first - 1.0, 300.0)).range(), None);
    }

    #[test]
    fn points_that_do_not_fall_are_refused() {
        let through = |points| DoubleLog::through(points, (0.7, 1e-6), (20.0, 1000.0));
        let [a, b] = POINTS;
        assert!(through([b, a]).is_none() && through([a, a]).is_none());
        assert!(through([[a[0], b[1]], [b[0], a[1]]]).is_none());
    }
}
