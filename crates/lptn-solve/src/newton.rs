//! Newton's method for the balances of some unknowns, the others fixed: steady states and massless
//! nodes.
//!
//! Steps are damped until the simplified correction shrinks (the natural monotonicity test; P.
//! Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004, section 3.3). If that stalls,
//! the balances are followed over a pseudo-time whose steps grow as the heat that is left over
//! shrinks (switched evolution relaxation; C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35
//! (1998) 508). It ends where a network that stores heat in every node would.

use lptn_assembly::{Part, ThermalSystem, Workspace};
use lptn_integrate::linear::{self, Factorization};
use lptn_integrate::{FactorError, Pattern};

use crate::newton_error::NewtonError;

/// Corrections below this, in K, are the last: near 300 K the last digit is 6e-14 K.
pub(crate) const SMALL: f64 = 1e-9;

/// No larger correction in K counts as rounding.
const MOST_ROUNDING: f64 = 1e-5;

/// Corrections to follow a solution that moves, below this in K.
const FOLLOWED: f64 = 1e-10;

/// Safety factor of a predicted correction.
const SURELY: f64 = 4.0;

/// A solution that moves further than this in K at once may be another one.
const FAR: f64 = 1.0;

/// Iterations with full or damped steps.
const ITERATIONS: usize = 60;

/// Relative rounding error of the size of a correction.
const ROUNDING: f64 = 1e-12;

/// The smallest part of the largest careful share of a correction that is tried.
const LEAST_SHARE: f64 = 1.0 / 1024.0;

/// Steps of pseudo-time.
const PSEUDO_STEPS: usize = 3000;

/// Iterations with the same factors, as long as each correction is at most this part of the one
/// before.
const REUSED: usize = 6;
const CONTRACTION: f64 = 0.25;

/// The share of the residual that a correction may leave if factors are not exact: the next one
/// removes it.
const SHARE: f64 = 1e-4;

/// Newton's method on a range of unknowns.
pub(crate) struct Newton<'a> {
    pub(crate) system: &'a ThermalSystem,
    /// The unknowns that are solved for, ascending.
    pub(crate) free: Vec<usize>,
    /// The part of the system with their balances; `None` if that is the whole system.
    part: Option<Part>,
    pub(crate) pattern: Pattern,
    /// The slot in the whole Jacobian of each slot of the pattern.
    slots: Vec<usize>,
    pub(crate) factors: Box<dyn Factorization>,
    /// True if the factors are those of some earlier point.
    pub(crate) ready: bool,
    /// The matrix with whose factors evaluations begin, and a flag that these are present
    /// (`anchor.rs`).
    pub(crate) base: Vec<f64>,
    pub(crate) leans: bool,
    /// True if the balances may have several solutions, so that one must not be left for another.
    pub(crate) guarded: bool,
    /// True once the reason of a failure was searched for with the end values of tables.
    tried: bool,
    /// The whole Jacobian, once it is needed.
    pub(crate) whole: Vec<f64>,
    pub(crate) values: Vec<f64>,
    flow: Vec<f64>,
}

impl<'a> Newton<'a> {
    pub(crate) fn new(system: &'a ThermalSystem, free: Vec<usize>) -> Result<Self, NewtonError> {
        let whole = Pattern::from_symbolic(system.pattern().symbolic());
        let mut entries = Vec::new();
        let mut slots = Vec::new();
        // columns in order, rows ascending, as the slots of the pattern are
        for (column, &from) in free.iter().enumerate() {
            for slot in whole.column(from) {
                if let Ok(row) = free.binary_search(&whole.row_indices()[slot]) {
                    entries.push((row, column));
                    slots.push(slot);
                }
            }
        }
        let pattern = Pattern::new(free.len(), entries.into_iter());
        let factors = linear::for_exact(&pattern).map_err(NewtonError::Factorization)?;
        let values = vec![0.0; pattern.len()];
        let flow = vec![0.0; system.unknowns().len()];
        let part = (free.len() < flow.len()).then(|| system.part(&free));
        Ok(Self {
            system,
            free,
            part,
            pattern,
            slots,
            factors,
            ready: false,
            base: Vec::new(),
            leans: false,
            guarded: false,
            tried: false,
            whole: Vec::new(),
            values,
            flow,
        })
    }

