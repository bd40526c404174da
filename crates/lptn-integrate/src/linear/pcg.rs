//! Conjugate gradients, preconditioned by an incomplete Cholesky factor without fill.
//!
//! For the Newton matrices `M - gamma J` of bodies that are cut into cells along three axes: their
//! exact factors hold sixty times as many numbers as the matrix (40 x 40 x 40 cells), and the steps
//! of a run are short enough for a few dozen iterations to do. Method: M. R. Hestenes and E.
//! Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409; preconditioner: J. A. Meijerink and H. A. van
//! der Vorst, Math. Comp. 31 (1977) 148, who prove that it exists for the M-matrices that
//! conductances make.

use super::{Factorization, LinearSolverKind, SparseCholesky, checked, expect_length};
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
    pattern: Pattern,
    /// Rows of the strict lower triangle: where each begins, and the column of each entry.
    rows: Vec<usize>,
    columns: Vec<u32>,
    /// The slot in the pattern of each entry.
    source: Vec<usize>,
    /// Entries and diagonal of the matrix, then of the factor; of its diagonal the reciprocals.
    entries: Vec<f64>,
    diagonal: Vec<f64>,
    factor: Vec<f64>,
    reciprocal: Vec<f64>,
    values: Vec<f64>,
    work: [Vec<f64>; 4],
    exact: Option<Box<SparseCholesky>>,
    ready: bool,
}

impl Pcg {
    /// For symmetric matrices with this pattern.
    ///
    /// # Panics
    /// If the matrix has 2^32 rows or more, which no memory holds.
    #[must_use]
    pub fn new(pattern: &Pattern) -> Self {
        let size = pattern.size();
        let (mut rows, mut columns, mut source) = (vec![0], Vec::new(), Vec::new());
        for row in 0..size {
            // the pattern is symmetric: the rows above the diagonal of a column are the columns
            // before it in its row
            for slot in pattern.column(row).start..pattern.diagonal_slot(row) {
                let column = pattern.row_indices()[slot];
                columns.push(u32::try_from(column).expect("a matrix has fewer than 2^32 rows"));
                source.push(slot);
            }
            rows.push(columns.len());
        }
        let (entries, factor) = (vec![0.0; columns.len()], vec![0.0; columns.len()]);
        Self {
            pattern: pattern.clone(),
            rows,
            columns,
            source,
            entries,
            diagonal: vec![0.0; size],
            factor,
            reciprocal: vec![0.0; size],
            values: Vec::new(),
            work: [(); 4].map(|()| vec![0.0; size]),
            exact: None,
            ready: false,
        }
    }

    /// The incomplete factor, row by row.
    fn incomplete(&mut self) -> Result<(), FactorError> {
        for row in 0..self.diagonal.len() {
            let (first, end) = (self.rows[row], self.rows[row + 1]);
            let mut pivot = self.diagonal[row];
            for at in first..end {
                let column = self.columns[at] as usize;
                let sum = self.overlap((first, at), column);
                let entry = (self.entries[at] - sum) * self.reciprocal[column];
                self.factor[at] = entry;
                pivot -= entry * entry;
            }
            let diagonal = self.diagonal[row];
            if !(diagonal > 0.0 && diagonal.is_finite()) {
                return Err(FactorError::NotPositiveDefinite { index: row });
            }
            let usable = if pivot > LEAST_PIVOT * diagonal { pivot } else { diagonal };
            self.reciprocal[row] = usable.sqrt().recip();
        }
        Ok(())
    }

    /// The product of the entries `first..end` of a row with those of another row in the same
    /// columns.
    fn overlap(&self, (mut own, end): (usize, usize), other: usize) -> f64 {
        let (mut theirs, last) = (self.rows[other], self.rows[other + 1]);
        let mut sum = 0.0;
        while own < end && theirs < last {
            let (a, b) = (self.columns[own], self.columns[theirs]);
            if a == b {
                sum += self.factor[own] * self.factor[theirs];
            }
            own += usize::from(a <= b);
            theirs += usize::from(b <= a);
        }
        sum
    }

