//! Cholesky where it can be, LU where it must be.

use super::{Factorization, LinearSolverKind, SparseCholesky, SparseLu, expect_length};
use crate::{FactorError, Pattern};

/// Sparse Cholesky for values that are symmetric and positive definite, sparse LU for others.
/// Looked at anew with every set of values: the Jacobian of a body that radiates to its
/// surroundings is symmetric, that of one whose conductivity depends on temperature is not, and LU
/// of a large body takes many times as long. Each is analysed when it is first needed.
pub struct Either {
    pattern: Pattern,
    /// For each slot above the diagonal its own place and that of its mirror image.
    mirrored: Vec<(usize, usize)>,
    cholesky: Option<SparseCholesky>,
    lu: Option<SparseLu>,
    /// Which of them holds the factors.
    symmetric: bool,
}

impl Either {
    /// For matrices with this pattern.
    #[must_use]
    pub fn new(pattern: &Pattern) -> Self {
        let mut mirrored = Vec::with_capacity(pattern.len() / 2);
        // columns in order meet the entries of each row in order
        let mut next: Vec<usize> =
            (0..pattern.size()).map(|row| pattern.diagonal_slot(row) + 1).collect();
        for column in 0..pattern.size() {
            for slot in pattern.column(column).start..pattern.diagonal_slot(column) {
                let row = pattern.row_indices()[slot];
                mirrored.push((slot, next[row]));
                next[row] += 1;
            }
        }
        Self { pattern: pattern.clone(), mirrored, cholesky: None, lu: None, symmetric: false }
    }

    /// Whether the values are symmetric but for the rounding of sums.
    fn is_symmetric(&self, values: &[f64]) -> bool {
        self.mirrored.iter().all(|&(a, b)| {
            let (a, b) = (values[a], values[b]);
            (a - b).abs() <= 1e-14 * a.abs().max(b.abs())
        })
    }

    /// Whether Cholesky succeeds.
    fn is_definite(&mut self, values: &[f64]) -> bool {
        if self.cholesky.is_none() {
            self.cholesky = SparseCholesky::new(&self.pattern).ok();
        }
        self.cholesky.as_mut().is_some_and(|cholesky| cholesky.factorize(values).is_ok())
    }
}

impl Factorization for Either {
    fn size(&self) -> usize {
        self.pattern.size()
    }

    fn kind(&self) -> LinearSolverKind {
        if self.symmetric { LinearSolverKind::SparseCholesky } else { LinearSolverKind::SparseLu }
    }

    fn fill(&self) -> usize {
        match &self.cholesky {
            Some(cholesky) if self.symmetric => cholesky.fill(),
            _ => self.pattern.len(),
        }
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        let cholesky = self.cholesky.as_ref().map(SparseCholesky::sibling).transpose()?;
        let lu = self.lu.as_ref().map(SparseLu::sibling).transpose()?;
        let (pattern, mirrored) = (self.pattern.clone(), self.mirrored.clone());
        Ok(Box::new(Self { pattern, mirrored, cholesky, lu, symmetric: false }))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.pattern.len(), values.len())?;
        self.symmetric = self.is_symmetric(values) && self.is_definite(values);
        if self.symmetric {
            return Ok(());
        }
        if self.lu.is_none() {
            self.lu = Some(SparseLu::new(&self.pattern)?);
        }
        self.lu.as_mut().map_or(Err(FactorError::NotFactorized), |lu| lu.factorize(values))
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        match (&mut self.cholesky, &mut self.lu) {
            (Some(cholesky), _) if self.symmetric => cholesky.solve_in_place(b),
            (_, Some(lu)) => lu.solve_in_place(b),
            _ => Err(FactorError::NotFactorized),
        }
    }
}
