//! One step of a size that is tried.
//!
//! Heat that a solver loses is put back evenly: each term is shifted by a constant that closes the
//! whole balance. The balance therefore closes to rounding with conjugate gradients too.

use super::levels::{Levels, step_of};
use super::series::{self, FEWEST, MOST, POLE, Weights};
use crate::linear::Factorization;
use crate::{FactorError, kernels};

/// Error allowed to the solver of a term, as a share of the tolerance. Each term inherits the
/// errors of those before it, and their sum has to stay well below the tolerance: otherwise the
/// terms stop shrinking and only short steps are accepted (40 times as many at 0.02).
const SOLVED_TO: f64 = 0.005;

/// The terms that a step is to take when its size is chosen: longer ones would need even less
/// work per time, but the prediction is not sharp.
const WANTED: f64 = 9.0;

/// Values per turn in which terms are added up: they stay in the nearest cache.
const BLOCK: usize = 512;

/// Fewer components than this are added up one by one.
const FEW: usize = 8;

/// The right side at the start of a step, in units of `M` times y per time.
pub(super) struct Drive<'a> {
    pub(super) flow: &'a [f64],
    /// Its change per time at a constant state.
    pub(super) slope: &'a [f64],
}

/// The constant system.
pub(super) struct Body<'a> {
    pub(super) mass: &'a [f64],
    /// Decrease of the flow of each row if all components rise by 1.
    pub(super) loss: &'a [f64],
}

/// A step as a series: see [`super::series`].
#[derive(Default)]
pub(super) struct Series {
    /// The start of the step.
    pub(super) start: Vec<f64>,
    pub(super) length: f64,
    pub(super) level: i32,
    /// Terms that count; there is room for more.
    pub(super) count: usize,
    /// Terms that are known.
    pub(super) known: usize,
    pub(super) terms: Vec<Vec<f64>>,
    right: Vec<f64>,
    balance: Vec<f64>,
}

/// Result of a step.
pub(super) enum Outcome {
    Accepted(Forecast),
    Rejected(Forecast),
}

/// Prediction for steps of other sizes, from the sizes of the terms.
pub(super) struct Forecast {
    /// The estimated error over the tolerance, with `count` terms.
    error: f64,
    count: usize,
    /// The last term over the one before.
    ratio: f64,
}

impl Series {
    pub(super) fn attempt(
        &mut self,
        (levels, level): (&mut Levels, i32),
        body: &Body<'_>,
        drive: &Drive<'_>,
        tolerance: f64,
    ) -> Result<Outcome, FactorError> {
        let h = step_of(level);
        (self.length, self.level) = (h, level);
        let factors = levels.factors(level)?;
        kernels::zip(body.mass, body.loss, &mut self.balance, |m, g| m + POLE * h * g);
        let whole = kernels::sum(&self.balance);
        let constants = series::error_constants();
        let (mut before, mut ratio) = (f64::INFINITY, 1.0_f64);
        for (n, constant) in (1..=MOST).zip(&constants[1..]) {
            self.put_right_side(n, body.mass, drive);
            let put = kernels::sum(&self.right);
            self.guess(n, ratio);
            let term = &mut self.terms[n - 1];
            factors.solve_from(&self.right, term, SOLVED_TO * tolerance)?;
            // heat that the solver has lost is put back, evenly
            let lost = (put - kernels::dot(&self.balance, term)) / whole;
            self.finish_term(n, lost);
            let size = kernels::max_norm(&self.terms[n - 1]);
            if n > 1 && before > 0.0 {
                ratio = size / before;
            }
            before = size;
            let error = constant * size / tolerance;
            self.count = n;
            let forecast = Forecast { error, count: n, ratio };
            if n >= FEWEST && error <= 1.0 {
                return Ok(Outcome::Accepted(forecast));
            }
            if n == MOST || (n >= FEWEST && forecast.is_hopeless()) {
                return Ok(Outcome::Rejected(forecast));
            }
        }
        Err(FactorError::NotFactorized) // the last term has returned
    }

    pub(super) fn begin(&mut self, state: &[f64]) {
        self.start.clear();
        self.start.extend_from_slice(state);
        self.right.resize(state.len(), 0.0);
        self.balance.resize(state.len(), 0.0);
    }

    fn put_right_side(&mut self, n: usize, mass: &[f64], drive: &Drive<'_>) {
        let h = self.length;
        let curving = POLE * h * h;
        if n == 1 {
            kernels::linear_sum(h, drive.flow, curving, drive.slope, &mut self.right);
            return;
        }
        kernels::zip(mass, &self.terms[n - 2], &mut self.right, |m, u| m * u);
        if n == 2 {
            kernels::scale_and_add(1.0, &mut self.right, curving, drive.slope);
        }
    }

