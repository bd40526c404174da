//! Information in rows of a planned record about the unknowns.

use faer::{Mat, MatRef};
use lptn_integrate::dense;

use crate::Covariance;
use crate::noise::Tied;

/// A pivot or an eigenvalue below this part of the largest counts as 0: derivatives are as accurate
/// as its root.
const NOTHING: f64 = 1e-12;

/// Sums of least squares over some rows. With derivatives `x` over the standard deviation of a
/// value, they are the sum of `x x^T` (Fisher's information, if values are independent) and that of
/// `x Omega x^T` with their correlation Omega. The covariance of a fit is `bread^-1 middle
/// bread^-1`. Both add up over rows, sensors and runs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Information {
    pub(super) count: usize,
    /// Row by row, `count` squared.
    pub(super) bread: Vec<f64>,
    pub(super) middle: Vec<f64>,
}

impl Information {
    pub(crate) fn none(count: usize) -> Self {
        Self { count, bread: vec![0.0; count * count], middle: vec![0.0; count * count] }
    }

    pub(super) fn add(&mut self, other: &Self) {
        let sum = |to: &mut Vec<f64>, of: &[f64]| to.iter_mut().zip(of).for_each(|(a, b)| *a += b);
        sum(&mut self.bread, &other.bread);
        sum(&mut self.middle, &other.middle);
    }

    /// Adds prior knowledge of one unknown, to this standard deviation.
    pub(super) fn add_prior(&mut self, unknown: usize, deviation: f64) {
        let at = unknown * self.count + unknown;
        self.bread[at] += deviation.powi(-2);
        self.middle[at] += deviation.powi(-2);
    }

    /// Adds a row several times, in units of the error that their mean has.
    pub(crate) fn add_row(&mut self, x: &[f64], times: f64) {
        add_product(&mut self.bread, x, times);
        add_product(&mut self.middle, x, times);
    }

    /// Eliminates the last unknowns, which are estimated too but concern nothing else. Least
    /// squares of the first `count` alone gives the same. Unknowns without information are dropped.
    pub(super) fn without_last(&self, count: usize) -> Self {
        let mut left = self.clone();
        while left.count > count {
            left = left.without_one();
        }
        left
    }

    fn without_one(&self) -> Self {
        let (all, last) = (self.count, self.count - 1);
        let own = self.bread[last * all + last];
        let share = |i: usize| if own > 0.0 { self.bread[i * all + last] / own } else { 0.0 };
        let mut left = Self::none(last);
        for i in 0..last {
            for j in 0..last {
                let (a, b, at) = (share(i), share(j), i * all + j);
                let m = |i: usize, j: usize| self.middle[i * all + j];
                left.bread[i * last + j] = self.bread[at] - a * self.bread[last * all + j];
                left.middle[i * last + j] =
                    m(i, j) - a * m(last, j) - b * m(i, last) + a * b * m(last, last);
            }
        }
        left
    }

    /// The covariance of the fitted values.
    pub(crate) fn covariance(&self) -> Found {
        let (inverse, unknown) = inverse(&self.bread, self.count);
        Found { covariance: inverse.sandwich(&self.middle), inverse, unknown }
    }

    /// The standard errors of a fit; infinite if one is not determined.
    pub(super) fn errors(&self) -> Vec<f64> {
        let covariance = self.covariance();
        (0..self.count).map(|i| covariance.error(i)).collect()
    }
}

/// The covariance of the fitted values, and the unknowns that are not determined.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    covariance: Covariance,
    /// Inverse of the information, if it has one.
    inverse: Covariance,
    /// Unknowns that are not determined.
    unknown: Vec<bool>,
}

impl Found {
    pub(super) fn error(&self, i: usize) -> f64 {
        if self.unknown[i] {
            return f64::INFINITY;
        }
        at(&self.covariance, i, i).max(0.0).sqrt()
    }

