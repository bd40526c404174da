//! What rows of a planned record tell of the unknowns.

/// A pivot or an eigenvalue below this part of the largest counts as 0: derivatives are as accurate
/// as its root.
const NOTHING: f64 = 1e-12;

/// What least squares makes of some rows: with derivatives `x` over the standard deviation of a
/// value, the sum of `x x^T` (Fisher's information, where values are independent) and that of
/// `x Omega x^T` with their correlation Omega. The covariance of a fit is
/// `bread^-1 middle bread^-1`. Both add up over rows, sensors and runs.
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

    /// What is known of one unknown beforehand, to this standard deviation.
    pub(super) fn add_prior(&mut self, unknown: usize, deviation: f64) {
        let at = unknown * self.count + unknown;
        self.bread[at] += deviation.powi(-2);
        self.middle[at] += deviation.powi(-2);
    }

    /// So many equal rows, in units of the error that their mean has.
    pub(crate) fn add_row(&mut self, x: &[f64], times: f64) {
        for (i, a) in x.iter().enumerate() {
            for (j, b) in x.iter().enumerate() {
                self.bread[i * self.count + j] += times * a * b;
                self.middle[i * self.count + j] += times * a * b;
            }
        }
    }

    /// Without the last unknowns, which are sought too but concern nothing else: least squares of
    /// the first `count` alone tells the same. Those that nothing is known of are not there.
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

    /// The covariance of what a fit finds.
    pub(crate) fn covariance(&self) -> Covariance {
        let n = self.count;
        let (inverse, unknown) = inverse(&self.bread, n);
        let half = product(&inverse, &self.middle, n);
        Covariance { count: n, values: product(&half, &inverse, n), inverse, unknown }
    }

    /// The standard errors of a fit; infinite where one is not determined.
    pub(super) fn errors(&self) -> Vec<f64> {
        let covariance = self.covariance();
        (0..self.count).map(|i| covariance.error(i)).collect()
    }
}

/// The covariance of what a fit finds, and what it does not find.
#[derive(Clone, Debug)]
pub(crate) struct Covariance {
    count: usize,
    values: Vec<f64>,
    /// Of the information, where it has one.
    pub(super) inverse: Vec<f64>,
    /// Unknowns that are not determined.
    unknown: Vec<bool>,
}

impl Covariance {
    pub(super) fn error(&self, i: usize) -> f64 {
        if self.unknown[i] {
            return f64::INFINITY;
        }
        self.values[i * self.count + i].max(0.0).sqrt()
    }

    /// By how much an unknown moves where so much is pulled at all of them, the sum of `x r` over
    /// rows that change by r; `None` where it is not determined.
    pub(crate) fn moved(&self, i: usize, pull: &[f64]) -> Option<f64> {
        let n = self.count;
        let by = (0..n).map(|k| self.inverse[i * n + k] * pull[k]).sum();
        (!self.unknown[i]).then_some(by)
    }

    /// The part of the variance of one unknown that comes from what `known` says of another
    /// beforehand. The fit moves by `w` for each unit that the value known beforehand moves, with
    /// `w = A^-1 Lambda` of its information Lambda, and the covariance of that value with the fitted
    /// one is `A^-1`: of correlated ones a share is this product (J. W. Pratt, Proc. 2nd Int. Tampere
    /// Conf. Statistics (1987) 245), of one alone `(A^-1 / deviation)^2`.
    pub(super) fn share(&self, i: usize, (of, known): (usize, &Information)) -> f64 {
        let n = self.count;
        let weight: f64 = (0..n).map(|k| self.inverse[i * n + k] * known.bread[k * n + of]).sum();
        weight * self.inverse[i * n + of] / self.values[i * n + i]
    }
}

/// The inverse of a symmetric matrix that is not negative, and which of its unknowns are not
/// determined: of them it says nothing.
fn inverse(a: &[f64], n: usize) -> (Vec<f64>, Vec<bool>) {
    let scale: Vec<f64> = (0..n).map(|i| a[i * n + i].max(0.0).sqrt()).collect();
    let felt: Vec<usize> = (0..n).filter(|&i| scale[i] > 0.0).collect();
    let m = felt.len();
    let of = |at: usize| {
        let (i, j) = (felt[at / m], felt[at % m]);
        a[i * n + j] / (scale[i] * scale[j])
    };
    let scaled: Vec<f64> = (0..m * m).map(of).collect();
    let (found, missing) = match by_cholesky(&scaled, m) {
        Some(found) => (found, vec![false; m]),
        None => by_eigenvalues(&scaled, m),
    };
    let (mut whole, mut unknown) = (vec![0.0; n * n], vec![true; n]);
    for (k, &i) in felt.iter().enumerate() {
        unknown[i] = missing[k];
        for (l, &j) in felt.iter().enumerate() {
            whole[i * n + j] = found[k * m + l] / (scale[i] * scale[j]);
        }
    }
    (whole, unknown)
}

