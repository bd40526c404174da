//! Whether a steady state stays where it is.
//!
//! Let `A = -J` on the unknowns solved for. Where warming one of them never cools another directly
//! (off the diagonal `A` has no positive entry), the state is stable exactly if `A` is an M-matrix:
//! if some positive `x` has a positive `A x` (A. Berman and R. J. Plemmons, Nonnegative Matrices in
//! the Mathematical Sciences, SIAM 1994, chapter 6, theorem 2.3, conditions I27 and G20), whatever
//! the capacities are. The same test on `A` with the magnitudes of these entries is sufficient for
//! any other network (H-matrices, the same, exercise 5.13). Where that leaves it open, small
//! disturbances are followed with the capacities, in steps of the trapezoidal rule of many lengths:
//! it enlarges what grows and nothing else, whatever the length.

use lptn_assembly::Workspace;

use crate::newton::{Newton, NewtonError};

/// Steps that a disturbance is followed for, twice.
const FOLLOWED: usize = 100;

/// From one length of steps to the next.
const LONGER: f64 = 4.0;

/// A disturbance that grows by more than this in as many steps keeps growing.
const GROWTH: f64 = 1.5;

/// Lengths of steps that are tried at most.
const LENGTHS: usize = 60;

impl Newton<'_> {
    /// The unknown that a small disturbance moves most, if the state at `temperatures` (all
    /// unknowns, in K) is not stable.
    pub(crate) fn unstable(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<Option<usize>, NewtonError> {
        self.factorize(work, temperatures, 0.0)?;
        let exact = self.values.clone();
        let mut cools = false;
        for column in 0..self.pattern.size() {
            for slot in self.pattern.column(column) {
                if self.pattern.row_indices()[slot] != column {
                    cools |= self.values[slot] > 0.0;
                    self.values[slot] = -self.values[slot].abs();
                }
            }
        }
        match self.runs_away(cools) {
            None => Ok(None),
            Some(place) if !cools => Ok(Some(self.free[place])),
            Some(_) => Ok(self.grows(&exact).map(|place| self.free[place])),
        }
    }

    /// The place that shows that the values are no M-matrix; `None` if they are one. `new`: they
    /// are not factorised yet.
    pub(crate) fn runs_away(&mut self, new: bool) -> Option<usize> {
        let diagonal = self.pattern.diagonal();
        if let Some(place) = diagonal.iter().position(|&slot| self.values[slot] <= 0.0) {
            return Some(place);
        }
        let mut x: Vec<f64> = diagonal.iter().map(|&slot| self.values[slot]).collect();
        let factorized = if new { self.factors.factorize(&self.values) } else { Ok(()) };
        if factorized.and_then(|()| self.factors.solve_in_place(&mut x)).is_err() {
            return Some(0);
        }
        let least = x.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
        least.filter(|(_, x)| x.is_nan() || **x <= 0.0).map(|(place, _)| place)
    }

    /// The place that moves most in a disturbance that grows.
    fn grows(&mut self, exact: &[f64]) -> Option<usize> {
        let mass: Vec<f64> = self.free.iter().map(|&i| self.system.mass()[i]).collect();
        let slots = self.pattern.diagonal().iter().zip(&mass).filter(|(_, mass)| **mass > 0.0);
        let rates = slots.map(|(&slot, mass)| exact[slot].abs() / mass).filter(|rate| *rate > 0.0);
        let (slow, fast) =
            rates.fold((f64::INFINITY, 0.0_f64), |(a, b), rate| (a.min(rate), b.max(rate)));
        let mut step = 0.1 / fast;
        for _ in 0..LENGTHS {
            if step.is_nan() || step * slow >= 1e4 {
                break;
            }
            if let Some(place) = self.grows_in(step, exact, &mass) {
                return Some(place);
            }
            step *= LONGER;
        }
        None
    }

    /// The same with steps of one length in s.
    fn grows_in(&mut self, step: f64, exact: &[f64], mass: &[f64]) -> Option<usize> {
        self.values.iter_mut().zip(exact).for_each(|(value, exact)| *value = 0.5 * step * exact);
        for (&slot, mass) in self.pattern.diagonal().iter().zip(mass) {
            self.values[slot] += mass;
        }
        self.factors.factorize(&self.values).ok()?;
        // no pattern that a network is likely to have is orthogonal to this one
        let mut x: Vec<f64> = (0..mass.len()).map(|i| 1.0 + 0.5 * (1.7 * i as f64).sin()).collect();
        let mut heat = vec![0.0; x.len()];
        let mut grown = 1.0;
        for k in 0..2 * FOLLOWED {
            self.pattern.multiply(exact, &x, &mut heat);
            let stored = x.iter_mut().zip(mass).zip(&heat);
            stored.for_each(|((x, mass), heat)| {
                *x = if *mass > 0.0 { mass * *x - 0.5 * step * heat } else { 0.0 }
            });
            self.factors.solve_in_place(&mut x).ok()?;
            let size = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if !(size > 0.0 && size.is_finite()) {
                return None;
            }
            x.iter_mut().for_each(|x| *x /= size);
            if k >= FOLLOWED {
                grown *= size;
            }
        }
        let most = x.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        most.filter(|_| grown > GROWTH).map(|(place, _)| place)
    }
}
