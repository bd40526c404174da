//! Balances of massless nodes that have more than one solution: one is followed while it lasts, and
//! left only where it ends.
//!
//! A massless node is the limit of one with a small capacity: `c dz/ds = g(y, z)` with c towards 0.
//! A stable solution of `g = 0` lasts until its Jacobian becomes singular (a fold), where it meets
//! an unstable one. Beyond the fold, z moves in no time to where `c dz/ds = g` leads from there
//! (the reduction of singularly perturbed systems, A. N. Tikhonov, Mat. Sb. 31 (1952) 575).
//! Newton's method alone ignores this: it falls to any other solution, before or after the fold.
//!
//! The heat flow refuses a solution beyond temperatures at which nothing rests. If no other
//! solution is found at the end of a branch, the run stops. Rows are found from the ends of the
//! step, so that the output has no effect on the solution.

use lptn_assembly::Workspace;
use lptn_integrate::Pattern;

use crate::newton::{Newton, largest};
use crate::newton_error::NewtonError;

/// The longest step of a jump in K.
const STRIDE: f64 = 0.25;

/// Most steps of a jump.
const STRIDES: usize = 5000;

/// Ratio of one step of a jump to the one before.
const LONGER: f64 = 1.5;

/// The shortest step, over the time constant of the node.
const SHORTEST: f64 = 1e-12;

impl Newton<'_> {
    /// Moves the free unknowns from `temperatures` to their rest while nothing else moves: to the
    /// same solution if it still exists, else to another one.
    ///
    /// # Errors
    /// [`NewtonError`] if there is no rest.
    pub(crate) fn leap(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        match self.follow(work, temperatures) {
            Err(NewtonError::Fold { .. }) => self.come_to_rest(work, temperatures),
            other => other,
        }
    }

    /// Follows `c dz/ds = g` by linearly implicit steps so short that none passes a place of rest.
    fn come_to_rest(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        let capacity = self.small_capacities(work, temperatures)?;
        let mut step = 0.01;
        for _ in 0..STRIDES {
            if let Some(rest) = self.rest_nearby(work, temperatures) {
                temperatures.copy_from_slice(&rest);
                return self.factorize(work, temperatures, 0.0);
            }
            let Some(stride) = self.stride(work, temperatures, (&capacity, &mut step))? else {
                break;
            };
            if largest(&stride) <= 0.0 {
                break; // nothing moves it
            }
            self.apply(&stride, 1.0, temperatures);
            step *= LONGER;
        }
        Err(NewtonError::Stalled { unknown: self.free[0], change: STRIDE })
    }

    /// One step, shortened until it is one that the differential equation would take; `None` if
    /// there is none.
    fn stride(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
        (capacity, step): (&[f64], &mut f64),
    ) -> Result<Option<Vec<f64>>, NewtonError> {
        while *step > SHORTEST {
            self.linearize(work, temperatures)?;
            for (&slot, c) in self.pattern.diagonal().iter().zip(capacity) {
                self.values[slot] += c / *step;
            }
            if self.runs_away(true).is_some() {
                *step *= 0.25;
                continue;
            }
            let correction = self.correction(work, temperatures)?;
            if largest(&correction) <= STRIDE {
                return Ok(Some(correction));
            }
            *step *= 0.5;
        }
        Ok(None)
    }

    /// The solution that is so near that the steps would come to it.
    fn rest_nearby(&mut self, work: &mut Workspace, temperatures: &[f64]) -> Option<Vec<f64>> {
        if !matches!(self.unstable(work, temperatures), Ok(None)) {
            return None;
        }
        self.factorize(work, temperatures, 0.0).ok()?;
        if largest(&self.correction(work, temperatures).ok()?) > STRIDE {
            return None;
        }
        let mut rest = temperatures.to_vec();
        self.damped(work, &mut rest).ok()?;
        let far = rest.iter().zip(temperatures).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (far <= 2.0 * STRIDE && self.stays(work, temperatures, &rest).is_ok()).then_some(rest)
    }

    /// Substitutes for the capacities: for each free unknown all the heat flows that its
    /// temperature changes, in W/K, so that their time constants are much alike.
    fn small_capacities(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<Vec<f64>, NewtonError> {
        self.linearize(work, temperatures)?;
        let whole = Pattern::from_symbolic(self.system.pattern().symbolic());
        let size = |i: usize| whole.column(i).map(|slot| self.whole[slot].abs()).sum::<f64>();
        Ok(self.free.iter().map(|&i| size(i)).map(|c| if c > 0.0 { c } else { 1.0 }).collect())
    }
}
