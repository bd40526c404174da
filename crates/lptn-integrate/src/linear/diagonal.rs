//! Unknowns that do not reach each other: the massless surfaces of a body, each between its cell and
//! its surroundings.

use super::{Factorization, LinearSolverKind, checked, expect_length};
use crate::{FactorError, Pattern};

/// A diagonal matrix.
#[derive(Clone, Debug)]
pub struct Diagonal {
    values: Vec<f64>,
    symmetric: bool,
    ready: bool,
}

impl Diagonal {
    /// For matrices with this pattern; `None` if it has entries off the diagonal. `symmetric`
    /// ones must be positive.
    #[must_use]
    pub fn of(pattern: &Pattern, symmetric: bool) -> Option<Self> {
        let size = pattern.size();
        let diagonal = pattern.len() == size && pattern.diagonal().iter().copied().eq(0..size);
        diagonal.then(|| Self { values: vec![0.0; size], symmetric, ready: false })
    }

    /// True if it cannot be a pivot; NaN counts.
    fn fails(&self, value: f64) -> bool {
        let size = if self.symmetric { value } else { value.abs() };
        size.is_nan() || size <= 0.0
    }
}

impl Factorization for Diagonal {
    fn size(&self) -> usize {
        self.values.len()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::Diagonal
    }

    fn fill(&self) -> usize {
        self.values.len()
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self { ready: false, ..self.clone() }))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.values.len(), values.len())?;
        self.ready = false;
        match values.iter().position(|value| self.fails(*value)) {
            Some(index) if self.symmetric => Err(FactorError::NotPositiveDefinite { index }),
            Some(index) => Err(FactorError::Singular { index }),
            None => {
                self.values.copy_from_slice(values);
                self.ready = true;
                Ok(())
            }
        }
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.values.len(), self.ready), b, |b| {
            b.iter_mut().zip(&self.values).for_each(|(b, value)| *b /= value);
        })
    }
}