    /// Moves the free ones of `temperatures` (all unknowns, in K) from the solution of a moment ago
    /// to that of now.
    pub(crate) fn follow(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        let mut start = temperatures.to_vec();
        if self.ready && self.contract(work, temperatures) == Some(true) {
            let far = self.guarded && self.moved(&start, temperatures) > FAR;
            if !far || self.stays(work, &start, temperatures).is_ok() {
                return Ok(());
            }
        }
        temperatures.copy_from_slice(&start);
        // of several solutions only a near one is the same; a step to another is a jump
        let mut solved = match self.guarded {
            true => self.damped(work, temperatures),
            false => self.solve(work, temperatures),
        };
        match &solved {
            Err(NewtonError::Input(_)) if self.guarded => {
                temperatures.copy_from_slice(&start);
                solved = self.solve(work, temperatures);
            }
            // pressures come first: they determine flows, and flows determine temperatures
            Err(NewtonError::Singular { .. }) if self.guarded => {
                self.balance_states(work, &mut start);
                temperatures.copy_from_slice(&start);
                solved = self.damped(work, temperatures);
            }
            _ => {}
        }
        if self.guarded {
            solved = match solved {
                Ok(()) => self.stays(work, &start, temperatures),
                // at the end of a branch there is no solution nearby, and none may have been found
                // elsewhere
                Err(NewtonError::Stalled { unknown, .. }) => Err(NewtonError::Fold { unknown }),
                other => other,
            };
        }
        if solved.is_err() {
            temperatures.copy_from_slice(&start); // the next search begins where one succeeded
        }
        solved
    }

    /// Largest move of the free unknowns, in K.
    pub(crate) fn moved(&self, from: &[f64], to: &[f64]) -> f64 {
        self.free.iter().map(|&i| (to[i] - from[i]).abs()).fold(0.0, f64::max)
    }

    /// Corrections with the present factors; true if they led to the solution. `None`: a value
    /// failed.
    fn contract(&mut self, work: &mut Workspace, temperatures: &mut [f64]) -> Option<bool> {
        let mut last = f64::INFINITY;
        for _ in 0..REUSED {
            let correction = self.correction(work, temperatures).ok()?;
            let size = largest(&correction);
            if !(size <= CONTRACTION * last || size <= FOLLOWED) {
                return Some(false);
            }
            self.apply(&correction, 1.0, temperatures);
            // the next one is smaller by the same ratio
            let next = if last.is_finite() { SURELY * size * (size / last) } else { size };
            if size.min(next) <= FOLLOWED {
                return Some(true);
            }
            last = size;
        }
        Some(false)
    }

    /// Solves the balances of the free unknowns, starting from `temperatures` (all unknowns, in K).
    pub(crate) fn solve(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        self.balance_states(work, temperatures);
        let mut start = temperatures.to_vec();
        let mut solved = self.damped(work, temperatures);
        if let Err(NewtonError::Input(_)) = solved
            && self.bring_inside(work, &mut start)
        {
            temperatures.copy_from_slice(&start);
            solved = self.damped(work, temperatures).or(solved);
        }
        match solved {
            Ok(()) => Ok(()),
            Err(NewtonError::Factorization(error)) => Err(NewtonError::Factorization(error)),
            Err(first) => {
                temperatures.copy_from_slice(&start);
                if self.warmed(work, temperatures) {
                    return Ok(());
                }
                // the reason at the start is more useful than the end of the pseudo-time
                match (self.pseudo_time(work, temperatures), first) {
                    (Ok(()), _) => Ok(()),
                    (Err(later), NewtonError::Stalled { .. }) => Err(later),
                    (Err(_), NewtonError::Input(failed)) => {
                        temperatures.copy_from_slice(&start);
                        self.beyond(work, temperatures, failed)
                    }
                    (Err(_), first) => Err(first),
                }
            }
        }
    }

    pub(crate) fn damped(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        let mut state = (0, f64::INFINITY);
        for _ in 0..ITERATIONS {
            self.factorize(work, temperatures, 0.0)?;
            let correction = self.correction(work, temperatures)?;
            state = worst(&correction);
            if state.1 <= SMALL {
                return self.polish(work, temperatures, correction);
            }
            if !self.damp(work, temperatures, &correction) {
                if state.1 <= self.rounding(temperatures)? {
                    return Ok(());
                }
                break;
            }
        }
        Err(NewtonError::Stalled { unknown: self.free[state.0], change: state.1 })
    }

    /// Takes the largest share of a correction after which the next one, with the same factors, is
    /// smaller.
    fn damp(&mut self, work: &mut Workspace, temperatures: &mut [f64], correction: &[f64]) -> bool {
        let before = temperatures.to_vec();
        let size = largest(correction);
        let mut share = self.careful_share(temperatures, correction);
        let least = LEAST_SHARE * share;
        while share >= least {
            self.apply(correction, share, temperatures);
            if let Ok(next) = self.correction(work, temperatures)
                && largest(&next) <= (1.0 - 0.25 * share) * size * (1.0 + ROUNDING)
            {
                return true;
            }
            temperatures.copy_from_slice(&before);
            share *= 0.5;
        }
        false
    }

    /// The share of a correction that leaves every temperature between a fifth and five times its
    /// value: a straight line to a fourth power overshoots by far.
    fn careful_share(&self, temperatures: &[f64], correction: &[f64]) -> f64 {
        let free = self.free.iter().map(|&i| temperatures[i].abs().max(1.0)).zip(correction);
        free.fold(1.0, |share: f64, (t, dt)| {
            let most = if *dt < 0.0 { 0.8 * t } else { 4.0 * t };
            if dt.abs() > most { share.min(most / dt.abs()) } else { share }
        })
    }

