//! The largest eigenvalues of a symmetric operator, with their vectors, by the Lanczos method with
//! thick restarts (K. Wu and H. Simon, Thick-restart Lanczos method for large symmetric eigenvalue
//! problems, SIAM J. Matrix Anal. Appl. 22 (2000) 602) and full orthogonalisation.
//!
//! One sequence of vectors sees one vector of each eigenspace, so symmetric bodies would lose half
//! of their modes. Vectors that were found are therefore locked away. The method begins again with
//! another vector, until the largest remaining value is below all that were wanted.
//!
//! Square bodies have their modes in pairs, and faer's partial eigensolver has no such restart.

use faer::Mat;

use crate::FactorError;
use crate::dense;
use crate::vectors::{add, dot, norm, take_off};

/// An eigenvalue with its vector of length 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenpair {
    /// The eigenvalue.
    pub value: f64,
    /// Its vector.
    pub vector: Vec<f64>,
}

/// A symmetric operator: replaces a vector by its product with it.
pub type Operator<'a> = dyn FnMut(&mut [f64]) -> Result<(), FactorError> + 'a;

/// Reason for a search without a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LanczosError {
    /// The operator failed.
    Operator(FactorError),
    /// It did not converge.
    Stalled,
}

impl From<FactorError> for LanczosError {
    fn from(error: FactorError) -> Self {
        Self::Operator(error)
    }
}

/// A pair is found when its residual is below this share of the largest eigenvalue: the error of
/// the eigenvalue is the square of the residual over the distance to the next one.
const CONVERGED: f64 = 1e-10;

/// Vectors beyond those wanted that are kept at a restart.
const SPARE: usize = 6;

/// Most products with the operator in one search.
const MOST_PRODUCTS: usize = 3000;

/// The `count` largest eigenvalues, largest first, those of several vectors as often as they have
/// them; fewer if the operator has fewer apart from `known`, orthonormal vectors that are left out
/// of it.
///
/// # Errors
/// [`LanczosError`]
pub fn largest(
    size: usize,
    (count, known): (usize, &[Vec<f64>]),
    apply: &mut Operator<'_>,
) -> Result<Vec<Eigenpair>, LanczosError> {
    let count = count.min(size - known.len());
    let mut found: Vec<Eigenpair> = Vec::new();
    let mut wanted = count;
    for pass in 0..=size {
        let left = size - known.len() - found.len();
        if wanted == 0 || left == 0 {
            break;
        }
        let mut locked = known.to_vec();
        locked.extend(found.iter().map(|pair| pair.vector.clone()));
        let search = Search::new(start(size, pass), &locked);
        let more = search.run(wanted.min(left), apply)?;
        let least = found.get(count - 1).map_or(f64::NEG_INFINITY, |pair| pair.value);
        let news = more.iter().any(|pair| pair.value > least);
        found.extend(more);
        found.sort_by(|a, b| b.value.total_cmp(&a.value));
        if !news {
            break;
        }
        wanted = 1;
    }
    found.truncate(count);
    Ok(found)
}

/// A vector that no eigenvector is likely to be orthogonal to, another for each pass.
fn start(size: usize, pass: usize) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(1 + pass as u64);
    let mut next = || {
        // xorshift64*, S. Vigna, An experimental exploration of Marsaglia's xorshift generators
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..size).map(|_| next()).collect()
}

