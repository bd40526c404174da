//! A symmetric solver if possible, another one if necessary.

use super::{Factorization, LinearSolverKind, cost, expect_length};
use crate::{FactorError, Pattern};

/// A solver for values that are symmetric and positive definite, another one for the rest.
///
/// The values are checked again with every set: the Jacobian of a body that radiates to its
/// surroundings is symmetric, that of one whose conductivity depends on temperature is not, and LU
/// of a large body takes many times as long. Each is analysed when it is first needed.
pub struct Either {
    pattern: Pattern,
    /// For each slot above the diagonal its own place and that of its mirror image.
    mirrored: Vec<(usize, usize)>,
    cholesky: Option<Box<dyn Factorization>>,
    lu: Option<Box<dyn Factorization>>,
    /// True if `cholesky` has the factors, else `lu` has them.
    symmetric: bool,
    /// The values, if iterations may still find that they are not positive definite.
    values: Vec<f64>,
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
        let (pattern, values) = (pattern.clone(), Vec::new());
        Self { pattern, mirrored, cholesky: None, lu: None, symmetric: false, values }
    }

    /// True if the values are symmetric apart from the rounding of sums.
    fn is_symmetric(&self, values: &[f64]) -> bool {
        self.mirrored.iter().all(|&(a, b)| {
            let (a, b) = (values[a], values[b]);
            (a - b).abs() <= 1e-14 * a.abs().max(b.abs())
        })
    }

    /// True if the values are positive definite, as far as factors show.
    fn is_definite(&mut self, values: &[f64]) -> bool {
        if self.cholesky.is_none() {
            self.cholesky = cost::steady(&self.pattern).ok();
        }
        let Some(cholesky) = &mut self.cholesky else { return false };
        let definite = cholesky.factorize(values).is_ok();
        self.values.clear();
        if definite && cholesky.kind() != LinearSolverKind::SparseCholesky {
            self.values.extend_from_slice(values);
        }
        definite
    }

    /// Solves with the factors that there are.
    fn solve_by(
        &mut self,
        b: &mut [f64],
        solve: impl Fn(&mut dyn Factorization, &mut [f64]) -> Result<(), FactorError>,
    ) -> Result<(), FactorError> {
        if !self.symmetric {
            let lu = self.lu.as_mut().ok_or(FactorError::NotFactorized)?;
            return solve(lu.as_mut(), b);
        }
        let right = if self.values.is_empty() { Vec::new() } else { b.to_vec() };
        let cholesky = self.cholesky.as_mut().ok_or(FactorError::NotFactorized)?;
        match solve(cholesky.as_mut(), b) {
            Err(FactorError::NotPositiveDefinite { .. }) if !right.is_empty() => {
                let values = std::mem::take(&mut self.values);
                self.factorize_any(&values)?;
                b.copy_from_slice(&right);
                self.solve_by(b, solve)
            }
            done => done,
        }
    }

    fn factorize_any(&mut self, values: &[f64]) -> Result<(), FactorError> {
        self.symmetric = false;
        if self.lu.is_none() {
            self.lu = Some(cost::steady_not_symmetric(&self.pattern)?);
        }
        self.lu.as_mut().map_or(Err(FactorError::NotFactorized), |lu| lu.factorize(values))
    }
}

impl Factorization for Either {
    fn size(&self) -> usize {
        self.pattern.size()
    }

    fn kind(&self) -> LinearSolverKind {
        let (used, kind) = match self.symmetric {
            true => (&self.cholesky, LinearSolverKind::SparseCholesky),
            false => (&self.lu, LinearSolverKind::SparseLu),
        };
        used.as_ref().map_or(kind, |used| used.kind())
    }

    fn fill(&self) -> usize {
        match &self.cholesky {
            Some(cholesky) if self.symmetric => cholesky.fill(),
            _ => self.lu.as_ref().map_or(self.pattern.len(), |lu| lu.fill()),
        }
    }

    fn iterations(&self) -> u64 {
        self.cholesky.iter().chain(&self.lu).map(|solver| solver.iterations()).sum()
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        let cholesky = self.cholesky.as_ref().map(|cholesky| cholesky.sibling()).transpose()?;
        let lu = self.lu.as_ref().map(|lu| lu.sibling()).transpose()?;
        let (pattern, mirrored) = (self.pattern.clone(), self.mirrored.clone());
        Ok(Box::new(Self { pattern, mirrored, cholesky, lu, symmetric: false, values: Vec::new() }))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.pattern.len(), values.len())?;
        self.symmetric = self.is_symmetric(values) && self.is_definite(values);
        if self.symmetric { Ok(()) } else { self.factorize_any(values) }
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        self.solve_by(b, |factors, b| factors.solve_in_place(b))
    }

    fn solve_share(&mut self, b: &mut [f64], share: f64) -> Result<(), FactorError> {
        self.solve_by(b, |factors, b| factors.solve_share(b, share))
    }
}
