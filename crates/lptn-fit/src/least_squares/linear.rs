//! The linear model of the residuals at one point.

use faer::{Mat, MatRef};
use lptn_integrate::{dense, kernels};

/// The triangular factor of `[J r]`: `|J s + r|^2 = |R s + q|^2 + rest^2`.
pub(crate) struct Triangle {
    /// R, square.
    pub(crate) factor: Mat<f64>,
    /// The part of the residuals that lies in the range of J.
    pub(crate) inside: Vec<f64>,
}

impl Triangle {
    /// From the Jacobian, one parameter after the other.
    pub(crate) fn new(jacobian: &[f64], residuals: &[f64]) -> Self {
        let rows = residuals.len();
        let n = jacobian.len() / rows;
        let both = [jacobian, residuals].concat();
        let upper = dense::triangle(MatRef::from_column_major_slice(&both, rows, n + 1));
        let entry =
            |i: usize, j: usize| if i < upper.nrows() && i <= j { upper[(i, j)] } else { 0.0 };
        Self { factor: Mat::from_fn(n, n, entry), inside: (0..n).map(|i| entry(i, n)).collect() }
    }

    /// Length of every column of J.
    pub(crate) fn norms(&self) -> Vec<f64> {
        let column = |j: usize| self.factor.col_as_slice(j);
        (0..self.inside.len()).map(|j| kernels::dot(column(j), column(j)).sqrt()).collect()
    }

    /// `J^T (J s + r)`.
    pub(crate) fn gradient(&self, step: &[f64]) -> Vec<f64> {
        let misses = self.misses(step);
        (0..step.len()).map(|j| (0..=j).map(|i| self.factor[(i, j)] * misses[i]).sum()).collect()
    }

    /// `R s + q`.
    pub(crate) fn misses(&self, step: &[f64]) -> Vec<f64> {
        let n = step.len();
        let row = |i: usize| (i..n).map(|j| self.factor[(i, j)] * step[j]).sum::<f64>();
        (0..n).map(|i| self.inside[i] + row(i)).collect()
    }

    /// Decrease of the sum of squares of the linear model by the step.
    pub(crate) fn reduction(&self, step: &[f64]) -> f64 {
        let change = |(miss, q): (&f64, &f64)| (q - miss) * (q + miss);
        self.misses(step).iter().zip(&self.inside).map(change).sum()
    }

    /// The step of the `free` parameters that minimises `|R s + target|^2 + damping |s scales|^2`.
    /// Without damping, directions whose singular values are below 1e-14 of the largest are left
    /// alone.
    pub(crate) fn solve(
        &self,
        free: &[usize],
        target: &[f64],
        scales: &[f64],
        damping: f64,
    ) -> Option<Vec<f64>> {
        let n = self.inside.len();
        let scaled =
            Mat::from_fn(n, free.len(), |i, j| self.factor[(i, free[j])] / scales[free[j]]);
        let svd = dense::singular(scaled.as_ref())?;
        let least = 1e-14 * svd.values.first().copied().unwrap_or(0.0);
        let mut step = vec![0.0; free.len()];
        for (k, &value) in svd.values.iter().enumerate().filter(|(_, value)| **value > least) {
            let seen: f64 = (0..n).map(|i| svd.u[(i, k)] * target[i]).sum();
            let along = -seen * value / (value * value + damping);
            for (j, s) in step.iter_mut().enumerate() {
                *s += svd.v[(j, k)] * along;
            }
        }
        Some(step.iter().zip(free).map(|(s, &j)| s / scales[j]).collect())
    }
}
