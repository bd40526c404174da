//! `exp(Z)` and the responses to Legendre polynomials for a matrix of small norm, by power series.
//!
//! The effect of a constant input is `phi_1(Z) = sum Z^j / (j + 1)!`. That of `P_n(x)`, x from -1
//! to 1 over a panel, is its sibling
//!
//! `W_n(Z) = 1/2 int exp(Z (1 - x) / 2) P_n(x) dx = sum_j (-1)^n j! / ((j - n)! (j + n + 1)!) Z^j`
//!
//! from `int_0^1 s^j P_n(2 s - 1) ds = j!^2 / ((j - n)! (j + n + 1)!)` (Rodrigues' formula and the
//! beta integral), zero for j < n. `W_0` is `phi_1` and `W_1` is `2 phi_2 - phi_1` (phi functions:
//! Hochbruck and Ostermann, Acta Numerica 19 (2010) 209, section 2); of a number -2a it is `exp(-a)
//! i_n(a)`, the response of a mode.

use faer::{Mat, MatRef};
use lptn_integrate::dense;

use super::legendre::TERMS;

/// The largest norm of a matrix that the series are for.
pub(crate) const SMALL: f64 = 1.0 / 16.0;

/// The last power: the omitted terms are 4e-19 of the first power.
const POWERS: usize = 10;

/// `exp(Z) R`
pub(crate) fn exponential(z: MatRef<'_, f64>, r: Mat<f64>) -> Mat<f64> {
    let mut weights = vec![1.0];
    for j in 1..=POWERS {
        weights.push(weights[j - 1] / j as f64);
    }
    weighted(z, r, &weights)
}

/// `W_n(Z) R`
pub(crate) fn answer(z: MatRef<'_, f64>, r: Mat<f64>, n: usize) -> Mat<f64> {
    debug_assert!(n < TERMS, "a series of {TERMS} terms");
    let mut weights = vec![0.0; n];
    // n! / (2n + 1)!
    weights.push((n + 1..=2 * n + 1).map(|k| 1.0 / k as f64).product());
    weights[n] *= if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    for j in n..n + POWERS {
        let ratio = (j + 1) as f64 / ((j + 1 - n) as f64 * (j + n + 2) as f64);
        weights.push(weights[j] * ratio);
    }
    weighted(z, r, &weights)
}

/// The sum of `Z^j R` with these weights.
fn weighted(z: MatRef<'_, f64>, r: Mat<f64>, weights: &[f64]) -> Mat<f64> {
    let mut power = r;
    let mut sum = Mat::zeros(power.nrows(), power.ncols());
    for (j, weight) in weights.iter().enumerate() {
        if j > 0 {
            power = dense::product(z, power.as_ref());
        }
        add(&mut sum, *weight, power.as_ref());
    }
    sum
}

/// `sum += weight * of`
pub(crate) fn add(sum: &mut Mat<f64>, weight: f64, of: MatRef<'_, f64>) {
    for j in 0..of.ncols() {
        for i in 0..of.nrows() {
            sum[(i, j)] += weight * of[(i, j)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_of_a_number_are_those_of_a_mode() {
        let z = Mat::from_fn(1, 1, |_, _| -SMALL);
        let mut expected = [0.0; TERMS];
        super::super::legendre::responses(0.5 * SMALL, &mut expected);
        for (n, expected) in expected.into_iter().enumerate() {
            let found = answer(z.as_ref(), Mat::identity(1, 1), n)[(0, 0)];
            assert!((found - expected).abs() <= 1e-15 * expected, "{n}: {found} {expected}");
        }
        let found = exponential(z.as_ref(), Mat::identity(1, 1))[(0, 0)];
        assert!((found - (-SMALL).exp()).abs() < 2e-16, "{found}");
    }
}
