//! Sparse `L L'` by faer, analysed once.

use std::sync::{Arc, Mutex};

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, Par, Side, Spec};

use super::columns::Columns;
use super::row_by_row::{self, Rows};
use super::{
    Factorization, LinearSolverKind, allocated, checked, column, expect_length, put, taken,
};
use crate::{FactorError, Pattern};

/// Sparse Cholesky with approximate minimum degree ordering.
///
/// One thread: on two cores faer's parallel factorisation costs more processor time and gains
/// almost nothing.
pub struct SparseCholesky {
    analysis: Arc<Analysis>,
    factors: Vec<f64>,
    /// Memory for solves, about a number per row: this if faer solves, else `work`.
    memory: Option<MemBuffer>,
    work: Vec<f64>,
    ready: bool,
}

/// Data that the matrices of one pattern share.
pub(super) struct Analysis {
    lower: SymbolicSparseColMat<usize>,
    /// Slot in the full pattern of every entry of `lower`.
    source: Vec<usize>,
    symbolic: SymbolicCholesky<usize>,
    /// Present if columns are taken one by one.
    single: Option<(Rows, Columns)>,
    full_length: usize,
    /// Memory for a factorisation, if no one uses it.
    spare: Mutex<Option<Workspace>>,
}

struct Workspace {
    rows: row_by_row::Memory,
    /// The next two are empty if columns are taken one by one.
    lower_values: Vec<f64>,
    memory: MemBuffer,
}

impl SparseCholesky {
    /// Orders and analyses the pattern.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        Self::of(Arc::new(Analysis::new(pattern)?))
    }

    /// Separate factors for other values in the same pattern. The analysis is shared, and so is the
    /// memory for factorisations.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub fn sibling(&self) -> Result<Self, FactorError> {
        Self::of(Arc::clone(&self.analysis))
    }

    pub(super) fn of(analysis: Arc<Analysis>) -> Result<Self, FactorError> {
        let symbolic = &analysis.symbolic;
        let memory = match analysis.single {
            Some(_) => None,
            None => Some(allocated(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))?),
        };
        let factors = vec![0.0; symbolic.len_val()];
        Ok(Self { analysis, factors, memory, work: Vec::new(), ready: false })
    }
}

impl Analysis {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let (lower, source) = lower_triangle(pattern);
        let symbolic = factorize_symbolic_cholesky(
            lower.as_ref(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| FactorError::OutOfMemory)?;
        let (full_length, spare) = (pattern.len(), Mutex::new(None));
        let single = Rows::of(&symbolic, &lower, &source).zip(Columns::of(&symbolic));
        Ok(Self { lower, source, symbolic, single, full_length, spare })
    }

    /// Numbers stored for the factors.
    pub(super) fn fill(&self) -> usize {
        self.symbolic.len_val()
    }

    /// True if columns are taken one by one.
    pub(super) fn simplicial(&self) -> bool {
        matches!(self.symbolic.raw(), SymbolicCholeskyRaw::Simplicial(_))
    }

    /// Multiplications of a factorisation: the squares of the lengths of the columns.
    pub(super) fn products(&self) -> f64 {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(factor) => {
                let ends = factor.col_ptr().windows(2);
                ends.map(|ends| (ends[1] - ends[0]) as f64).map(|length| length * length).sum()
            }
            SymbolicCholeskyRaw::Supernodal(factor) => {
                let parts = factor.supernode_begin().iter().zip(factor.supernode_end());
                let lengths =
                    parts.zip(factor.nnz_per_super()).flat_map(|((begin, end), below)| {
                        (1..=end - begin).map(move |length| (length + below) as f64)
                    });
                lengths.map(|length| length * length).sum()
            }
        }
    }

    /// Memory for a factorisation; new if another thread has the shared one.
    fn workspace(&self) -> Result<Workspace, FactorError> {
        if let Some(spare) = taken(&self.spare) {
            return Ok(spare);
        }
        let (length, needed) = match self.single {
            Some(_) => (0, StackReq::EMPTY),
            None => {
                let spec = Spec::default();
                let needed = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, spec);
                (self.source.len(), needed)
            }
        };
        let (rows, lower_values) = (row_by_row::Memory::default(), vec![0.0; length]);
        Ok(Workspace { rows, lower_values, memory: allocated(needed)? })
    }

    fn factorize(&self, values: &[f64], factors: &mut [f64]) -> Result<(), FactorError> {
        let mut work = self.workspace()?;
        let done = match &self.single {
            Some((rows, columns)) => rows
                .factorize(&self.symbolic, values, factors, &mut work.rows)
                .map(|()| columns.arrange(factors)),
            None => {
                for (value, &slot) in work.lower_values.iter_mut().zip(&self.source) {
                    *value = values[slot];
                }
                let stack = MemStack::new(&mut work.memory);
                self.factorize_blocks(&work.lower_values, factors, stack)
            }
        };
        put(&self.spare, work);
        done.map_err(|position| FactorError::NotPositiveDefinite { index: self.row_at(position) })
    }

    /// Factors by faer; the error is the position of the pivot.
    fn factorize_blocks(
        &self,
        lower_values: &[f64],
        factors: &mut [f64],
        stack: &mut MemStack,
    ) -> Result<(), usize> {
        let lower = SparseColMatRef::new(self.lower.as_ref(), lower_values);
        let (plain, par, spec) = (Default::default(), Par::Seq, Spec::default());
        let llt = &self.symbolic;
        match llt.factorize_numeric_llt(factors, lower, Side::Lower, plain, par, stack, spec) {
            Ok(_) => Ok(()),
            // faer counts from 1 in its simplicial code and from 0 in its supernodal one
            Err(LltError::NonPositivePivot { index }) if self.simplicial() => {
                Err(index.saturating_sub(1))
            }
            Err(LltError::NonPositivePivot { index }) => Err(index),
        }
    }

    /// The row, in the order given by the caller, of a position in the order of elimination.
    fn row_at(&self, position: usize) -> usize {
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
        self.analysis.lower.nrows()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::SparseCholesky
    }

    fn fill(&self) -> usize {
        self.factors.len()
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self::sibling(self)?))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.analysis.full_length, values.len())?;
        let done = self.analysis.factorize(values, &mut self.factors);
        self.ready = done.is_ok();
        done
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |b| {
            if let Some((_, columns)) = &self.analysis.single {
                columns.solve(&self.factors, b, &mut self.work);
            }
            if let Some(memory) = &mut self.memory {
                let factors = LltRef::new(&self.analysis.symbolic, &self.factors);
                factors.solve_in_place_with_conj(
                    Conj::No,
                    column(b),
                    Par::Seq,
                    MemStack::new(memory),
                );
            }
        })
    }
}
