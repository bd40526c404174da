//! An incomplete factor without fill, and its matrix.
//!
//! The factor is `(D + L) D^-1 (D + U)` with the matrix's own strict triangles `L` and `U` and a
//! diagonal `D` with which the product has the diagonal of the matrix. If no three nodes are linked
//! with each other, as in a body of cells, that is the incomplete factor itself. So nothing is
//! stored in addition to the matrix, and its product with a vector costs no more than the sweeps of
//! the factor (S. C. Eisenstat, SIAM J. Sci. Stat. Comput. 2 (1981) 1). J. A. Meijerink and H. A.
//! van der Vorst, Math. Comp. 31 (1977) 148, prove that it exists for the M-matrices that
//! conductances and streams make.
//!
//! The factor keeps hubs linear in memory, and the same code serves streams.

use std::sync::Arc;

use super::shape::Shape;
use super::sweeps::Lower;
use crate::{FactorError, kernels};

/// A pivot below this part of its diagonal entry is replaced by the entry.
const LEAST_PIVOT: f64 = 1e-3;

/// Sums of a row below this share of its diagonal are roundings.
const ROUNDING: f64 = 1e-13;

/// A matrix `S A S` in the order of a shape, with the `S` for which `D` is 1 everywhere.
pub(super) struct Incomplete {
    pub(super) shape: Arc<Shape>,
    /// `L`, and the transpose of `U` if that is another one.
    lower: Vec<f64>,
    upper: Option<Vec<f64>>,
    /// The diagonal less 2.
    excess: Vec<f64>,
    scale: Vec<f64>,
    /// The square of a vector of ones in the energy norm: the sum of all entries of `A`. Rows count
    /// as much as the median one at most, so that one huge capacity does not hide the others. Rows
    /// that add up to a rounding do not count: in a steady state, all cells inside a body.
    pub(super) whole: f64,
}

/// Vectors in the order of the shape.
#[derive(Default)]
pub(super) struct Work {
    /// The solution and the residual, which is multiplied by `(I + L)^-1` once iterations begin.
    pub(super) solution: Vec<f64>,
    pub(super) left: Vec<f64>,
    /// Direction of the next step, its product with `(I + U)^-1`, and that with the matrix.
    pub(super) direction: Vec<f64>,
    pub(super) step: Vec<f64>,
    pub(super) product: Vec<f64>,
    /// Further ones for matrices that are not symmetric.
    pub(super) more: [Vec<f64>; 2],
}

impl Incomplete {
    pub(super) fn new(shape: Arc<Shape>) -> Self {
        let (lower, size) = (vec![0.0; shape.source.len()], shape.order.len());
        let upper = (!shape.mirror.is_empty()).then(|| lower.clone());
        let (excess, scale) = (vec![0.0; size], vec![0.0; size]);
        Self { shape, lower, upper, excess, scale, whole: 0.0 }
    }

    pub(super) fn size(&self) -> usize {
        self.excess.len()
    }

    pub(super) fn fill(&self) -> usize {
        let upper = self.upper.as_ref().map_or(0, Vec::len);
        self.lower.len() + upper + self.excess.len() + self.scale.len()
    }