    /// The last corrections, with the present factors, while they shrink.
    fn polish(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
        correction: Vec<f64>,
    ) -> Result<(), NewtonError> {
        let mut size = largest(&correction);
        self.apply(&correction, 1.0, temperatures);
        for _ in 0..3 {
            let next = self.correction(work, temperatures)?;
            if largest(&next) >= 0.5 * size {
                break;
            }
            size = largest(&next);
            self.apply(&next, 1.0, temperatures);
        }
        Ok(())
    }

    /// Effect of the last digits of the temperatures on the corrections in K, with the present
    /// factors and Jacobian: a network on a small conductance feels the rounding of its large ones.
    fn rounding(&mut self, temperatures: &[f64]) -> Result<f64, NewtonError> {
        let diagonal = self.pattern.diagonal();
        let heats = diagonal
            .iter()
            .zip(&self.free)
            .map(|(&slot, &i)| self.values[slot].abs() * temperatures[i]);
        let mut moved: Vec<f64> = heats.map(|heat| 2.0 * f64::EPSILON * heat.abs()).collect();
        self.factors.solve_in_place(&mut moved).map_err(NewtonError::Factorization)?;
        Ok(largest(&moved).min(MOST_ROUNDING))
    }

    /// The same from the start over pseudo-time only: its rest depends on its start.
    pub(crate) fn settle(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        self.pseudo_time(work, temperatures)
    }

    fn pseudo_time(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
    ) -> Result<(), NewtonError> {
        let (mut step, mut left) = (0.01, f64::INFINITY);
        let mut change = (0, f64::INFINITY);
        for _ in 0..PSEUDO_STEPS {
            self.factorize(work, temperatures, 1.0 / step)?;
            let correction = self.correction(work, temperatures)?;
            let heat = self.left_over();
            change = worst(&correction);
            let before = temperatures.to_vec();
            let share = self.careful_share(temperatures, &correction);
            self.apply(&correction, share, temperatures);
            let now = self.evaluate(work, temperatures);
            let after = self.left_over();
            if now.is_err() || after > 4.0 * heat.max(f64::MIN_POSITIVE) {
                temperatures.copy_from_slice(&before);
                step *= 0.25;
                if step < 1e-12 {
                    now.map_err(NewtonError::Input)?;
                    break;
                }
                continue;
            }
            step *= match left {
                _ if after <= 0.0 => 8.0, // nothing is left over, and 0/0 says nothing
                left if left.is_finite() => (left / after).clamp(0.5, 8.0),
                _ => 2.0,
            };
            left = after;
            if step > 1e4 && self.damped(work, &mut temperatures.to_vec()).is_ok() {
                return self.damped(work, temperatures);
            }
        }
        Err(NewtonError::Stalled { unknown: self.free[change.0], change: change.1 })
    }

    /// Factorises `-J`, with `inertia` times the size of its diagonal added.
    pub(crate) fn factorize(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
        inertia: f64,
    ) -> Result<(), NewtonError> {
        self.linearize(work, temperatures)?;
        for &slot in self.pattern.diagonal() {
            self.values[slot] += inertia * self.values[slot].abs();
        }
        // a balance without a single term is a better reason than the pivot at which elimination
        // ended
        let is_empty = |&slot: &usize| self.values[slot].abs() < f64::MIN_POSITIVE;
        let empty = self.pattern.diagonal().iter().position(is_empty);
        let free = &self.free;
        let failed = |error| match error {
            FactorError::Singular { index } => {
                NewtonError::Singular { unknown: free[empty.unwrap_or(index)] }
            }
            other => NewtonError::Factorization(other),
        };
        self.factors.factorize(&self.values).map_err(failed)?;
        self.factors.check(&self.pattern, &self.values).map_err(failed)?;
        self.ready = true;
        Ok(())
    }

    /// The correction of the free unknowns, in K, with the present factors.
    pub(crate) fn correction(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<Vec<f64>, NewtonError> {
        let mut correction = self.residual(work, temperatures)?;
        self.factors.solve_share(&mut correction, SHARE).map_err(NewtonError::Factorization)?;
        Ok(correction)
    }

    pub(crate) fn apply(&self, correction: &[f64], share: f64, temperatures: &mut [f64]) {
        self.free.iter().zip(correction).for_each(|(&i, dt)| temperatures[i] += share * dt);
    }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    worst(values).1
}

/// The largest magnitude and its index; NaN counts as infinite.
fn worst(values: &[f64]) -> (usize, f64) {
    let size = |v: f64| if v.is_nan() { f64::INFINITY } else { v.abs() };
    let all = values.iter().map(|&v| size(v)).enumerate();
    all.fold((0, 0.0), |most, now| if now.1 > most.1 { now } else { most })
}

mod balances;
mod beyond;
#[cfg(test)]
mod tests;
mod warmed;