/// The inverse of a matrix with ones in its diagonal; `None` where it is close to singular.
fn by_cholesky(a: &[f64], n: usize) -> Option<Vec<f64>> {
    /// Below this pivot eigenvalues have to tell.
    const SMALL: f64 = 1e-9;
    let mut lower = vec![0.0; n * n];
    for j in 0..n {
        for i in j..n {
            let dot: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
            let rest = a[i * n + j] - dot;
            lower[i * n + j] = match i == j {
                true if rest > SMALL => rest.sqrt(),
                true => return None,
                false => rest / lower[j * n + j],
            };
        }
    }
    // the inverse of the factor, column by column
    let mut back = vec![0.0; n * n];
    for j in 0..n {
        for i in j..n {
            let one = f64::from(u8::from(i == j));
            let dot: f64 = (j..i).map(|k| lower[i * n + k] * back[k * n + j]).sum();
            back[i * n + j] = (one - dot) / lower[i * n + i];
        }
    }
    let entry = |at: usize| {
        let (i, j) = (at / n, at % n);
        (i.max(j)..n).map(|k| back[k * n + i] * back[k * n + j]).sum()
    };
    Some((0..n * n).map(entry).collect())
}

/// The inverse on what is determined, and which unknowns take part in what is not.
fn by_eigenvalues(a: &[f64], n: usize) -> (Vec<f64>, Vec<bool>) {
    /// An unknown takes part in an undetermined direction if its share of it is larger than this.
    const SHARE: f64 = 1e-4;
    let matrix = faer::MatRef::from_row_major_slice(a, n, n);
    let Some((values, vectors)) = lptn_integrate::dense::symmetric_eigen(matrix) else {
        return (vec![0.0; n * n], vec![true; n]);
    };
    let most = values.last().copied().unwrap_or(0.0);
    let known: Vec<bool> = values.iter().map(|value| *value > NOTHING * most).collect();
    let entry = |at: usize| {
        let parts = (0..n).filter(|&k| known[k]);
        parts.map(|k| vectors[(at / n, k)] * vectors[(at % n, k)] / values[k]).sum()
    };
    let lost = |i: usize| (0..n).any(|k| !known[k] && vectors[(i, k)].abs() > SHARE);
    ((0..n * n).map(entry).collect(), (0..n).map(lost).collect())
}

fn product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let entry = |at: usize| (0..n).map(|k| a[at / n * n + k] * b[k * n + at % n]).sum();
    (0..n * n).map(entry).collect()
}

/// Noise with a white part and one that is kept from row to row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Noise {
    /// The correlated part of the variance, and what is left of it after one row.
    pub(super) correlated: f64,
    pub(super) decay: f64,
    /// Its variance over that by which values are weighed.
    pub(super) variance: f64,
}

/// Adds up row after row of one sensor.
#[derive(Clone, Debug)]
pub(super) struct RowSum {
    pub(super) sum: Information,
    noise: Noise,
    /// What the rows before still say of the next.
    before: Vec<f64>,
}

impl RowSum {
    pub(super) fn new(count: usize, noise: Noise) -> Self {
        Self { sum: Information::none(count), noise, before: vec![0.0; count] }
    }

    pub(super) fn add(&mut self, x: &[f64]) {
        let (n, noise) = (self.sum.count, self.noise);
        for (i, a) in x.iter().enumerate() {
            for (j, b) in x.iter().enumerate() {
                let at = i * n + j;
                let tied = noise.correlated * (a * self.before[j] + self.before[i] * b);
                self.sum.bread[at] += a * b;
                self.sum.middle[at] += noise.variance * (a * b + tied);
            }
        }
        if noise.correlated > 0.0 {
            self.before.iter_mut().zip(x).for_each(|(b, x)| *b = noise.decay * (*b + x));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: Noise = Noise { correlated: 0.0, decay: 0.0, variance: 1.0 };

    fn line(rows: usize) -> Information {
        let mut sum = RowSum::new(2, WHITE);
        (0..rows).for_each(|k| sum.add(&[1.0, k as f64]));
        sum.sum
    }

    /// Of a straight line through n values of variance 1 the slope has 12 / (n (n^2 - 1)).
    #[test]
    fn analytic_slope_of_a_straight_line() {
        let errors = line(10).errors();
        assert!((errors[1].powi(2) - 12.0 / 990.0).abs() < 1e-15);
        assert!((errors[0].powi(2) - 2.0 * 19.0 / 110.0).abs() < 1e-14);
        // an unknown that is left out is one that was fitted
        let mut turned = RowSum::new(2, WHITE);
        (0..10).for_each(|k| turned.add(&[f64::from(k), 1.0]));
        let alone = turned.sum.without_last(1).errors();
        assert!((alone[0] - errors[1]).abs() < 1e-15);
    }

    /// The mean of two values with the correlation 0.36 has the variance (1 + 0.36) / 2.
    #[test]
    fn analytic_mean_of_correlated_values() {
        let mut rows = RowSum::new(1, Noise { correlated: 0.6, decay: 0.6, variance: 1.0 });
        rows.add(&[1.0]);
        rows.add(&[1.0]);
        assert!((rows.sum.errors()[0].powi(2) - 0.68).abs() < 1e-15);
    }

    #[test]
    fn what_is_not_determined_has_no_error_and_hides_no_other() {
        let mut rows = RowSum::new(4, WHITE);
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
        let mut rows = RowSum::new(2, WHITE);
        (0..4).for_each(|_| rows.add(&[1.0, 1.0]));
        rows.sum.add_prior(1, 1.0);
        let covariance = rows.sum.covariance();
        let mut known = Information::none(2);
        known.add_prior(1, 1.0);
        assert!((covariance.error(0).powi(2) - 1.25).abs() < 1e-12);
        assert!((covariance.share(0, (1, &known)) - 0.8).abs() < 1e-12);
    }
}