    /// Writes `y = A x`.
    fn multiply(&self, x: &[f64], y: &mut [f64]) {
        for (row, diagonal) in self.diagonal.iter().enumerate() {
            let mut sum = diagonal * x[row];
            for at in self.rows[row]..self.rows[row + 1] {
                let column = self.columns[at] as usize;
                sum += self.entries[at] * x[column];
                y[column] += self.entries[at] * x[row];
            }
            y[row] = sum; // later rows add to it
        }
    }

    /// Writes `z = (L L')^-1 r`.
    fn precondition(&self, r: &[f64], z: &mut [f64]) {
        for row in 0..r.len() {
            let own = self.rows[row]..self.rows[row + 1];
            let sum: f64 = own.map(|at| self.factor[at] * z[self.columns[at] as usize]).sum();
            z[row] = (r[row] - sum) * self.reciprocal[row];
        }
        for row in (0..r.len()).rev() {
            z[row] *= self.reciprocal[row];
            let value = z[row];
            for at in self.rows[row]..self.rows[row + 1] {
                z[self.columns[at] as usize] -= self.factor[at] * value;
            }
        }
    }

    /// The largest component of a residual over the diagonal.
    fn size_of(&self, r: &[f64]) -> f64 {
        r.iter().zip(&self.diagonal).fold(0.0, |most: f64, (r, d)| most.max((r / d).abs()))
    }

    /// Replaces `b` by the solution; false if that is not reached.
    fn iterate(&self, b: &mut [f64], [r, z, p, q]: &mut [Vec<f64>; 4]) -> bool {
        let enough = LEFT_OVER * self.size_of(b);
        r.copy_from_slice(b);
        b.fill(0.0);
        if enough == 0.0 {
            return true;
        }
        self.precondition(r, z);
        p.copy_from_slice(z);
        let mut product = kernels::dot(r, z);
        for _ in 0..MOST_ITERATIONS {
            self.multiply(p, q);
            let step = product / kernels::dot(p, q);
            if !step.is_finite() {
                return false;
            }
            kernels::scale_and_add(1.0, b, step, p);
            kernels::scale_and_add(1.0, r, -step, q);
            if self.size_of(r) <= enough {
                return true;
            }
            self.precondition(r, z);
            let next = kernels::dot(r, z);
            kernels::scale_and_add(next / product, p, 1.0, z);
            product = next;
        }
        false
    }

    fn solve_exactly(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        if self.exact.is_none() {
            let mut exact = SparseCholesky::new(&self.pattern)?;
            exact.factorize(&self.values)?;
            self.exact = Some(Box::new(exact));
        }
        match &mut self.exact {
            Some(exact) => exact.solve_in_place(b),
            None => Err(FactorError::NotFactorized),
        }
    }
}

impl Factorization for Pcg {
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::Pcg
    }

    fn fill(&self) -> usize {
        self.factor.len() + self.reciprocal.len()
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.pattern.len(), values.len())?;
        self.values.clear();
        self.values.extend_from_slice(values);
        self.exact = None;
        self.entries.iter_mut().zip(&self.source).for_each(|(entry, &slot)| *entry = values[slot]);
        let diagonal = self.diagonal.iter_mut().zip(self.pattern.diagonal());
        diagonal.for_each(|(entry, &slot)| *entry = values[slot]);
        let done = self.incomplete();
        self.ready = done.is_ok();
        done
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |_| ())?;
        if self.exact.is_some() {
            return self.solve_exactly(b);
        }
        let mut work = std::mem::take(&mut self.work);
        // the right side is kept where the iterations begin
        let right = b.to_vec();
        let done = self.iterate(b, &mut work);
        self.work = work;
        if done && kernels::first_not_finite(b).is_none() {
            return Ok(());
        }
        b.copy_from_slice(&right);
        self.solve_exactly(b)
    }
}