    /// Adds a term after those that are known, at least two.
    pub(super) fn next(
        &mut self,
        mass: &[f64],
        factors: &mut dyn Factorization,
    ) -> Result<(), FactorError> {
        let n = self.known + 1;
        if self.terms.len() < n {
            self.terms.push(vec![0.0; self.start.len()]);
        }
        let (before, now) = self.terms.split_at_mut(n - 1);
        let (before, now) = (&before[n - 2], &mut now[0]);
        kernels::zip(mass, before, now, |m, u| m * u);
        factors.solve_in_place(now)?;
        kernels::zip_in_place(now, before, |x, u| x - u);
        self.known = n;
        Ok(())
    }

    /// Guess for a solver that iterates: terms alternate and shrink by about the same ratio.
    fn guess(&mut self, n: usize, ratio: f64) {
        if self.terms.len() < n {
            self.terms.push(vec![0.0; self.start.len()]);
        }
        let (before, now) = self.terms.split_at_mut(n - 1);
        match before.last() {
            Some(before) => kernels::map(before, &mut now[0], |u| (1.0 - ratio.min(1.0)) * u),
            None => now[0].fill(0.0),
        }
    }

    fn finish_term(&mut self, n: usize, lost: f64) {
        let (before, now) = self.terms.split_at_mut(n - 1);
        match before.last() {
            Some(before) => kernels::zip_in_place(&mut now[0], before, |x, u| x + lost - u),
            None => kernels::map_in_place(&mut now[0], |x| x + lost),
        }
    }

    /// Writes the start plus the weighted terms.
    pub(super) fn add_up(&self, weights: &Weights, out: &mut [f64]) {
        out.copy_from_slice(&self.start);
        self.add_terms(weights, out);
    }

    /// Adds the weighted terms, four at a time: each number is then fetched and stored less often.
    pub(super) fn add_terms(&self, weights: &Weights, out: &mut [f64]) {
        if out.len() < FEW {
            return self.add_few(weights, out);
        }
        let (fours, few) = self.terms[..self.count].as_chunks::<4>();
        let (weights_of_fours, weights_of_few) = weights[..self.count].as_chunks::<4>();
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let own = block * BLOCK..block * BLOCK + out.len();
            for ([a, b, c, d], [wa, wb, wc, wd]) in fours.iter().zip(weights_of_fours) {
                let terms = [a, b, c, d].map(|term| &term[own.clone()]);
                let rest = terms[1].iter().zip(terms[2]).zip(terms[3]);
                for ((z, a), ((b, c), d)) in out.iter_mut().zip(terms[0]).zip(rest) {
                    *z = *z + wa * a + wb * b + wc * c + wd * d;
                }
            }
            for (term, &weight) in few.iter().zip(weights_of_few) {
                kernels::scale_and_add(1.0, out, weight, &term[own.clone()]);
            }
        }
    }

    /// The same for a few components, for which the loops are too short.
    fn add_few(&self, weights: &Weights, out: &mut [f64]) {
        for (term, weight) in self.terms[..self.count].iter().zip(weights) {
            for i in 0..out.len().min(term.len()) {
                out[i] += weight * term[i];
            }
        }
    }

    /// The component with the largest last term.
    pub(super) fn worst(&self) -> usize {
        match self.terms[..self.count].last() {
            Some(term) => kernels::worst(term, &vec![1.0; term.len()]),
            None => 0,
        }
    }
}

impl Forecast {
    /// Number of terms for a step that is longer by this factor.
    ///
    /// If a term is a share r of the one before, `r = g h l / (1 + g h l)` with the rate l of
    /// the modes that matter.
    fn terms_needed(&self, factor: f64) -> f64 {
        let ratio = self.ratio.clamp(1e-9, 1.0 - 1e-9);
        let rate = factor * ratio / (1.0 - ratio);
        let then = rate / (1.0 + rate);
        let terms = self.count as f64;
        let error = self.error * factor * (then / ratio).powf(terms - 1.0);
        if error <= 0.0 {
            return FEWEST as f64;
        }
        terms + error.ln() / -then.ln()
    }

    fn is_hopeless(&self) -> bool {
        // the prediction is not sharp
        self.terms_needed(1.0) > 2.0 * MOST as f64
    }

    /// Number of levels by which the next step may rise.
    pub(super) fn rise(&self) -> i32 {
        let fits = |levels: &i32| self.terms_needed(step_of(*levels)) <= WANTED;
        (1..=3).rev().find(fits).unwrap_or(0)
    }

    /// Number of levels by which the same step must fall, at least 1.
    pub(super) fn fall(&self) -> i32 {
        let fits = |levels: &i32| self.terms_needed(step_of(-*levels)) <= MOST as f64 - 1.0;
        (1..=3).find(fits).unwrap_or(4)
    }
}
