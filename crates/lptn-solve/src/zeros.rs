//! Zeros of the polynomial through the points of an interval.

use crate::interval::{NODES, POINTS};

/// Halvings of a part in which the polynomial is monotone: to the rounding of its length.
const HALVINGS: usize = 60;

/// The share of an interval, from 0 to 1, in which the polynomial through these values at its
/// points is above zero.
///
/// Between two neighbouring zeros of its derivative a polynomial is monotone, so that it has one
/// zero there at most: none is missed, however close it is to the next.
pub(crate) fn share_above(values: &[f64; POINTS]) -> f64 {
    let polynomial = coefficients(values);
    let mut edges = vec![-1.0];
    edges.extend(zeros(&polynomial));
    edges.push(1.0);
    let above = |part: &&[f64]| value(&polynomial, part[0].midpoint(part[1])) > 0.0;
    0.5 * edges.windows(2).filter(above).map(|part| part[1] - part[0]).sum::<f64>()
}

/// Coefficients of the polynomial through values at the points on (-1, 1), by Newton's divided
/// differences; the constant one first.
pub(crate) fn coefficients(values: &[f64; POINTS]) -> [f64; POINTS] {
    let mut differences = *values;
    for order in 1..POINTS {
        for i in (order..POINTS).rev() {
            differences[i] = (differences[i] - differences[i - 1]) / (NODES[i] - NODES[i - order]);
        }
    }
    let mut found = [0.0; POINTS];
    for (node, difference) in NODES.iter().zip(&differences).rev() {
        // times (x - node), and the difference on top
        for power in (1..POINTS).rev() {
            found[power] = found[power - 1] - node * found[power];
        }
        found[0] = difference - node * found[0];
    }
    found
}

fn value(polynomial: &[f64], x: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// The zeros inside (-1, 1) at which it changes its sign, ascending.
fn zeros(polynomial: &[f64]) -> Vec<f64> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let powers = (1..).map(f64::from);
    let derivative: Vec<f64> = polynomial[1..].iter().zip(powers).map(|(c, n)| c * n).collect();
    let mut edges = vec![-1.0];
    edges.extend(zeros(&derivative));
    edges.push(1.0);
    let passes =
        |part: &[f64]| (value(polynomial, part[0]) > 0.0) != (value(polynomial, part[1]) > 0.0);
    edges.windows(2).filter(|part| passes(part)).map(|part| zero(polynomial, part)).collect()
}

/// The zero of a part at whose ends the signs differ.
fn zero(polynomial: &[f64], part: &[f64]) -> f64 {
    let (mut from, mut to) = (part[0], part[1]);
    let above = value(polynomial, from) > 0.0;
    for _ in 0..HALVINGS {
        let middle = from.midpoint(to);
        match (value(polynomial, middle) > 0.0) == above {
            true => from = middle,
            false => to = middle,
        }
    }
    to
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "numbers that are given")]

    use super::*;

    fn share(curve: impl Fn(f64) -> f64) -> f64 {
        share_above(&NODES.map(curve))
    }

    #[test]
    fn polynomials_are_above_zero_between_their_zeros() {
        for at in [-1.0, -0.31, 0.0, 0.77] {
            assert!((share(|x| x - at) - 0.5 * (1.0 - at)).abs() < 1e-14, "{at}");
        }
        // a hump far narrower than the distance of the points
        for half in [0.3, 1e-2, 1e-4] {
            let found = share(|x| half * half - (x - 0.123) * (x - 0.123));
            assert!((found - half).abs() < 1e-9, "{half}: {found}");
        }
        // (x + 0.9)(x + 0.5)(x + 0.2)(x - 0.1)(x - 0.6)(x - 0.8): above outside and in every other gap
        let six = |x: f64| (x + 0.9) * (x + 0.5) * (x + 0.2) * (x - 0.1) * (x - 0.6) * (x - 0.8);
        assert!((share(six) - 0.5 * (0.1 + 0.3 + 0.5 + 0.2)).abs() < 1e-12, "{}", share(six));
        assert!((share(|x| -six(x)) - 1.0 + share(six)).abs() < 1e-12);
    }

    #[test]
    fn a_polynomial_has_its_coefficients() {
        let exact = [3.0, -1.0, 0.5, 2.0, -0.25, 1.5, -4.0];
        let values = NODES.map(|x| exact.iter().rev().fold(0.0, |sum, a| sum * x + a));
        for (found, exact) in coefficients(&values).iter().zip(exact) {
            assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        }
    }

    #[test]
    fn what_does_not_pass_zero_is_on_one_side() {
        assert!((share(|_| 3.0) - 1.0).abs() < 1e-15 && share(|_| -3.0).abs() < 1e-15);
        assert!(share(|_| 0.0).abs() < 1e-15 && share(|x| -x * x - 1e-3).abs() < 1e-15);
    }
}

#[cfg(test)]
mod edge_tests;
