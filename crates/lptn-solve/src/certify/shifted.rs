//! Solutions with `C - H A`, for capacities `C`, a Jacobian `A` and a time `H`.

use lptn_integrate::linear::{self, Factorization};
use lptn_integrate::{FactorError, Pattern};

/// Factors of `C - H A` for one matrix and one time after another.
pub(super) struct Shifted {
    pattern: Pattern,
    mass: Vec<f64>,
    factors: Box<dyn Factorization>,
    /// The matrix in W/K and the time in s of the present factors.
    of: Option<(Vec<f64>, f64)>,
}

impl Shifted {
    pub(super) fn new(pattern: &Pattern, mass: &[f64]) -> Result<Self, FactorError> {
        let factors = linear::for_exact(pattern)?;
        Ok(Self { pattern: pattern.clone(), mass: mass.to_vec(), factors, of: None })
    }

    /// Makes the factors for a time in s, unless they are known.
    pub(super) fn factorize(&mut self, time: f64, matrix: &[f64]) -> Option<()> {
        let is_same = |(of, at): &(Vec<f64>, f64)| at.to_bits() == time.to_bits() && of == matrix;
        if self.of.as_ref().is_some_and(is_same) {
            return Some(());
        }
        let mut values: Vec<f64> = matrix.iter().map(|a| -time * a).collect();
        for (i, mass) in self.mass.iter().enumerate() {
            values[self.pattern.diagonal_slot(i)] += mass;
        }
        self.of = None;
        self.factors.factorize(&values).ok()?;
        self.of = Some((matrix.to_vec(), time));
        Some(())
    }

    /// Replaces a right side in J by the solution in K.
    pub(super) fn solve(&mut self, right: &mut [f64]) -> Option<()> {
        self.factors.solve_in_place(right).ok()
    }
}

/// The next power of two: a run has few of them, so that factors serve many steps.
pub(super) fn power_of_two_above(length: f64) -> f64 {
    length.log2().ceil().exp2()
}