    /// Movement of an unknown by a pull at all of them, the sum of `x r` over rows that change by
    /// r; `None` if it is not determined.
    pub(crate) fn moved(&self, i: usize, pull: &[f64]) -> Option<f64> {
        let by = (0..pull.len()).map(|k| at(&self.inverse, i, k) * pull[k]).sum();
        (!self.unknown[i]).then_some(by)
    }

    /// The part of the variance of one unknown that comes from the prior `known` of another. The
    /// fit moves by `w` for each unit that the prior value moves, with `w = A^-1 Lambda` of its
    /// information Lambda. The covariance of that value with the fitted one is `A^-1`. A share of
    /// correlated ones is this product (J. W. Pratt, Proc. 2nd Int. Tampere Conf. Statistics (1987)
    /// 245), of one alone `(A^-1 / deviation)^2`.
    pub(super) fn share(&self, i: usize, (of, known): (usize, &Information)) -> f64 {
        let n = known.count;
        let weight: f64 = (0..n).map(|k| at(&self.inverse, i, k) * known.bread[k * n + of]).sum();
        weight * at(&self.inverse, i, of) / at(&self.covariance, i, i)
    }
}

fn at(covariance: &Covariance, i: usize, j: usize) -> f64 {
    covariance.values[i * covariance.parameters.len() + j]
}

/// The inverse of a symmetric matrix that is not negative, and its unknowns that are not
/// determined, for which the inverse has no meaning.
fn inverse(a: &[f64], n: usize) -> (Covariance, Vec<bool>) {
    let scale: Vec<f64> = (0..n).map(|i| a[i * n + i].max(0.0).sqrt()).collect();
    let felt: Vec<usize> = (0..n).filter(|&i| scale[i] > 0.0).collect();
    let of = |i: usize, j: usize| a[i * n + j] / (scale[i] * scale[j]);
    let scaled = Mat::from_fn(felt.len(), felt.len(), |k, l| of(felt[k], felt[l]));
    let (found, missing) = match by_cholesky(scaled.as_ref()) {
        Some(found) => (found, vec![false; felt.len()]),
        None => by_eigenvalues(scaled.as_ref()),
    };
    let (mut values, mut unknown) = (vec![0.0; n * n], vec![true; n]);
    for (k, &i) in felt.iter().enumerate() {
        unknown[i] = missing[k];
        for (l, &j) in felt.iter().enumerate() {
            values[i * n + j] = found[(k, l)] / (scale[i] * scale[j]);
        }
    }
    (Covariance { parameters: (0..n).collect(), values }, unknown)
}

/// The inverse of a matrix with ones in its diagonal; `None` if it is close to singular.
fn by_cholesky(a: MatRef<'_, f64>) -> Option<Mat<f64>> {
    /// If the square of a root is below this, eigenvalues decide.
    const SMALL: f64 = 1e-9;
    let roots = dense::cholesky_diagonal(a)?;
    let one = Mat::identity(a.nrows(), a.nrows());
    let regular = roots.iter().all(|root| root * root > SMALL);
    regular.then(|| dense::cholesky_solve(a, one.as_ref()))?
}

/// The inverse on the determined directions, and the unknowns that take part in the others.
fn by_eigenvalues(a: MatRef<'_, f64>) -> (Mat<f64>, Vec<bool>) {
    /// An unknown takes part in an undetermined direction if its share of it is larger than this.
    const SHARE: f64 = 1e-4;
    let n = a.nrows();
    let Some((values, vectors)) = dense::symmetric_eigen(a) else {
        return (Mat::zeros(n, n), vec![true; n]);
    };
    let most = values.last().copied().unwrap_or(0.0);
    let known: Vec<bool> = values.iter().map(|value| *value > NOTHING * most).collect();
    let entry = |i: usize, j: usize| {
        let parts = (0..n).filter(|&k| known[k]);
        parts.map(|k| vectors[(i, k)] * vectors[(j, k)] / values[k]).sum()
    };
    let lost = |i: usize| (0..n).any(|k| !known[k] && vectors[(i, k)].abs() > SHARE);
    (Mat::from_fn(n, n, entry), (0..n).map(lost).collect())
}

