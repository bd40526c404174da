//! Sparse `L L'` by faer, analysed once.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, Par, Side, Spec};

use super::{Factorization, LinearSolverKind, allocated, checked, column, expect_length};
use crate::{FactorError, Pattern};

/// Sparse Cholesky with approximate minimum degree ordering.
///
/// One thread: on two cores faer's parallel factorisation costs more processor time and gains next
/// to nothing.
pub struct SparseCholesky {
    lower: SymbolicSparseColMat<usize>,
    /// Slot in the full pattern of every entry of `lower`.
    source: Vec<usize>,
    lower_values: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factors: Vec<f64>,
    memory: MemBuffer,
    full_length: usize,
    ready: bool,
}

impl SparseCholesky {
    /// Orders and analyses the pattern.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let (lower, source) = lower_triangle(pattern);
        let symbolic = factorize_symbolic_cholesky(
            lower.as_ref(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| FactorError::OutOfMemory)?;
        let memory = allocated(
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        )?;
        let (lower_values, factors) = (vec![0.0; source.len()], vec![0.0; symbolic.len_val()]);
        let full_length = pattern.len();
        Ok(Self {
            lower,
            source,
            lower_values,
            symbolic,
            factors,
            memory,
            full_length,
            ready: false,
        })
    }

    /// The row, in the order given by the caller, of a pivot that faer reports in elimination
    /// order.
    fn row_of_pivot(&self, reported: usize) -> usize {
        // faer counts from 1 in its simplicial code and from 0 in its supernodal one.
        let position = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(_) => reported.saturating_sub(1),
            SymbolicCholeskyRaw::Supernodal(_) => reported,
        };
        let order = self.symbolic.perm().map(|permutation| permutation.arrays().0);
        order.and_then(|order| order.get(position).copied()).unwrap_or(position)
    }
}

fn lower_triangle(pattern: &Pattern) -> (SymbolicSparseColMat<usize>, Vec<usize>) {
    let n = pattern.size();
    let (mut pointers, mut rows, mut source) = (vec![0], Vec::new(), Vec::new());
    for column in 0..n {
        let slots = pattern.diagonal_slot(column)..pattern.column(column).end;
        rows.extend_from_slice(&pattern.row_indices()[slots.clone()]);
        source.extend(slots);
        pointers.push(rows.len());
    }
    (SymbolicSparseColMat::new_checked(n, n, pointers, None, rows), source)
}

impl Factorization for SparseCholesky {
    fn size(&self) -> usize {
        self.lower.nrows()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::SparseCholesky
    }

    fn fill(&self) -> usize {
        self.factors.len()
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.full_length, values.len())?;
        for (value, &slot) in self.lower_values.iter_mut().zip(&self.source) {
            *value = values[slot];
        }
        let outcome = self.symbolic.factorize_numeric_llt(
            &mut self.factors,
            SparseColMatRef::new(self.lower.as_ref(), &self.lower_values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        let failure = outcome.err();
        self.ready = failure.is_none();
        match failure {
            None => Ok(()),
            Some(LltError::NonPositivePivot { index }) => {
                Err(FactorError::NotPositiveDefinite { index: self.row_of_pivot(index) })
            }
        }
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |b| {
            let factors = LltRef::new(&self.symbolic, &self.factors);
            let memory = MemStack::new(&mut self.memory);
            factors.solve_in_place_with_conj(Conj::No, column(b), Par::Seq, memory);
        })
    }
}
