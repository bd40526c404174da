//! Newton's method for the stages, with one matrix for as long as it converges.

use crate::linear::{self, Factorization};
use crate::{FactorError, LinearSolver, OdeSystem, Pattern, kernels};

/// Iterations after which a stage is given up.
const MOST: u32 = 8;

/// A rate of convergence above which the Jacobian is read again before the next step.
const SLOW: f64 = 0.1;

/// The change of `gamma h` beyond which the matrix is factorised again.
const OTHER: f64 = 0.01;

/// The matrix `M - g J` of the stages with its factors.
pub(super) struct Newton {
    pub(super) solver: Box<dyn Factorization>,
    pub(super) jacobian: Vec<f64>,
    /// `g` of the factors, in units of t.
    factored: Option<f64>,
    /// True if the Jacobian was read in this step.
    pub(super) fresh: bool,
    /// True if it must be read before the next step.
    pub(super) stale: bool,
    /// Rate of convergence: the last change over the one before.
    rate: f64,
    right: Vec<f64>,
    pub(super) factorizations: u64,
    pub(super) solves: u64,
}

/// The state of an iteration.
pub(super) enum Progress {
    /// Another one is needed.
    On,
    /// The stage is found.
    Found,
    /// It does not converge.
    Lost,
}

impl Newton {
    pub(super) fn new(
        pattern: &Pattern,
        symmetric: bool,
        choice: LinearSolver,
    ) -> Result<Self, FactorError> {
        Ok(Self {
            solver: linear::for_stages(pattern, symmetric, choice)?,
            jacobian: vec![0.0; pattern.len()],
            factored: None,
            fresh: false,
            stale: true,
            rate: 1.0,
            right: vec![0.0; pattern.size()],
            factorizations: 0,
            solves: 0,
        })
    }

    /// The system may be another one: its matrix is kept for as long as stages converge with it,
    /// and the next rate is measured.
    pub(super) fn doubt(&mut self) {
        self.rate = 1.0;
    }

    /// The Jacobian has been read: its factors are no longer those of the matrix.
    pub(super) fn renew(&mut self) {
        (self.fresh, self.stale, self.factored, self.rate) = (true, false, None, 1.0);
    }

    /// Factorises the matrix for `g` unless its factors serve.
    pub(super) fn factorize(&mut self, system: &impl OdeSystem, g: f64) -> Result<(), FactorError> {
        if self.factored.is_some_and(|had| (g - had).abs() <= OTHER * had) {
            return Ok(());
        }
        let mut values: Vec<f64> = self.jacobian.iter().map(|j| -g * j).collect();
        for (mass, &slot) in system.mass().iter().zip(system.pattern().diagonal()) {
            values[slot] += mass;
        }
        self.factored = None;
        self.factorizations += 1;
        self.solver.factorize(&values)?;
        (self.factored, self.rate) = (Some(g), 1.0);
        Ok(())
    }

    /// Replaces `right`, one value a state, by the solution.
    pub(super) fn solve(&mut self, right: &mut [f64]) -> Result<(), FactorError> {
        let states = right.len();
        self.right[..states].copy_from_slice(right);
        self.right[states..].fill(0.0);
        self.solves += 1;
        self.solver.solve_in_place(&mut self.right)?;
        right.copy_from_slice(&self.right[..states]);
        Ok(())
    }

    /// Judges a change of a stage by the one before it, `None` in the first iteration; `allowed` in
    /// units of y.
    pub(super) fn judge(
        &mut self,
        (iteration, change, before): (u32, f64, Option<f64>),
        allowed: f64,
    ) -> Progress {
        if let Some(before) = before.filter(|before| *before > 0.0) {
            let rate = change / before;
            // rounding is not a reason to read the Jacobian again
            if change > allowed && rate >= 1.0 {
                return Progress::Lost;
            }
            self.rate = rate.clamp(1e-4, 0.9);
            self.stale |= rate > SLOW && change > allowed;
        }
        let left = change * self.rate / (1.0 - self.rate).max(0.1);
        match left <= allowed || change <= 1e-3 * allowed {
            true => Progress::Found,
            false if iteration + 1 >= MOST => Progress::Lost,
            false => Progress::On,
        }
    }
}

/// Largest absolute value.
pub(super) fn size_of(values: &[f64]) -> f64 {
    match kernels::first_not_finite(values) {
        Some(_) => f64::INFINITY,
        None => values.iter().fold(0.0, |most, value| value.abs().max(most)),
    }
}
