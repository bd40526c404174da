//! Errors of numbers that follow from a least-squares fit.
//!
//! The bars in pictures of `lptn fit law` are one standard error, the `_sd` columns of its files.
//! Only the bands of fitted laws are 95 % intervals. Student's t with one degree of freedom would
//! make bars of ten times the scatter.

use lptn_integrate::vectors::dot;
use lptn_units::statistics::{student_95, two_sided};

use crate::Covariance;

/// A number with its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Its value in SI units.
    pub value: f64,
    /// Its standard error: from the scatter of all points alike, and at least that of the known
    /// errors of the points. NaN if no point is left over to estimate it.
    pub standard_error: f64,
    /// Half the width of its 95 % interval: the wider of Student's t times the standard error and
    /// the interval that lets every point scatter in its own way.
    pub half_width: f64,
    /// Probability that chance alone makes it as far from 0: below 5 % if the interval excludes 0.
    pub probability: f64,
}

/// A point with a larger share in its own value than this has no information on scatter.
const ALONE: f64 = 1.0 - 1e-9;

/// Scatter of a fit, for numbers that follow from its coefficients: one entry a point, each over
/// the scale of the point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scatter {
    /// Derivatives of the model by the coefficients.
    rows: Vec<Vec<f64>>,
    /// Change of each coefficient with the point.
    follows: Vec<Vec<f64>>,
    /// Residuals of the model.
    misses: Vec<f64>,
    /// The standard error as far as it is known in advance, or 0.
    known: Vec<f64>,
}

impl Scatter {
    /// About coefficients with `inverse = (J^T J)^-1`, J from the `rows`.
    pub(crate) fn new(
        rows: Vec<Vec<f64>>,
        inverse: &Covariance,
        misses: Vec<f64>,
        known: Vec<f64>,
    ) -> Self {
        let count = inverse.parameters.len();
        let at = |row: &[f64], j: usize| dot(&inverse.values[j * count..], row);
        let follows = rows.iter().map(|row| (0..count).map(|j| at(row, j)).collect()).collect();
        Self { rows, follows, misses, known }
    }

    /// Fits a model that is linear in its coefficients to `values` with equal weights, and returns
    /// the coefficients too. `None` if the rows do not determine them.
    pub(crate) fn linear(
        rows: Vec<Vec<f64>>,
        values: &[f64],
        known: Vec<f64>,
    ) -> Option<(Self, Vec<f64>)> {
        let count = rows.first()?.len();
        let columns = (0..count).flat_map(|j| rows.iter().map(move |row| row[j]));
        let jacobian: Vec<f64> = columns.collect();
        let all: Vec<usize> = (0..count).collect();
        let inverse = Covariance::inverse(&jacobian, rows.len(), &all)?;
        let mut found = Self::new(rows, &inverse, Vec::new(), known);
        let of = |j: usize| found.follows.iter().zip(values).map(|(f, y)| f[j] * y).sum();
        let coefficients: Vec<f64> = all.into_iter().map(of).collect();
        let miss = |(row, y): (&Vec<f64>, &f64)| dot(row, &coefficients) - y;
        found.misses = found.rows.iter().zip(values).map(miss).collect();
        Some((found, coefficients))
    }

    /// The share of each point in its own value: the diagonal of the hat matrix, in 0..1.
    pub(crate) fn leverages(&self) -> Vec<f64> {
        self.rows.iter().zip(&self.follows).map(|(row, follows)| dot(row, follows)).collect()
    }

    /// Points less coefficients.
    fn degrees_of_freedom(&self) -> f64 {
        (self.rows.len() - self.rows.first().map_or(0, Vec::len)) as f64
    }

    /// A number with this value and these derivatives by the coefficients.
    pub(crate) fn estimate(&self, value: f64, slopes: &[f64]) -> Estimate {
        let shares: Vec<f64> = self.follows.iter().map(|follow| dot(slopes, follow)).collect();
        let (standard_error, degrees) = self.alike(&shares);
        let alike = student_95(degrees) * standard_error;
        let by_chance = |error: f64, degrees: f64| {
            // a number that is 0 without an error has probability 1
            let z = if value == 0.0 { 0.0 } else { value / error };
            two_sided(z, degrees)
        };
        let probability = by_chance(standard_error, degrees);
        let Some((error, degrees)) = self.each(&shares) else {
            return Estimate { value, standard_error, half_width: alike, probability };
        };
        let half_width = alike.max(student_95(degrees) * error);
        let probability = probability.max(by_chance(error, degrees));
        Estimate { value, standard_error, half_width, probability }
    }

    /// Standard error and degrees of freedom if all points scatter alike on their scales, at least
    /// the known error. If no point is left over, the known error counts as certain.
    fn alike(&self, shares: &[f64]) -> (f64, f64) {
        let known = shares.iter().zip(&self.known).map(|(share, known)| (share * known).powi(2));
        let known: f64 = known.sum();
        let degrees = self.degrees_of_freedom();
        if degrees == 0.0 {
            return (if known > 0.0 { known.sqrt() } else { f64::NAN }, f64::INFINITY);
        }
        let variance = squares(&self.misses) / degrees;
        ((squares(shares) * variance).max(known).sqrt(), degrees)
    }

    /// The same if every point scatters in its own way: each residual over the root of one minus
    /// its own share (HC2: J. G. MacKinnon, H. White, J. Econometrics 29 (1985) 305), with the
    /// degrees of freedom of R. M. Bell and D. F. McCaffrey (Survey Methodology 28 (2002) 169).
    /// `None` if no point is left over or one determines a coefficient alone.
    fn each(&self, shares: &[f64]) -> Option<(f64, f64)> {
        let own = self.leverages();
        if self.degrees_of_freedom() == 0.0 || own.iter().any(|own| *own > ALONE) {
            return None;
        }
        let weights: Vec<f64> = shares.iter().zip(&own).map(|(s, h)| s * s / (1.0 - h)).collect();
        let variance: f64 = weights.iter().zip(&self.misses).map(|(w, miss)| w * miss * miss).sum();
        // trace and trace of the square of the quadratic form, if all points scatter alike
        let trace = squares(shares);
        let alone: f64 = weights.iter().zip(&own).map(|(w, h)| w * w * (1.0 - 2.0 * h)).sum();
        let square = alone + self.together(&weights);
        Some((variance.sqrt(), trace * trace / square))
    }

    /// The sum over all pairs of points of both weights times the square of the share that one has
    /// in the value of the other.
    fn together(&self, weights: &[f64]) -> f64 {
        let count = self.rows.first().map_or(0, Vec::len);
        let all = || weights.iter().zip(self.rows.iter().zip(&self.follows));
        let of = |a: usize, b: usize| all().map(|(w, (r, f))| w * r[a] * f[b]).sum::<f64>();
        let matrix: Vec<f64> = (0..count * count).map(|at| of(at / count, at % count)).collect();
        (0..count * count).map(|at| matrix[at] * matrix[at % count * count + at / count]).sum()
    }
}

fn squares(values: &[f64]) -> f64 {
    dot(values, values)
}
