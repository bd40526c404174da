//! Polynomials between -1 and 1 with an allowance: the form of everything that is bounded over a
//! step.

use lptn_units::Taylor;

/// Most coefficients of a polynomial.
const MOST: usize = 16;

/// Most halvings of the range between -1 and 1.
const HALVINGS: usize = 24;

/// The polynomial, and the most by which the bounded number differs from it.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub(super) coefficients: Vec<f64>,
    pub(super) allowance: f64,
}

/// A part of the range: its middle, its half width, and the coefficients about the middle in a
/// variable from -1 to 1.
struct Part {
    middle: f64,
    half: f64,
    shifted: [f64; MOST],
    /// The most by which the polynomial differs from its value in the middle.
    spread: f64,
}

impl Part {
    fn end(&self, sign: f64) -> f64 {
        self.middle + sign * self.half
    }

    /// True if it makes no difference to halve the part: its values differ by rounding, or by little
    /// of an allowance.
    fn is_flat(&self, allowance: f64) -> bool {
        self.spread
            <= (0.5 * Course::SLACK * allowance).max(4.0 * f64::EPSILON * self.shifted[0].abs())
    }

    /// True if the polynomial rises or falls over the whole part.
    fn is_monotone(&self, count: usize) -> bool {
        let others = (2..count).map(|k| k as f64 * self.shifted[k].abs()).sum::<f64>();
        count < 2 || self.shifted[1].abs() > others
    }
}

impl Course {
    /// The most by which the ends of a range are outside of the values, as a share of the allowance.
    pub(super) const SLACK: f64 = 2e-3;

    /// From the Taylor coefficients in the middle of a step and bounds on them over the whole step;
    /// `None` if nothing is known.
    ///
    /// Taylor's theorem: the coefficients below an order in the middle, and that of this order
    /// somewhere in the step. The order is the one whose rest is smallest.
    pub(super) fn of(middle: &Taylor, whole: &Taylor) -> Option<Self> {
        let size = |[low, high]: [f64; 2]| low.abs().max(high.abs());
        let rest = |order: usize| match order {
            // the range itself: its middle is a better value than 0
            0 => 0.5 * (whole.term(0)[1] - whole.term(0)[0]),
            _ => size(whole.term(order)),
        };
        let orders = (0..=Taylor::ORDER).filter(|k| rest(*k).is_finite());
        let order = orders.min_by(|a, b| rest(*a).total_cmp(&rest(*b)))?;
        if order == 0 {
            let [low, high] = whole.term(0);
            return Some(Self { coefficients: vec![0.5 * (low + high)], allowance: rest(0) });
        }
        let terms = (0..order).map(|k| middle.term(k));
        let spread: f64 = terms.clone().map(|[low, high]| 0.5 * (high - low)).sum();
        let coefficients = terms.map(|[low, high]| 0.5 * (low + high)).collect();
        let allowance = spread + rest(order);
        allowance.is_finite().then_some(Self { coefficients, allowance })
    }

