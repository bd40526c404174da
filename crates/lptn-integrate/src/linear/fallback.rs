//! Exact factors that take over if iterations fail.

use super::Factorization;
use super::shape::Shape;
use crate::{FactorError, Pattern, kernels};

/// Factors of more products than this are not made: those of 90 x 90 x 90 cells take 8 GB.
const MOST_PRODUCTS: f64 = 2.5e12;

/// Exact factors of a matrix `S A S`.
pub(super) struct Fallback {
    factors: Box<dyn Factorization>,
    /// The diagonal of `S`, by rows of the pattern.
    scale: Vec<f64>,
}

impl Fallback {
    /// Factorises `S A S` with these values in the slots of the pattern; `scale` is in the
    /// order of the shape.
    ///
    /// # Errors
    /// [`FactorError`]: singular, not positive definite, or factors that no memory can store.
    pub(super) fn new(
        shape: &Shape,
        (values, scale): (Vec<f64>, &[f64]),
        solver: impl FnOnce(&Pattern) -> Result<Box<dyn Factorization>, FactorError>,
    ) -> Result<Self, FactorError> {
        if shape.products() > MOST_PRODUCTS {
            return Err(FactorError::OutOfMemory);
        }
        let mut by_row = vec![0.0; scale.len()];
        shape.order.iter().zip(scale).for_each(|(&row, scale)| by_row[row as usize] = *scale);
        let mut factors = solver(&shape.pattern())?;
        factors.factorize(&values)?;
        Ok(Self { factors, scale: by_row })
    }

    /// Writes the solution of `A x = b`.
    ///
    /// # Errors
    /// [`FactorError::Singular`] if it is not finite.
    pub(super) fn solve(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), FactorError> {
        kernels::zip(b, &self.scale, x, |b, scale| scale * b);
        self.factors.solve_in_place(x)?;
        kernels::zip_in_place(x, &self.scale, |x, scale| scale * x);
        kernels::first_not_finite(x).map_or(Ok(()), |index| Err(FactorError::Singular { index }))
    }

    /// Numbers stored.
    pub(super) fn fill(&self) -> usize {
        self.factors.fill() + self.scale.len()
    }
}