    fn lower(&self) -> Lower<'_> {
        Lower::new(&self.shape.triangle, &self.lower)
    }

    /// The transpose of `U`.
    fn upper(&self) -> Lower<'_> {
        Lower::new(&self.shape.triangle, self.upper.as_ref().unwrap_or(&self.lower))
    }

    /// Takes the values and scales them so that `D` is 1.
    ///
    /// # Errors
    /// [`FactorError::NotPositiveDefinite`] with the row of a diagonal entry that is not positive.
    pub(super) fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let Shape { triangle, source, mirror, diagonal, order, .. } = &*self.shape;
        let mut sums = vec![0.0; self.excess.len()];
        for (row, own) in triangle.rows() {
            let diagonal = values[diagonal[row] as usize];
            if !(diagonal > 0.0 && diagonal.is_finite()) {
                return Err(FactorError::NotPositiveDefinite { index: order[row] as usize });
            }
            let mut pivot = diagonal;
            sums[row] += diagonal;
            for at in own.clone() {
                let scale = self.scale[triangle.columns[at] as usize];
                let lower = values[source[at] as usize] * scale;
                sums[row] += values[source[at] as usize];
                sums[triangle.columns[at] as usize] += values[source[at] as usize];
                let upper = self.upper.as_mut().map_or(lower, |upper| {
                    upper[at] = values[mirror[at] as usize] * scale;
                    upper[at]
                });
                self.lower[at] = lower;
                pivot -= lower * upper;
            }
            let usable = if pivot > LEAST_PIVOT * diagonal { pivot } else { diagonal };
            let scale = usable.sqrt().recip();
            self.lower[own.clone()].iter_mut().for_each(|entry| *entry *= scale);
            if let Some(upper) = &mut self.upper {
                upper[own].iter_mut().for_each(|entry| *entry *= scale);
            }
            self.scale[row] = scale;
            self.excess[row] = diagonal * scale * scale - 2.0;
        }
        let own = |row: usize| values[diagonal[row] as usize];
        let mut grounded: Vec<f64> = (0..sums.len())
            .filter(|&row| sums[row] > ROUNDING * own(row))
            .map(|r| sums[r])
            .collect();
        self.whole = typical_sum(&mut grounded);
        Ok(())
    }

    /// Takes the right side and the guess, and returns the largest residual over the diagonal.
    pub(super) fn begin(&self, b: &[f64], x: Option<&[f64]>, work: &mut Work) -> f64 {
        let Work { solution, left, product, .. } = work;
        let rows = self.shape.order.iter().map(|&row| row as usize).zip(&self.scale);
        left.clear();
        left.extend(rows.clone().map(|(row, scale)| b[row] * scale));
        solution.clear();
        product.clear();
        product.resize(b.len(), 0.0);
        let Some(x) = x.filter(|x| x.iter().any(|x| x.abs() > 0.0)) else {
            solution.resize(b.len(), 0.0);
            return self.over_diagonal(left);
        };
        solution.extend(rows.map(|(row, _)| x[row]));
        kernels::zip_in_place(solution, &self.scale, |x, scale| x / scale);
        let others = product.iter_mut().zip(&*solution).zip(&self.excess);
        others.for_each(|((product, x), excess)| *product = (excess + 2.0) * x);
        self.upper().add_transposed(solution, product);
        let mut rows = left.iter_mut().zip(&*product);
        self.lower().times(solution, |others| {
            rows.next().into_iter().for_each(|(left, own)| *left -= own + others);
        });
        self.over_diagonal(left)
    }

    /// Multiplies the residual by `(I + L)^-1`.
    pub(super) fn precondition(&self, left: &mut [f64]) {
        self.lower().forward(left);
    }

    /// Replaces `step`, a direction, by the change of the solution. Writes the change of the right
    /// side, multiplied by `(I + L)^-1`.
    pub(super) fn apply(&self, direction: &[f64], step: &mut [f64], product: &mut [f64]) {
        self.upper().backward(step);
        let parts = product.iter_mut().zip(direction).zip(&*step).zip(&self.excess);
        parts.for_each(|(((product, direction), step), excess)| {
            *product = direction + excess * step;
        });
        self.lower().forward(product);
        product.iter_mut().zip(&*step).for_each(|(product, step)| *product += step);
    }

    /// The largest component of the residual over the diagonal of `A`.
    fn over_diagonal(&self, left: &[f64]) -> f64 {
        kernels::largest_of(left, [&self.excess, &self.scale], |left, [excess, scale]| {
            left * scale / (excess + 2.0)
        })
    }

    /// The same if `left` is multiplied by `(I + L)^-1`; `work` is overwritten.
    pub(super) fn left_over(&self, left: &[f64], work: &mut [f64]) -> f64 {
        let mut rows = work.iter_mut().zip(left);
        self.lower().times(left, |others| {
            rows.next().into_iter().for_each(|(sum, own)| *sum = own + others);
        });
        self.over_diagonal(work)
    }

    /// Writes the solution of `A x = b`.
    pub(super) fn end(&self, solution: &[f64], x: &mut [f64]) {
        let rows = self.shape.order.iter().zip(&self.scale).zip(solution);
        rows.for_each(|((&row, scale), solution)| x[row as usize] = scale * solution);
    }

    /// The values of `S A S` in the slots of the pattern, and `S`. Those above the diagonal of a
    /// symmetric matrix are 0.
    pub(super) fn values(&self) -> (Vec<f64>, &[f64]) {
        let mut values = vec![0.0; self.shape.slots];
        let mut put = |slots: &[u32], entries: &[f64]| {
            slots.iter().zip(entries).for_each(|(&slot, entry)| values[slot as usize] = *entry);
        };
        put(&self.shape.source, &self.lower);
        put(&self.shape.mirror, self.upper.as_deref().unwrap_or_default());
        let diagonal: Vec<f64> = self.excess.iter().map(|excess| excess + 2.0).collect();
        put(&self.shape.diagonal, &diagonal);
        (values, &self.scale)
    }
}

/// The sum of some numbers, of which each counts as much as their median at most. Their order is
/// lost.
fn typical_sum(numbers: &mut [f64]) -> f64 {
    let middle = numbers.len() / 2;
    if numbers.is_empty() {
        return 0.0;
    }
    let median = *numbers.select_nth_unstable_by(middle, f64::total_cmp).1;
    let (low, high) = numbers.split_at(middle);
    low.iter().sum::<f64>() + high.len() as f64 * median
}
