//! Sparse LU by faer, analysed once.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::lu::{
    LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, Par, Spec};

use super::{Factorization, LinearSolverKind, allocated, checked, column, expect_length};
use crate::{FactorError, Pattern};

/// Sparse LU with column approximate minimum degree ordering and partial pivoting.
pub struct SparseLu {
    /// The pattern and its analysis.
    analysis: Arc<(SymbolicSparseColMat<usize>, SymbolicLu<usize>)>,
    numeric: NumericLu<usize, f64>,
    memory: MemBuffer,
    ready: bool,
}

impl SparseLu {
    /// Orders and analyses the pattern.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let n = pattern.size();
        let (pointers, rows) = (pattern.column_pointers().to_vec(), pattern.row_indices().to_vec());
        let structure = SymbolicSparseColMat::new_checked(n, n, pointers, None, rows);
        let symbolic = factorize_symbolic_lu(structure.as_ref(), LuSymbolicParams::default())
            .map_err(|_| FactorError::OutOfMemory)?;
        Self::of(Arc::new((structure, symbolic)))
    }

    /// Separate factors for other values in the same pattern, whose analysis is shared.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub fn sibling(&self) -> Result<Self, FactorError> {
        Self::of(Arc::clone(&self.analysis))
    }

    fn of(
        analysis: Arc<(SymbolicSparseColMat<usize>, SymbolicLu<usize>)>,
    ) -> Result<Self, FactorError> {
        let symbolic = &analysis.1;
        let memory = allocated(StackReq::any_of(&[
            symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]))?;
        Ok(Self { analysis, numeric: NumericLu::new(), memory, ready: false })
    }
}

impl Factorization for SparseLu {
    fn size(&self) -> usize {
        self.analysis.0.nrows()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::SparseLu
    }

    fn fill(&self) -> usize {
        self.analysis.0.row_idx().len()
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self::sibling(self)?))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let (structure, symbolic) = &*self.analysis;
        expect_length(structure.row_idx().len(), values.len())?;
        let outcome = symbolic.factorize_numeric_lu(
            &mut self.numeric,
            SparseColMatRef::new(structure.as_ref(), values),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        let failure = outcome.err();
        self.ready = failure.is_none();
        match failure {
            None => Ok(()),
            Some(LuError::SymbolicSingular { index }) => Err(FactorError::Singular { index }),
            Some(LuError::Generic(_)) => Err(FactorError::OutOfMemory),
        }
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |b| {
            let factors = LuRef::new_unchecked(&self.analysis.1, &self.numeric);
            let memory = MemStack::new(&mut self.memory);
            factors.solve_in_place_with_conj(Conj::No, column(b), Par::Seq, memory);
        })
    }
}