/// One sequence of vectors, orthogonal to the locked ones.
struct Search<'a> {
    locked: &'a [Vec<f64>],
    /// Orthonormal.
    basis: Vec<Vec<f64>>,
    /// Row by row the lower triangle of the operator in the basis; the last vector has none yet.
    rows: Vec<Vec<f64>>,
    next: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(start: Vec<f64>, locked: &'a [Vec<f64>]) -> Self {
        Self { locked, basis: Vec::new(), rows: Vec::new(), next: start }
    }

    /// The `count` largest pairs apart from the locked ones.
    fn run(
        mut self,
        count: usize,
        apply: &mut Operator<'_>,
    ) -> Result<Vec<Eigenpair>, LanczosError> {
        let most = (2 * count + 20).min(self.next.len() - self.locked.len());
        let mut coupling = self.orthogonalise();
        for product in 1..=MOST_PRODUCTS {
            let mut image = self.take(coupling);
            let last = image.clone();
            apply(&mut image)?;
            self.rows.push(self.basis.iter().map(|v| dot(v, &image)).collect());
            self.basis.push(last);
            let own = self.basis.len() - 1;
            self.rows[own].push(dot(&self.basis[own], &image));
            self.next = image;
            coupling = self.orthogonalise();
            let full = self.basis.len() == most;
            let ended = coupling <= f64::EPSILON * self.rows[own][own].abs();
            if full || ended || product % 4 == 0 {
                let (values, vectors) = self.ritz().ok_or(LanczosError::Stalled)?;
                let size = values.last().map_or(0.0, |v| v.abs());
                let of = self.basis.len();
                let residual = |k: usize| coupling * vectors[(of - 1, k)].abs();
                let wanted = of.saturating_sub(count)..of;
                if ended || of >= count && wanted.clone().all(|k| residual(k) <= CONVERGED * size) {
                    return Ok(wanted.rev().map(|k| self.pair(values[k], &vectors, k)).collect());
                }
                if full {
                    self.restart(&values, &vectors, of.saturating_sub(count + SPARE));
                }
            }
        }
        Err(LanczosError::Stalled)
    }

    /// The next vector of the basis, of length 1.
    fn take(&mut self, length: f64) -> Vec<f64> {
        let mut next = std::mem::take(&mut self.next);
        next.iter_mut().for_each(|x| *x /= length);
        next
    }

    /// Makes the next vector orthogonal to the others, and returns its remaining length.
    fn orthogonalise(&mut self) -> f64 {
        for _ in 0..2 {
            take_off(&mut self.next, self.locked.iter().chain(&self.basis));
        }
        norm(&self.next)
    }

    /// Eigenvalues, ascending, and vectors of the operator in the basis.
    fn ritz(&self) -> Option<(Vec<f64>, Mat<f64>)> {
        let size = self.basis.len();
        let lower = Mat::from_fn(size, size, |i, j| if j <= i { self.rows[i][j] } else { 0.0 });
        dense::symmetric_eigen(lower.as_ref())
    }

    fn pair(&self, value: f64, vectors: &Mat<f64>, k: usize) -> Eigenpair {
        let mut vector = vec![0.0; self.next.len()];
        self.basis.iter().enumerate().for_each(|(i, v)| add(&mut vector, vectors[(i, k)], v));
        Eigenpair { value, vector }
    }

    /// Goes on with the pairs from `first` on; the next vector stays.
    fn restart(&mut self, values: &[f64], vectors: &Mat<f64>, first: usize) {
        let kept = first..values.len();
        self.basis = kept.clone().map(|k| self.pair(values[k], vectors, k).vector).collect();
        let diagonal = |(row, k): (usize, usize)| {
            let mut entries = vec![0.0; row + 1];
            entries[row] = values[k];
            entries
        };
        self.rows = kept.enumerate().map(diagonal).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The operator of a square plate of `n` by `n` equal cells with its edge fixed at zero,
    /// inverted in closed form by its sines.
    fn plate(n: usize) -> (Vec<f64>, impl FnMut(&mut [f64]) -> Result<(), FactorError>) {
        let angle = move |k: usize| std::f64::consts::PI * k as f64 / (n + 1) as f64;
        let rate = move |k: usize| 2.0 - 2.0 * angle(k).cos();
        let mut exact: Vec<f64> =
            (1..=n).flat_map(|a| (1..=n).map(move |b| 1.0 / (rate(a) + rate(b)))).collect();
        exact.sort_by(|a, b| b.total_cmp(a));
        let scale = (2.0 / (n + 1) as f64).sqrt();
        let sines: Vec<f64> = (1..=n)
            .flat_map(|a| (1..=n).map(move |i| scale * (angle(a) * i as f64).sin()))
            .collect();
        let apply = move |x: &mut [f64]| {
            let turn = |x: &[f64]| -> Vec<f64> {
                let rows: Vec<f64> = (0..n * n)
                    .map(|at| (0..n).map(|j| sines[at % n * n + j] * x[at / n * n + j]).sum())
                    .collect();
                (0..n * n)
                    .map(|at| (0..n).map(|i| sines[at / n * n + i] * rows[i * n + at % n]).sum())
                    .collect()
            };
            let mut y = turn(x);
            (0..n * n).for_each(|at| y[at] /= rate(at / n + 1) + rate(at % n + 1));
            x.copy_from_slice(&turn(&y));
            Ok(())
        };
        (exact, apply)
    }

    #[test]
    fn eigenvalues_of_a_square_plate_are_found_as_often_as_they_are_there() {
        let (exact, mut apply) = plate(24);
        let found = largest(24 * 24, (20, &[]), &mut apply).unwrap();
        for (pair, exact) in found.iter().zip(&exact) {
            assert!((pair.value / exact - 1.0).abs() < 1e-12, "{} {exact}", pair.value);
        }
        for (i, a) in found.iter().enumerate() {
            for (j, b) in found.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((dot(&a.vector, &b.vector) - expected).abs() < 1e-9, "{i} {j}");
            }
        }
    }

    #[test]
    fn all_of_a_small_operator_and_none_that_is_known() {
        let mut apply = |x: &mut [f64]| {
            x.iter_mut().zip([3.0, 3.0, 3.0, 1.0, 0.0]).for_each(|(x, d)| *x *= d);
            Ok(())
        };
        let values = |count, known: &[Vec<f64>], apply: &mut Operator<'_>| -> Vec<f64> {
            let found = largest(5, (count, known), apply).unwrap();
            found.iter().map(|pair| (1e9 * pair.value).round() / 1e9).collect()
        };
        assert_eq!(values(9, &[], &mut apply), [3.0, 3.0, 3.0, 1.0, 0.0]);
        let known = vec![vec![0.0, 1.0, 0.0, 0.0, 0.0]];
        assert_eq!(values(9, &known, &mut apply), [3.0, 3.0, 1.0, 0.0]);
        assert_eq!(values(2, &known, &mut apply), [3.0, 3.0]);
    }
}