    pub(super) fn at(&self, place: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * place + c)
    }

    /// The integral of the polynomial from -1 to 1.
    pub(super) fn integral(&self) -> f64 {
        let even = self.coefficients.iter().enumerate().step_by(2);
        even.map(|(k, c)| 2.0 * c / (k + 1) as f64).sum()
    }

    /// Sum of the absolute values of the coefficients.
    pub(super) fn size(&self) -> f64 {
        self.coefficients.iter().map(|c| c.abs()).sum()
    }

    fn part(&self, middle: f64, half: f64) -> Part {
        let count = self.coefficients.len();
        let mut shifted = [0.0; MOST];
        for (k, c) in self.coefficients.iter().enumerate().rev() {
            // Horner's rule: shifted * (middle + half x) + c
            for j in (1..count - k).rev() {
                shifted[j] = shifted[j] * middle + shifted[j - 1] * half;
            }
            shifted[0] = shifted[0] * middle + c;
        }
        let spread = shifted[1..].iter().map(|c| c.abs()).sum();
        Part { middle, half, shifted, spread }
    }

    /// The least and the largest value of the polynomial; wider than they are by at most
    /// [`Course::SLACK`], never less wide.
    pub(super) fn range(&self) -> [f64; 2] {
        let ends = [self.at(-1.0), self.at(1.0)];
        let mut range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        self.widen(&self.part(0.0, 1.0), HALVINGS, &mut range);
        range
    }

    fn widen(&self, part: &Part, halvings: usize, range: &mut [f64; 2]) {
        let [low, high] = [part.shifted[0] - part.spread, part.shifted[0] + part.spread];
        let inside = range[0] <= low && high <= range[1];
        if inside || (part.is_monotone(self.coefficients.len()) && self.ends_in(part, range)) {
            return;
        }
        if halvings == 0 || part.is_flat(self.allowance) {
            *range = [range[0].min(low), range[1].max(high)];
            return;
        }
        for sign in [-0.5, 0.5] {
            let half = self.part(part.end(sign), 0.5 * part.half);
            self.widen(&half, halvings - 1, range);
        }
    }

    /// Takes the values at the ends of a part into the range.
    fn ends_in(&self, part: &Part, range: &mut [f64; 2]) -> bool {
        for value in [-1.0, 1.0].map(|sign| self.at(part.end(sign))) {
            *range = [range[0].min(value), range[1].max(value)];
        }
        true
    }

    /// A place before which the polynomial is surely not below a level.
    pub(super) fn may_fall_below(&self, level: f64) -> Option<f64> {
        self.first(&self.part(0.0, 1.0), HALVINGS, (level, false))
    }

    /// The first place found at which the polynomial is surely below a level.
    pub(super) fn falls_below(&self, level: f64) -> Option<f64> {
        self.first(&self.part(0.0, 1.0), HALVINGS, (level, true))
    }

    fn first(&self, part: &Part, halvings: usize, (level, surely): (f64, bool)) -> Option<f64> {
        if part.shifted[0] - part.spread >= level {
            return None;
        }
        if part.shifted[0] + part.spread < level {
            return Some(part.end(-1.0));
        }
        if halvings == 0 || part.is_flat(0.0) {
            let end = part.end(if surely { 1.0 } else { -1.0 });
            return (!surely || self.at(end) < level).then_some(end);
        }
        let mut halves =
            [-0.5, 0.5].map(|sign| self.part(part.end(sign), 0.5 * part.half)).into_iter();
        halves.find_map(|half| self.first(&half, halvings - 1, (level, surely)))
    }

    /// The shares of the range in which the number is surely above zero, and in which it may be.
    pub(super) fn above_zero(&self, allowance: f64) -> [f64; 2] {
        self.share_above(&self.part(0.0, 1.0), HALVINGS - 6, allowance)
    }

    fn share_above(&self, part: &Part, halvings: usize, allowance: f64) -> [f64; 2] {
        let spread = part.spread + allowance;
        let value = part.shifted[0];
        match () {
            () if value - spread > 0.0 => [part.half; 2],
            () if value + spread <= 0.0 => [0.0; 2],
            () if halvings == 0 || part.is_flat(allowance) => [0.0, part.half],
            () => {
                let halves = [-0.5, 0.5].map(|sign| {
                    let half = self.part(part.end(sign), 0.5 * part.half);
                    self.share_above(&half, halvings - 1, allowance)
                });
                [halves[0][0] + halves[1][0], halves[0][1] + halves[1][1]]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(coefficients: &[f64]) -> Course {
        Course { coefficients: coefficients.to_vec(), allowance: 0.0 }
    }

    /// A Chebyshev polynomial of degree 5 is between -1 and 1, and `3 s^2 - 1` between -1 and 2.
    #[test]
    fn ranges_are_close() {
        for (coefficients, right) in [
            (&[0.0, 5.0, 0.0, -20.0, 0.0, 16.0][..], [-1.0, 1.0]),
            (&[-1.0, 0.0, 3.0], [-1.0, 2.0]),
            (&[4.0], [4.0, 4.0]),
        ] {
            let range = plain(coefficients).range();
            assert!(range[0] <= right[0] && right[0] - range[0] < 1e-9, "{range:?}");
            assert!(range[1] >= right[1] && range[1] - right[1] < 1e-9, "{range:?}");
        }
    }

    /// `s^2 - 1/4` is below zero between -1/2 and 1/2.
    #[test]
    fn crossings_are_between_their_bounds() {
        let square = plain(&[-0.25, 0.0, 1.0]);
        let (may, does) = (square.may_fall_below(0.0).unwrap_or(9.0), square.falls_below(0.0));
        let does = does.unwrap_or(9.0);
        assert!(may <= -0.5 && -0.5 < does && does - may < 1e-6, "{may} {does}");
        assert_eq!(square.may_fall_below(-0.3), None);
        assert_eq!(square.falls_below(-0.25), None);
        let [surely, perhaps] = square.above_zero(0.0);
        assert!(surely <= 0.5 && 0.5 <= perhaps && perhaps - surely < 1e-4, "{surely} {perhaps}");
    }

    /// `1 + 2 s + 3 s^2` has the integral 4.
    #[test]
    fn integrals_are_those_of_powers() {
        assert!((plain(&[1.0, 2.0, 3.0]).integral() - 4.0).abs() < 1e-12);
    }

    /// exp(s) on -1 to 1: the rest of order 9 is e/9!, which is 7.5e-6.
    #[test]
    fn the_rest_of_a_series_is_allowed_for() {
        let [middle, whole] = [Taylor::variable(0.0, 0.0), Taylor::variable(-1.0, 1.0)];
        let course = Course::of(&middle.exp(), &whole.exp());
        let course = course.unwrap_or_else(|| panic!("no course"));
        assert!((1e-9..8e-6).contains(&course.allowance), "{}", course.allowance);
        for place in [-1.0, -0.3, 0.5, 1.0] {
            assert!((course.at(place) - f64::exp(place)).abs() <= course.allowance);
        }
    }
}
