//! Combinations of parameters that data determine.

use faer::{Mat, MatRef};
use lptn_integrate::dense;

/// The singular values of a scaled Jacobian. Moving the scaled parameters by 1 along
/// `directions[k]` changes the residuals by `values[k]` (root of the sum of squares), so a standard
/// error along it is `1 / values[k]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The singular values, largest first.
    pub values: Vec<f64>,
    /// For each singular value the direction, of length 1, in scaled parameters.
    pub directions: Vec<Vec<f64>>,
    /// Number of singular values above the threshold.
    pub rank: usize,
    /// The part of the largest singular value below which one counts as 0.
    pub threshold: f64,
}

impl Spectrum {
    /// From the derivatives `jacobian`, one parameter after the other, with parameter j in units of
    /// `scales[j]`: its own value makes the directions those of logarithms, in which a product of
    /// parameters is a sum.
    ///
    /// `None` if a derivative is not finite or the decomposition fails.
    pub fn new(jacobian: &[f64], scales: &[f64], threshold: f64) -> Option<Self> {
        let n = scales.len();
        let rows = jacobian.len().checked_div(n)?;
        let scaled: Vec<f64> =
            jacobian.iter().enumerate().map(|(at, x)| x * scales[at / rows.max(1)]).collect();
        if scaled.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let upper = dense::triangle(MatRef::from_column_major_slice(&scaled, rows, n));
        let square =
            Mat::from_fn(
                n,
                n,
                |i, j| if i < upper.nrows() && i <= j { upper[(i, j)] } else { 0.0 },
            );
        let dense::Singular { values, v, .. } = dense::singular(square.as_ref())?;
        let least = threshold * values.first().copied().unwrap_or(0.0);
        let rank = values.iter().filter(|value| **value > least).count();
        let directions = (0..n).map(|k| v.col(k).iter().copied().collect()).collect();
        Some(Self { values, directions, rank, threshold })
    }

    /// The directions that do not change the residuals.
    pub fn unseen(&self) -> &[Vec<f64>] {
        &self.directions[self.rank..]
    }
}
