//! Stability of a steady state.
//!
//! Let `A = -J` on the unknowns solved for. If warming one of them never cools another directly
//! (off the diagonal `A` has no positive entry), the state is stable exactly if `A` is an M-matrix:
//! if some positive `x` has a positive `A x` (A. Berman and R. J. Plemmons, Nonnegative Matrices in
//! the Mathematical Sciences, SIAM 1994, chapter 6, theorem 2.3, conditions I27 and G20), whatever
//! the capacities are. The same test on `A` with the magnitudes of these entries is sufficient for
//! any other network (H-matrices, the same, exercise 5.13). If that leaves it open, the capacities
//! decide. Up to [`DENSE`] unknowns powers of a step of the trapezoidal rule do (`powers.rs`).
//! Beyond that, a disturbance is followed in steps of many lengths until it has grown beyond the
//! transient growth of any that dies. Massless nodes follow at once; their balances rest as long as
//! their determinant has not changed its sign.
//!
//! Newton's method finds unstable states as well. An unstable state is replaced by the state to
//! which pseudo-time leads from the start, or refused. Plain loops decide, in the same way on every
//! processor; eigenvalues by faer would depend on it and prove nothing.

use lptn_assembly::Workspace;

use crate::newton::Newton;
use crate::newton_error::NewtonError;
use crate::powers::Square;

/// Up to this number of unknowns nothing is left open.
const DENSE: usize = 100;

/// Steps for which a disturbance is followed before its growth counts, and at least afterwards.
const FOLLOWED: usize = 100;

/// Most steps for which a growing disturbance is followed.
const LONGEST: usize = 20_000;

/// Ratio of one length of steps to the one before.
const LONGER: f64 = 4.0;

/// A disturbance that grows by less than this in as many steps is not followed further.
const GROWTH: f64 = 1.5;

/// A disturbance that has grown by this grows without end: no transient growth reaches it.
const FOR_EVER: f64 = 1e6;

/// Most lengths of steps that are tried.
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

    /// An index at which the values fail to be an M-matrix; `None` if they are one. `new`: they are
    /// not factorised yet.
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

    /// The index of the largest move in a disturbance that grows.
    fn grows(&mut self, exact: &[f64]) -> Option<usize> {
        let mass: Vec<f64> = self.free.iter().map(|&i| self.system.mass()[i]).collect();
        let small = mass.len() <= DENSE;
        if let Some(place) = small.then(|| self.massless_grow(exact, &mass)).flatten() {
            return Some(place);
        }
        let slots = self.pattern.diagonal().iter().zip(&mass).filter(|(_, mass)| **mass > 0.0);
        let rates = slots.map(|(&slot, mass)| exact[slot].abs() / mass).filter(|rate| *rate > 0.0);
        let (slow, fast) =
            rates.fold((f64::INFINITY, 0.0_f64), |(a, b), rate| (a.min(rate), b.max(rate)));
        if fast <= 0.0 {
            return None;
        }
        if small {
            let step = 1.0 / (slow * fast).sqrt();
            // one that grows just as fast as a step is long makes it singular
            let mut tried = [step, 1.3 * step].into_iter();
            return tried.find_map(|step| self.step_of_all(step, exact, &mass))?.grows();
        }
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

    /// The index of a massless node if the determinant of their own balances is not positive: it is
    /// positive at rest, and changes its sign at the end of a solution.
    fn massless_grow(&self, exact: &[f64], mass: &[f64]) -> Option<usize> {
        let massless: Vec<usize> = (0..mass.len()).filter(|&i| mass[i] <= 0.0).collect();
        let mut own = Square::zero(massless.len());
        for (j, &column) in massless.iter().enumerate() {
            for slot in self.pattern.column(column) {
                if let Ok(i) = massless.binary_search(&self.pattern.row_indices()[slot]) {
                    own.column_mut(j)[i] = exact[slot];
                }
            }
        }
        (own.sign() <= 0.0).then(|| massless[0])
    }

    /// True if a growing disturbance (all unknowns, in K) oscillates: if warming one node cools
    /// another, an even number of them grows if the determinant of `A` is positive.
    pub(crate) fn swings(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<bool, NewtonError> {
        self.linearize(work, temperatures)?;
        let size = self.pattern.size();
        let mut all = Square::zero(size.min(DENSE));
        let mut cools = false;
        for column in (0..size).filter(|_| size <= DENSE) {
            for slot in self.pattern.column(column) {
                let row = self.pattern.row_indices()[slot];
                all.column_mut(column)[row] = self.values[slot];
                cools |= row != column && self.values[slot] > 0.0;
            }
        }
        Ok(cools && all.sign() > 0.0)
    }

    /// Sets `M + h/2 A` as the matrix that is solved with; `None` if that fails.
    fn factorize_step(&mut self, step: f64, exact: &[f64], mass: &[f64]) -> Option<()> {
        self.values.iter_mut().zip(exact).for_each(|(value, exact)| *value = 0.5 * step * exact);
        for (&slot, mass) in self.pattern.diagonal().iter().zip(mass) {
            self.values[slot] += mass;
        }
        self.factors.factorize(&self.values).ok()
    }

    /// The step of one length in s that advances every disturbance, in the square roots of the
    /// capacities in J/K, or for massless nodes of their heat per K in a step.
    fn step_of_all(&mut self, step: f64, exact: &[f64], mass: &[f64]) -> Option<Square> {
        self.factorize_step(step, exact, mass)?;
        let stands = |(mass, &slot): (&f64, &usize)| match *mass {
            mass if mass > 0.0 => mass.sqrt(),
            _ => (step * exact[slot].abs()).sqrt().max(f64::MIN_POSITIVE),
        };
        let root: Vec<f64> = mass.iter().zip(self.pattern.diagonal()).map(stands).collect();
        let mut all = Square::zero(mass.len());
        for j in 0..mass.len() {
            let column = all.column_mut(j);
            column[j] = mass[j];
            for slot in self.pattern.column(j) {
                column[self.pattern.row_indices()[slot]] -= 0.5 * step * exact[slot];
            }
            // the balances of massless nodes are solved at the end of every step
            column
                .iter_mut()
                .zip(mass)
                .filter(|(_, mass)| **mass <= 0.0)
                .for_each(|(x, _)| *x = 0.0);
            self.factors.solve_in_place(column).ok()?;
            column.iter_mut().zip(&root).for_each(|(x, of)| *x *= of / root[j]);
        }
        Some(all)
    }

    /// The index of the largest move in a disturbance that grows in steps of one length in s.
    fn grows_in(&mut self, step: f64, exact: &[f64], mass: &[f64]) -> Option<usize> {
        self.factorize_step(step, exact, mass)?;
        // no pattern that a network is likely to have is orthogonal to this one
        let mut x: Vec<f64> = (0..mass.len()).map(|i| 1.0 + 0.5 * (1.7 * i as f64).sin()).collect();
        let mut heat = vec![0.0; x.len()];
        let mut grown = 1.0;
        for k in 0..LONGEST {
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
            let known = grown > FOR_EVER || (k >= 2 * FOLLOWED && grown < GROWTH);
            if known {
                break;
            }
        }
        let most = x.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        most.filter(|_| grown > FOR_EVER).map(|(place, _)| place)
    }
}

#[cfg(test)]
mod tests;