/// Adds up row after row of one sensor.
#[derive(Clone, Debug)]
pub(super) struct RowSum {
    pub(super) sum: Information,
    tied: Tied,
    /// The share of the correlated part of the variance that is left after one row.
    decay: f64,
    /// The variance of the noise over that of the weight of the values.
    variance: f64,
}

impl RowSum {
    /// The sum before the first row, for noise with this `correlated` part of its variance.
    pub(super) fn new(count: usize, (correlated, decay): (f64, f64), variance: f64) -> Self {
        let (sum, tied) = (Information::none(count), Tied::new(count, correlated));
        Self { sum, tied, decay, variance }
    }

    pub(super) fn add(&mut self, x: &[f64]) {
        add_product(&mut self.sum.bread, x, 1.0);
        self.tied.add(x, self.variance, &mut self.sum.middle);
        self.tied.pass(x, self.decay);
    }
}

/// Adds `times x x^T` to a matrix, row by row.
fn add_product(sum: &mut [f64], x: &[f64], times: f64) {
    for (row, a) in sum.chunks_exact_mut(x.len().max(1)).zip(x) {
        row.iter_mut().zip(x).for_each(|(sum, b)| *sum += times * a * b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: (f64, f64) = (0.0, 0.0);

    fn line(rows: usize) -> Information {
        let mut sum = RowSum::new(2, WHITE, 1.0);
        (0..rows).for_each(|k| sum.add(&[1.0, k as f64]));
        sum.sum
    }

    /// The slope of a straight line through n values of variance 1 has 12 / (n (n^2 - 1)).
    #[test]
    fn analytic_slope_of_a_straight_line() {
        let errors = line(10).errors();
        assert!((errors[1].powi(2) - 12.0 / 990.0).abs() < 1e-15);
        assert!((errors[0].powi(2) - 2.0 * 19.0 / 110.0).abs() < 1e-14);
        // an unknown that is eliminated counts as fitted
        let mut turned = RowSum::new(2, WHITE, 1.0);
        (0..10).for_each(|k| turned.add(&[f64::from(k), 1.0]));
        let alone = turned.sum.without_last(1).errors();
        assert!((alone[0] - errors[1]).abs() < 1e-15);
    }

    /// The mean of two values with the correlation 0.36 has the variance (1 + 0.36) / 2.
    #[test]
    fn analytic_mean_of_correlated_values() {
        let mut rows = RowSum::new(1, (0.6, 0.6), 1.0);
        rows.add(&[1.0]);
        rows.add(&[1.0]);
        assert!((rows.sum.errors()[0].powi(2) - 0.68).abs() < 1e-15);
    }

    #[test]
    fn what_is_not_determined_has_no_error_and_hides_no_other() {
        let mut rows = RowSum::new(4, WHITE, 1.0);
        // the first two as their sum only, nothing of the last
        (0..5).for_each(|k| rows.add(&[1.0, 1.0, f64::from(k), 0.0]));
        let errors = rows.sum.errors();
        assert!(errors[0].is_infinite() && errors[1].is_infinite() && errors[3].is_infinite());
        assert!((errors[2].powi(2) - 0.1).abs() < 1e-12, "{errors:?}");
        rows.sum.add_prior(0, 0.5);
        assert!((rows.sum.errors()[0] - 0.5).abs() < 1e-6);
    }

    #[test]
    fn the_share_of_what_is_known_beforehand() {
        // 4 values of an unknown plus an offset of 0 ± 1: variance 1/4 + 1
        let mut rows = RowSum::new(2, WHITE, 1.0);
        (0..4).for_each(|_| rows.add(&[1.0, 1.0]));
        rows.sum.add_prior(1, 1.0);
        let covariance = rows.sum.covariance();
        let mut known = Information::none(2);
        known.add_prior(1, 1.0);
        assert!((covariance.error(0).powi(2) - 1.25).abs() < 1e-12);
        assert!((covariance.share(0, (1, &known)) - 0.8).abs() < 1e-12);
    }
}
