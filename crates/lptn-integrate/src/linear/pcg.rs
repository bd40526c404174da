//! Conjugate gradients, preconditioned by an incomplete Cholesky factor without fill.
//!
//! For the Newton matrices `M - gamma J` of bodies that are cut into cells along three axes: their
//! exact factors hold sixty times as many numbers as the matrix (40 x 40 x 40 cells), and the steps
//! of a run are short enough for a few dozen iterations to do. Method: M. R. Hestenes and E.
//! Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409; preconditioner: J. A. Meijerink and H. A. van
//! der Vorst, Math. Comp. 31 (1977) 148, who prove that it exists for the M-matrices that
//! conductances make.
//!
//! The factor is `(D + L) D^-1 (D + L')` with the matrix's own strict lower triangle `L` and a
//! diagonal `D` with which the product has the diagonal of the matrix: where no three nodes are
//! linked with each other, as in a body of cells, that is the incomplete factor itself. So nothing
//! is kept beside the matrix, and its product with a vector costs no more than a sweep of the
//! preconditioner (S. C. Eisenstat, SIAM J. Sci. Stat. Comput. 2 (1981) 1).

use std::sync::{Arc, Mutex};

use super::cholesky::{Analysis, SparseCholesky};
use super::shape::Shape;
use super::sweeps::Lower;
use super::{Factorization, LinearSolverKind, checked, expect_length, put, taken};
use crate::{FactorError, Pattern, kernels};

/// What is left over of a right side, relative, both over the diagonal (for a network: in K) and in
/// the maximum norm, in which CVODES measures errors too. CVODES solves to 1e-2 and less of a
/// tolerance, so the books of a run do not feel it.
const LEFT_OVER: f64 = 1e-9;

/// More iterations than this cost more than exact factors.
const MOST_ITERATIONS: usize = 1000;

/// A pivot below this part of its diagonal entry is replaced by the entry.
const LEAST_PIVOT: f64 = 1e-3;

/// IC(0)-PCG. Where it does not converge, exact factors take over until there are other values.
pub struct Pcg {
    family: Arc<Family>,
    /// The strict lower triangle of the scaled matrix `S A S`, with the `S` for which `D` above is
    /// 1 everywhere, and its diagonal less 2.
    entries: Vec<f64>,
    excess: Vec<f64>,
    scale: Vec<f64>,
    /// Factors of the scaled matrix.
    exact: Option<Box<SparseCholesky>>,
    ready: bool,
    iterations: u64,
}

/// What the matrices of one pattern have in common.
struct Family {
    pattern: Pattern,
    shape: Shape,
    /// To solve in, when nobody does.
    spare: Mutex<Option<Work>>,
    /// For exact factors, once they were needed.
    analysis: Mutex<Option<Arc<Analysis>>>,
}

/// Vectors in the order of the shape.
#[derive(Default)]
struct Work {
    /// Solution and right side of the scaled system; the latter becomes what is left of it, behind
    /// `(I + L)^-1`.
    solution: Vec<f64>,
    left: Vec<f64>,
    /// Where the next step goes, the same behind `(I + L')^-1`, and a sweep's result.
    direction: Vec<f64>,
    step: Vec<f64>,
    swept: Vec<f64>,
}

impl Pcg {
    /// For symmetric matrices with this pattern.
    ///
    /// # Panics
    /// If the matrix has 2^32 entries or more, which no memory holds.
    #[must_use]
    pub fn new(pattern: &Pattern) -> Self {
        let (pattern, shape) = (pattern.clone(), Shape::new(pattern));
        let (spare, analysis) = (Mutex::new(None), Mutex::new(None));
        Self::of(Arc::new(Family { pattern, shape, spare, analysis }))
    }

    /// A solver for other values in the same pattern, whose analysis is shared, and so is the
    /// memory to solve in.
    #[must_use]
    pub fn sibling(&self) -> Self {
        Self::of(Arc::clone(&self.family))
    }

    fn of(family: Arc<Family>) -> Self {
        let entries = vec![0.0; family.shape.columns.len()];
        let size = family.shape.order.len();
        let (excess, scale) = (vec![0.0; size], vec![0.0; size]);
        Self { family, entries, excess, scale, exact: None, ready: false, iterations: 0 }
    }

