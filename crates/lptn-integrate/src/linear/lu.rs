//! Sparse LU by faer, analysed once.

use faer::dyn_stack::{MemBuffer, MemStack};
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
    structure: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLu<usize>,
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
        let memory = allocated(
            symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        )?;
        Ok(Self { structure, symbolic, numeric: NumericLu::new(), memory, ready: false })
    }
}

impl Factorization for SparseLu {
    fn size(&self) -> usize {
        self.structure.nrows()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::SparseLu
    }

    fn fill(&self) -> usize {
        self.structure.row_idx().len()
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.structure.row_idx().len(), values.len())?;
        let outcome = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            SparseColMatRef::new(self.structure.as_ref(), values),
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
            let factors = LuRef::new_unchecked(&self.symbolic, &self.numeric);
            let memory = MemStack::new(&mut self.memory);
            factors.solve_in_place_with_conj(Conj::No, column(b), Par::Seq, memory);
        })
    }
}
