//! Covariance of parameters: standard errors and correlations.

use faer::{Mat, MatRef};
use lptn_integrate::dense;

/// The covariance of some parameters of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance {
    /// Indices of the parameters, ascending; those on a bound are not among them.
    pub parameters: Vec<usize>,
    /// Row by row, `parameters.len()` squared, in the product of the parameters' units.
    pub values: Vec<f64>,
}

impl Covariance {
    /// `(J^T J)^-1` of some `parameters`, from the singular values of their columns scaled to
    /// length 1. `jacobian` contains the derivatives of `rows` residuals, one parameter after the
    /// other. `None` if the smallest singular value is below `1e-12` of the largest: then some
    /// combination of the parameters is not determined.
    pub fn inverse(jacobian: &[f64], rows: usize, parameters: &[usize]) -> Option<Self> {
        let n = parameters.len();
        let inverse = pseudo_inverse(jacobian, rows, parameters)?;
        let product = |i: usize, j: usize| {
            (0..inverse.ncols()).map(|k| inverse[(i, k)] * inverse[(j, k)]).sum()
        };
        let values = (0..n * n).map(|at| product(at / n, at % n)).collect();
        Some(Self { parameters: parameters.to_vec(), values })
    }

    /// `(J^T J)^-1 M (J^T J)^-1` if this is `(J^T J)^-1`: the covariance of least squares when that
    /// of the residuals is `Omega` and `M = J^T Omega J` (row by row).
    #[must_use]
    pub fn sandwich(&self, middle: &[f64]) -> Self {
        let n = self.parameters.len();
        let inverse = MatRef::from_row_major_slice(&self.values, n, n);
        let half = dense::product(inverse, MatRef::from_row_major_slice(middle, n, n));
        let whole = dense::product(half.as_ref(), inverse);
        // rounding leaves the two halves unequal
        let values = (0..n * n)
            .map(|at| 0.5 * (whole[(at / n, at % n)] + whole[(at % n, at / n)]))
            .collect();
        Self { parameters: self.parameters.clone(), values }
    }

    /// All entries times a factor, for example the variance of one residual.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            parameters: self.parameters.clone(),
            values: self.values.iter().map(|v| v * factor).collect(),
        }
    }

    /// Raises standard errors to at least those of `other`, of the same parameters; correlations
    /// stay.
    pub(crate) fn at_least(&self, other: &Self) -> Self {
        let n = self.parameters.len();
        let factor = |i: usize| (other.values[i * n + i] / self.values[i * n + i]).max(1.0).sqrt();
        let values =
            (0..n * n).map(|at| self.values[at] * factor(at / n) * factor(at % n)).collect();
        Self { parameters: self.parameters.clone(), values }
    }

    /// The covariance of parameters `i` and `j`; `None` if one of them is not free.
    pub fn between(&self, i: usize, j: usize) -> Option<f64> {
        let place = |p: usize| self.parameters.binary_search(&p).ok();
        Some(self.values[place(i)? * self.parameters.len() + place(j)?])
    }

    /// The standard error of parameter `j`; `None` if it is not free.
    pub fn standard_error(&self, j: usize) -> Option<f64> {
        self.between(j, j).map(f64::sqrt)
    }

    /// The correlation of parameters `i` and `j`, in -1..1; `None` if one of them is not free.
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        Some(self.between(i, j)? / (self.between(i, i)? * self.between(j, j)?).sqrt())
    }

    /// Standard deviation of a quantity with these derivatives by all parameters of the fit.
    pub fn propagated(&self, gradient: &[f64]) -> f64 {
        let n = self.parameters.len();
        let term = |at: usize| {
            gradient[self.parameters[at / n]] * self.values[at] * gradient[self.parameters[at % n]]
        };
        (0..n * n).map(term).sum::<f64>().max(0.0).sqrt()
    }
}

/// A matrix A with `A A^T = (J^T J)^-1`: `D^-1 V S^-1` of the scaled columns.
fn pseudo_inverse(jacobian: &[f64], rows: usize, parameters: &[usize]) -> Option<Mat<f64>> {
    let n = parameters.len();
    if rows < n {
        return None;
    }
    let column = |j: usize| &jacobian[parameters[j] * rows..][..rows];
    let norms: Vec<f64> =
        (0..n).map(|j| column(j).iter().map(|x| x * x).sum::<f64>().sqrt()).collect();
    if norms.iter().any(|norm| !(norm.is_normal() && norm.is_finite())) {
        return None;
    }
    let scaled = Mat::from_fn(rows, n, |i, j| column(j)[i] / norms[j]);
    let dense::Singular { values, v, .. } =
        dense::singular(dense::triangle(scaled.as_ref()).as_ref())?;
    let determined = values.iter().all(|value| *value > 1e-12 * values[0]);
    determined.then(|| Mat::from_fn(n, n, |i, k| v[(i, k)] / (values[k] * norms[i])))
}