    fn lower(&self) -> Lower<'_> {
        let Shape { runs, columns, .. } = &self.family.shape;
        Lower { runs, columns, entries: &self.entries }
    }

    /// Scales the matrix so that `D` is 1.
    fn incomplete(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let shape = &self.family.shape;
        let rows =
            shape.runs.iter().flat_map(|run| run.places().map(|row| (row, run.entries(row))));
        for (row, own) in rows {
            let diagonal = values[shape.diagonal[row] as usize];
            if !(diagonal > 0.0 && diagonal.is_finite()) {
                return Err(FactorError::NotPositiveDefinite { index: shape.order[row] as usize });
            }
            let mut pivot = diagonal;
            for ((entry, &slot), &column) in self.entries[own.clone()]
                .iter_mut()
                .zip(&shape.source[own.clone()])
                .zip(&shape.columns[own.clone()])
            {
                *entry = values[slot as usize] * self.scale[column as usize];
                pivot -= *entry * *entry;
            }
            let usable = if pivot > LEAST_PIVOT * diagonal { pivot } else { diagonal };
            let scale = usable.sqrt().recip();
            self.entries[own].iter_mut().for_each(|entry| *entry *= scale);
            self.scale[row] = scale;
            self.excess[row] = diagonal * scale * scale - 2.0;
        }
        Ok(())
    }

    /// The largest component of what is left over, over the diagonal of the matrix.
    fn over_diagonal(&self, left: &[f64]) -> f64 {
        let rows = left.iter().zip(&self.excess).zip(&self.scale);
        rows.fold(0.0, |most: f64, ((left, excess), scale)| {
            let size = (left * scale / (excess + 2.0)).abs();
            if size > most { size } else { most }
        })
    }

    /// The same where `work.left` holds what is behind `(I + L)^-1`.
    fn left_over(&self, work: &mut Work) -> f64 {
        let Work { left, swept, .. } = work;
        let mut rows = swept.iter_mut().zip(&*left);
        self.lower().times(left, |others| {
            rows.next().into_iter().for_each(|(sum, own)| *sum = own + others);
        });
        self.over_diagonal(swept)
    }

    /// Takes the right side and the guess, and says how much of the right side is left.
    fn begin(&self, b: &[f64], x: Option<&[f64]>, work: &mut Work) -> f64 {
        let order = &self.family.shape.order;
        let rows = order.iter().zip(&self.scale);
        work.left.clear();
        work.left.extend(rows.clone().map(|(&row, scale)| b[row as usize] * scale));
        work.solution.clear();
        work.swept.resize(b.len(), 0.0);
        match x {
            None => work.solution.resize(b.len(), 0.0),
            Some(x) => {
                work.solution.extend(rows.map(|(&row, scale)| x[row as usize] / scale));
                self.lower().multiply(&self.excess, &work.solution, &mut work.swept);
                let parts = work.left.iter_mut().zip(&work.swept).zip(&work.solution);
                parts.for_each(|((left, product), x)| *left -= product + 2.0 * x);
            }
        }
        self.over_diagonal(&work.left)
    }

    /// Replaces `x` by the solution: within what is allowed from its guess on, or to the usual part
    /// from 0 on. False if that is not reached.
    fn iterate(&mut self, b: &[f64], x: &mut [f64], allowed: Option<f64>, work: &mut Work) -> bool {
        let size = self.begin(b, allowed.map(|_| &*x), work);
        let allowed = allowed.unwrap_or(LEFT_OVER * size);
        let done = size <= allowed || self.descend(size, allowed, work);
        let rows = self.family.shape.order.iter().zip(&self.scale).zip(&work.solution);
        rows.for_each(|((&row, scale), solution)| x[row as usize] = scale * solution);
        done && kernels::first_not_finite(x).is_none()
    }

    /// The iterations, from what is left over at the start.
    fn descend(&mut self, size: f64, allowed: f64, work: &mut Work) -> bool {
        self.lower().forward(&mut work.left);
        work.direction.clone_from(&work.left);
        work.step.clone_from(&work.left);
        let mut square = kernels::dot(&work.left, &work.left);
        // the square falls as what is left over does, by and large
        let mut known = (size, square);
        for _ in 0..MOST_ITERATIONS {
            self.iterations += 1;
            let next = self.advance(square, work);
            if !next.is_finite() {
                return false;
            }
            if known.0 * known.0 * next <= allowed * allowed * known.1 {
                known = (self.left_over(work), next);
                if known.0 <= allowed {
                    return true;
                }
            }
            let share = next / square;
            let all = work.direction.iter_mut().zip(&mut work.step).zip(&work.left);
            for ((direction, step), left) in all {
                *direction = left + share * *direction;
                *step = *direction;
            }
            square = next;
        }
        false
    }

    /// One step along the direction; the square of what is left over then.
    fn advance(&self, square: f64, work: &mut Work) -> f64 {
        let Work { solution, left, direction, step, swept } = work;
        self.lower().backward(step);
        let parts = swept.iter_mut().zip(&*direction).zip(&*step).zip(&self.excess);
        parts.for_each(|(((swept, direction), step), excess)| *swept = direction + excess * step);
        self.lower().forward(swept);
        swept.iter_mut().zip(&*step).for_each(|(swept, step)| *swept += step);
        let length = square / kernels::dot(swept, direction);
        if length.is_nan() || length <= 0.0 {
            return f64::NAN; // not positive definite
        }
        kernels::scale_and_add(1.0, solution, length, step);
        kernels::scale_and_add(1.0, left, -length, swept);
        kernels::dot(left, left)
    }

    /// The solution by iterations or, where they fail, by exact factors.
    fn solve(&mut self, b: &[f64], x: &mut [f64], allowed: Option<f64>) -> Result<(), FactorError> {
        if self.exact.is_none() {
            let mut work = taken(&self.family.spare).unwrap_or_default();
            let done = self.iterate(b, x, allowed, &mut work);
            put(&self.family.spare, work);
            if done {
                return Ok(());
            }
            self.exact = Some(Box::new(self.exact_factors()?));
        }
        let Some(exact) = &mut self.exact else { return Err(FactorError::NotFactorized) };
        // the rows of the pattern are those of the caller
        let rows = || self.family.shape.order.iter().zip(&self.scale);
        rows().for_each(|(&row, scale)| x[row as usize] = scale * b[row as usize]);
        exact.solve_in_place(x)?;
        rows().for_each(|(&row, scale)| x[row as usize] *= scale);
        kernels::first_not_finite(x).map_or(Ok(()), |index| Err(FactorError::Singular { index }))
    }

    /// Factors of the scaled matrix.
    fn exact_factors(&self) -> Result<SparseCholesky, FactorError> {
        let Family { pattern, shape, analysis, .. } = &*self.family;
        let analysis = match taken(analysis) {
            Some(known) => known,
            None => Arc::new(Analysis::new(pattern)?),
        };
        put(&self.family.analysis, Arc::clone(&analysis));
        let mut exact = SparseCholesky::of(analysis)?;
        let mut values = vec![0.0; shape.slots];
        let entries = shape.source.iter().zip(&self.entries);
        entries.for_each(|(&slot, entry)| values[slot as usize] = *entry);
        let diagonal = shape.diagonal.iter().zip(&self.excess);
        diagonal.for_each(|(&slot, excess)| values[slot as usize] = excess + 2.0);
        exact.factorize(&values)?;
        Ok(exact)
    }
}

impl Factorization for Pcg {
    fn size(&self) -> usize {
        self.excess.len()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::Pcg
    }

    fn fill(&self) -> usize {
        self.entries.len() + self.excess.len() + self.scale.len()
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self::sibling(self)))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.family.shape.slots, values.len())?;
        self.exact = None;
        let done = self.incomplete(values);
        self.ready = done.is_ok();
        done
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |_| ())?;
        let right = b.to_vec();
        self.solve(&right, b, None)
    }

    fn solve_from(&mut self, b: &[f64], x: &mut [f64], allowed: f64) -> Result<(), FactorError> {
        expect_length(self.size(), b.len())?;
        checked((self.size(), self.ready), x, |_| ())?;
        self.solve(b, x, Some(allowed))
    }
}
