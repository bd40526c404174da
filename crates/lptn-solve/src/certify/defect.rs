//! The defect of a way: the heat that would have to enter a node in addition to that of the
//! network, so that the way were its temperature.

use lptn_units::Taylor;

/// Parts of a step in which a defect is bounded one by one.
const PARTS: usize = 16;

/// Most coefficients of a polynomial.
const MOST: usize = 16;

/// A bound on the absolute value of a function over a step, from its Taylor coefficients in the
/// middle and bounds on them over the whole step.
///
/// Taylor's theorem: the coefficients below an order in the middle, and that of this order
/// somewhere in the step. The order is the one whose rest is smallest.
pub(super) fn largest(middle: &Taylor, whole: &Taylor) -> f64 {
    let rest = |order: usize| {
        let [low, high] = whole.term(order);
        low.abs().max(high.abs())
    };
    let orders = (0..=Taylor::ORDER).filter(|k| rest(*k).is_finite());
    let Some(order) = orders.min_by(|a, b| rest(*a).total_cmp(&rest(*b))) else {
        return f64::INFINITY;
    };
    let mut coefficients = [0.0; Taylor::ORDER];
    let mut spread = 0.0;
    for (k, c) in coefficients.iter_mut().enumerate().take(order) {
        let [low, high] = middle.term(k);
        *c = 0.5 * (low + high);
        spread += 0.5 * (high - low);
    }
    largest_of(&coefficients[..order]) + spread + rest(order)
}

/// The largest absolute value of a polynomial between -1 and 1, or a little more: in each part the
/// sum of the absolute values of its terms about the middle of that part.
pub(super) fn largest_of(coefficients: &[f64]) -> f64 {
    let half = (PARTS as f64).recip();
    let part = |i: usize| {
        let centre = (2 * i + 1) as f64 * half - 1.0;
        let mut shifted = [0.0; MOST];
        for (k, c) in coefficients.iter().enumerate().rev() {
            // Horner's rule: shifted * (centre + x) + c
            for j in (1..coefficients.len() - k).rev() {
                shifted[j] = shifted[j] * centre + shifted[j - 1];
            }
            shifted[0] = shifted[0] * centre + c;
        }
        shifted.iter().rev().fold(0.0, |sum, c| sum * half + c.abs())
    };
    (0..PARTS).map(part).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Chebyshev polynomial of degree 5 reaches 1 six times.
    #[test]
    fn a_polynomial_is_bounded_closely() {
        let chebyshev = [0.0, 5.0, 0.0, -20.0, 0.0, 16.0];
        let bound = largest_of(&chebyshev);
        assert!((1.0..2.0).contains(&bound), "{bound}");
        let middle = Taylor::between(&chebyshev.map(|c| [c, c]));
        let nothing = Taylor::constant(0.0);
        assert!(largest(&middle, &(middle * nothing)) < 1e-300);
        let whole = Taylor::between(&[[-99.0, 99.0]; 6]);
        assert!((largest(&middle, &whole) - bound).abs() < 1e-12);
    }

    /// exp(s) on -1 to 1: at most e, and the rest of order 9 is e/9!.
    #[test]
    fn the_rest_of_a_series_is_counted() {
        let middle = Taylor::variable(0.0, 0.0).exp();
        let whole = Taylor::variable(-1.0, 1.0).exp();
        let bound = largest(&middle, &whole);
        assert!((1f64.exp()..1.1 * 1f64.exp()).contains(&bound), "{bound}");
    }
}
