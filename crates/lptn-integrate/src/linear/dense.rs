//! Small systems as full matrices.

use super::{Factorization, LinearSolverKind, checked, expect_length};
use crate::{FactorError, Pattern};

/// Pivots below this fraction of the largest entry of their column are rounding errors.
const PIVOT_FLOOR: f64 = 4.0 * f64::EPSILON;

/// Dense Cholesky (symmetric) or LU with partial pivoting. Work grows with the cube of the size.
#[derive(Clone, Debug)]
pub struct Dense {
    size: usize,
    symmetric: bool,
    /// Position in `factors` of every slot of the pattern; rows are contiguous.
    position: Vec<usize>,
    factors: Vec<f64>,
    /// Row swapped with row `k` at elimination step `k` (LU).
    swapped: Vec<usize>,
    ready: bool,
}

impl Dense {
    /// For matrices with this pattern; `symmetric` values are factorised by Cholesky.
    #[must_use]
    pub fn new(pattern: &Pattern, symmetric: bool) -> Self {
        let size = pattern.size();
        let mut position = Vec::with_capacity(pattern.len());
        for column in 0..size {
            position.extend(
                pattern.row_indices()[pattern.column(column)].iter().map(|row| row * size + column),
            );
        }
        let (factors, swapped) = (vec![0.0; size * size], (0..size).collect());
        Self { size, symmetric, position, factors, swapped, ready: false }
    }

    /// `A = L L'`, row by row; the reciprocals of the diagonal of `L` are stored in its place.
    fn cholesky(&mut self) -> Result<(), FactorError> {
        let n = self.size;
        for i in 0..n {
            let (above, rest) = self.factors.split_at_mut(i * n);
            let row = &mut rest[..=i];
            let scale = row[i];
            for j in 0..i {
                let other = &above[j * n..=j * n + j];
                let sum: f64 = row[..j].iter().zip(other).map(|(a, b)| a * b).sum();
                row[j] = (row[j] - sum) * other[j];
            }
            let pivot = scale - row[..i].iter().map(|a| a * a).sum::<f64>();
            if pivot.is_nan() || pivot <= PIVOT_FLOOR * scale {
                return Err(FactorError::NotPositiveDefinite { index: i });
            }
            row[i] = pivot.sqrt().recip();
        }
        Ok(())
    }

    fn solve_cholesky(&self, b: &mut [f64]) {
        let n = self.size;
        for i in 0..n {
            let row = &self.factors[i * n..=i * n + i];
            let sum: f64 = row[..i].iter().zip(&*b).map(|(a, x)| a * x).sum();
            b[i] = (b[i] - sum) * row[i];
        }
        for i in (0..n).rev() {
            let row = &self.factors[i * n..=i * n + i];
            let (head, tail) = b.split_at_mut(i);
            tail[0] *= row[i];
            head.iter_mut().zip(row).for_each(|(x, a)| *x -= a * tail[0]);
        }
    }

    /// `P A = L U`, the reciprocals of the diagonal of `U` stored in its place.
    fn lu(&mut self) -> Result<(), FactorError> {
        let n = self.size;
        let columns: Vec<f64> = (0..n).map(|k| self.column_size(k)).collect();
        for (k, column_size) in columns.into_iter().enumerate() {
            let pivot_row = self.pivot_row(k);
            let pivot = self.factors[pivot_row * n + k];
            if pivot.is_nan() || pivot.abs() <= PIVOT_FLOOR * column_size {
                return Err(FactorError::Singular { index: k });
            }
            self.swapped[k] = pivot_row;
            self.swap_rows(k, pivot_row);
            self.factors[k * n + k] = pivot.recip();
            self.eliminate(k);
        }
        Ok(())
    }

    fn column_size(&self, k: usize) -> f64 {
        self.factors
            .iter()
            .skip(k)
            .step_by(self.size)
            .fold(0.0, |largest, a| f64::max(largest, a.abs()))
    }

    fn pivot_row(&self, k: usize) -> usize {
        let size_of = |i: usize| self.factors[i * self.size + k].abs();
        (k + 1..self.size).fold(k, |best, i| if size_of(i) > size_of(best) { i } else { best })
    }

    fn swap_rows(&mut self, k: usize, other: usize) {
        if k != other {
            let n = self.size;
            let (head, tail) = self.factors.split_at_mut(other * n);
            head[k * n..(k + 1) * n].swap_with_slice(&mut tail[..n]);
        }
    }

    fn eliminate(&mut self, k: usize) {
        let n = self.size;
        let (head, tail) = self.factors.split_at_mut((k + 1) * n);
        let pivot_row = &head[k * n..];
        for row in tail.chunks_exact_mut(n) {
            row[k] *= pivot_row[k];
            let factor = row[k];
            row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]).for_each(|(a, p)| *a -= factor * p);
        }
    }

    fn solve_lu(&self, b: &mut [f64]) {
        let n = self.size;
        for (k, &other) in self.swapped.iter().enumerate() {
            b.swap(k, other);
        }
        for i in 0..n {
            let row = &self.factors[i * n..i * n + i];
            b[i] -= row.iter().zip(&*b).map(|(a, x)| a * x).sum::<f64>();
        }
        for i in (0..n).rev() {
            let row = &self.factors[i * n..(i + 1) * n];
            let sum: f64 = row[i + 1..].iter().zip(&b[i + 1..]).map(|(a, x)| a * x).sum();
            b[i] = (b[i] - sum) * row[i];
        }
    }
}

impl Factorization for Dense {
    fn size(&self) -> usize {
        self.size
    }

    fn kind(&self) -> LinearSolverKind {
        if self.symmetric { LinearSolverKind::DenseCholesky } else { LinearSolverKind::DenseLu }
    }

    fn fill(&self) -> usize {
        self.factors.len()
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self { ready: false, ..self.clone() }))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.position.len(), values.len())?;
        self.ready = false;
        self.factors.fill(0.0);
        for (&position, &value) in self.position.iter().zip(values) {
            self.factors[position] = value;
        }
        if self.symmetric {
            self.cholesky()?
        } else {
            self.lu()?
        }
        self.ready = true;
        Ok(())
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size, self.ready), b, |b| {
            if self.symmetric { self.solve_cholesky(b) } else { self.solve_lu(b) }
        })
    }
}
