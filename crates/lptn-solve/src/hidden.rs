//! What results may do between the points of an interval, bounded by their form: a bell over a
//! temperature may be narrower than any look.
//!
//! A narrow peak without a bend is bounded along the step by Taylor arithmetic.

use lptn_network::Bends;
use lptn_units::Taylor;

use crate::interval::{Interval, NODES, POINTS};

/// The largest product of the distances to all points, on (-1, 1).
const BETWEEN: f64 = 0.05;

/// What may be missed between the points, over the largest value that the step allows.
const MISSED: f64 = 1e-7;

/// A range of numbers ends this share of its width within: an interval is cut where something bends,
/// and what happens there is no part of it.
const WITHIN: f64 = 1e-9;

/// Looks for what hides in the intervals of one step.
pub(crate) struct Hidden<'a> {
    bends: &'a Bends,
    slots: &'a [f64],
    /// The place of the first number that moves among the values of an interval.
    first: usize,
    /// For each result the largest value that the step allows.
    sizes: Option<Vec<f64>>,
}

impl<'a> Hidden<'a> {
    /// `count` curves stand before the quantities of `bends` among the values.
    pub(crate) fn new((bends, slots): (&'a Bends, &'a [f64]), count: usize) -> Self {
        Self { bends, slots, first: count + bends.levels().len(), sizes: None }
    }

    /// By how much what may be missed in an interval is more than what is allowed; 0 where it is
    /// not. The first interval is the whole step. Where nothing is known, nothing is missed.
    pub(crate) fn wanting(&mut self, interval: &Interval) -> f64 {
        if self.bends.moved() == 0 || self.slots.is_empty() {
            return 0.0;
        }
        let moved = (0..self.bends.moved()).map(|k| way(&interval.of(self.first + k)));
        let bounds = self.bends.enclose(&moved.collect::<Vec<_>>(), self.slots);
        let size =
            |bound: &Taylor| bound.range().map_or(f64::INFINITY, |[a, b]| a.abs().max(b.abs()));
        let sizes = self.sizes.get_or_insert_with(|| bounds.iter().map(size).collect());
        let one = |(bound, size): (&Taylor, &f64)| {
            let over = BETWEEN * bound.largest(POINTS) / (MISSED * size);
            if over.is_finite() && over > 1.0 { over } else { 0.0 }
        };
        bounds.iter().zip(&*sizes).map(one).fold(0.0, f64::max)
    }
}

/// A number over an interval, as a polynomial through its points, by a variable from -1 to 1.
fn way(values: &[f64; POINTS]) -> Taylor {
    let coefficients = coefficients(values);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (low, high) = (low.min(*value), high.max(*value));
    }
    let mut terms = [[0.0; 2]; POINTS];
    for (k, term) in terms.iter_mut().enumerate() {
        let (mut rest, mut binomial) = (0.0, 1.0);
        for (m, coefficient) in coefficients.iter().enumerate().skip(k + 1) {
            binomial *= m as f64 / (m - k) as f64;
            rest += binomial * coefficient.abs();
        }
        *term = [coefficients[k] - rest, coefficients[k] + rest];
    }
    let goes_one_way = values.is_sorted() || values.iter().rev().is_sorted();
    let (width, most) = (high - low, terms[0][1] - terms[0][0]);
    terms[0] = match goes_one_way && width <= most {
        true => [low + WITHIN * width, high - WITHIN * width],
        false => terms[0],
    };
    Taylor::between(&terms)
}

/// The coefficients of the polynomial through the points of an interval, by a variable from -1 to 1:
/// Newton's differences, multiplied out.
fn coefficients(values: &[f64; POINTS]) -> [f64; POINTS] {
    let mut differences = *values;
    for order in 1..POINTS {
        for k in (order..POINTS).rev() {
            differences[k] = (differences[k] - differences[k - 1]) / (NODES[k] - NODES[k - order]);
        }
    }
    let mut found = [0.0; POINTS];
    for k in (0..POINTS).rev() {
        for place in (1..POINTS).rev() {
            found[place] = found[place - 1] - NODES[k] * found[place];
        }
        found[0] = differences[k] - NODES[k] * found[0];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{NODES, coefficients, way};

    #[test]
    fn a_polynomial_has_its_coefficients() {
        let exact = [3.0, -1.0, 0.5, 2.0, -0.25, 1.5, -4.0];
        let values = NODES.map(|x| exact.iter().rev().fold(0.0, |sum, a| sum * x + a));
        for (found, exact) in coefficients(&values).iter().zip(exact) {
            assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        }
        let bounds = way(&values);
        assert!((bounds.largest(6) - 4.0).abs() < 1e-12 && bounds.largest(7) == 0.0);
    }
}
