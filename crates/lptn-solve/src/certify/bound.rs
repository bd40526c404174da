//! The bound itself, carried from step to step.
//!
//! Let `e` be the distance of the solution from the way, `r` the defect of the way and `A` a matrix
//! whose entries bound those of the Jacobian near the way: the diagonal from above, the others in
//! absolute value. Then `C |e|' <= A |e| + |r|`, and every `w` with `C w' >= A w + |r|` that begins
//! above `|e|` stays above it (M. Mueller, Math. Z. 26 (1927) 619; W. Walter, Differential and
//! Integral Inequalities, Springer 1970, section 12).
//!
//! Such a `w` is a straight line, found by one implicit step, plus `v exp(t/H)` with
//! `(C/H - A) v >= m`, where `m` is the most by which the line misses the inequality: then
//! `C (v exp(t/H))' - A v exp(t/H) = exp(t/H) (C/H - A) v >= m`. Both inequalities are checked with
//! the numbers that were found, so neither the solution of linear systems nor the length `H` has to
//! be trusted.

use lptn_integrate::{FactorError, Pattern};

use super::shifted::{Shifted, power_of_two_above};

/// Heat that is proposed to cover another one, as a share of that.
const GENEROUS: f64 = 1.0 + 1e-6;

/// Corrections of a proposal before it counts as failed.
const CORRECTIONS: usize = 12;

/// Rounding of a sum of heats, as a share of the sum of their absolute values.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Bounds of all unknowns, in K.
pub(super) struct Bound {
    pattern: Pattern,
    /// Capacity of each unknown in J/K; 0 for one without.
    mass: Vec<f64>,
    factors: Shifted,
    /// At the present time.
    now: Vec<f64>,
}

/// The bounds over one step.
#[derive(Clone, Debug)]
pub(super) struct Line {
    from: Vec<f64>,
    /// In K/s.
    slope: Vec<f64>,
    /// Amount of the exponential in K, and its time in s.
    added: Vec<f64>,
    time: f64,
    length: f64,
}

impl Line {
    /// The bound of an unknown in K at a time in s after the start of the step.
    pub(super) fn at(&self, unknown: usize, after: f64) -> f64 {
        let line = self.from[unknown] + after * self.slope[unknown];
        (line + self.added[unknown] * (after / self.time).exp()).max(0.0)
    }

    /// The most in K that a bound grows over the step.
    pub(super) fn adds(&self) -> f64 {
        (0..self.from.len()).map(|i| self.most(i) - self.from[i]).fold(0.0, f64::max)
    }

    /// A bound of an unknown over the whole step, in K.
    pub(super) fn most(&self, unknown: usize) -> f64 {
        let end = self.from[unknown] + self.length * self.slope[unknown];
        let added = self.added[unknown] * (self.length / self.time).exp();
        self.from[unknown].max(end) + added
    }
}

impl Bound {
    pub(super) fn new(pattern: Pattern, mass: &[f64]) -> Result<Self, FactorError> {
        let factors = Shifted::new(&pattern, mass)?;
        let now = vec![0.0; mass.len()];
        Ok(Self { pattern, mass: mass.to_vec(), factors, now })
    }

    /// The bounds at the present time in K.
    pub(super) fn now(&self) -> &[f64] {
        &self.now
    }

    /// Adds to the bounds: the way begins elsewhere than the last one ended.
    pub(super) fn widen(&mut self, by: impl Iterator<Item = f64>) {
        self.now.iter_mut().zip(by).for_each(|(bound, by)| *bound += by);
    }

    /// Goes back to other bounds.
    pub(super) fn set(&mut self, bounds: Vec<f64>) {
        self.now = bounds;
    }

    /// Goes to the end of a step.
    pub(super) fn go(&mut self, line: &Line) {
        let at_end = |unknown| line.at(unknown, line.length);
        self.now = (0..self.now.len()).map(at_end).collect();
    }

    /// The bounds over a step of this length in s for a matrix in W/K and a bound on the defect in
    /// W; `None` if none was found.
    pub(super) fn over(&mut self, length: f64, matrix: &[f64], defect: &[f64]) -> Option<Line> {
        let time = power_of_two_above(length);
        self.factors.factorize(time, matrix)?;
        let from = self.now.clone();
        let mut slope = self.excess((matrix, &from), defect);
        self.factors.solve(&mut slope)?;
        let missed = self.missed((&from, &slope), length, (matrix, defect));
        let added = self.cover(&missed, (matrix, time))?;
        Some(Line { from, slope, added, time, length })
    }

    /// A `v` with `C/H v - A v >= m` and `v >= 0`, rounding included; `None` if none was found. The
    /// factors only propose: the inequality is checked, and its violations are corrected.
    fn cover(&mut self, missed: &[f64], (matrix, time): (&[f64], f64)) -> Option<Vec<f64>> {
        let absolute: Vec<f64> = matrix.iter().map(|a| a.abs()).collect();
        let mut added = vec![0.0; missed.len()];
        let mut wanting = missed.to_vec();
        for _ in 0..CORRECTIONS {
            wanting.iter_mut().for_each(|w| *w *= time * GENEROUS);
            self.factors.solve(&mut wanting)?;
            added.iter_mut().zip(&wanting).for_each(|(v, more)| *v = (*v + more).max(0.0));
            let heats = [matrix, &absolute].map(|matrix| {
                let mut heat = vec![0.0; missed.len()];
                self.pattern.multiply(matrix, &added, &mut heat);
                heat
            });
            let mut covered = true;
            for (i, wanting) in wanting.iter_mut().enumerate() {
                let stored = self.mass[i] / time * added[i];
                let rounding = ROUNDING * (stored + heats[1][i]);
                let short = missed[i] + rounding - (stored - heats[0][i]);
                covered &= short <= 0.0;
                // less would be lost in the rounding
                *wanting = short.max(0.0) + 4.0 * rounding;
            }
            if covered {
                return Some(added);
            }
        }
        None
    }

    /// `A w + r` in W.
    fn excess(&self, (matrix, bounds): (&[f64], &[f64]), defect: &[f64]) -> Vec<f64> {
        let mut heat = vec![0.0; defect.len()];
        self.pattern.multiply(matrix, bounds, &mut heat);
        heat.iter_mut().zip(defect).for_each(|(heat, defect)| *heat += defect);
        heat
    }

    /// The heat in W by which a line misses `C w' >= A w + r` at most, at either end: between them
    /// it is linear. Rounding is added.
    fn missed(
        &self,
        (from, slope): (&[f64], &[f64]),
        length: f64,
        (matrix, defect): (&[f64], &[f64]),
    ) -> Vec<f64> {
        let to: Vec<f64> = from.iter().zip(slope).map(|(w, s)| w + length * s).collect();
        let ends = [from, &to].map(|w| self.excess((matrix, w), defect));
        let sizes: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a.abs().max(b.abs())).collect();
        let absolute: Vec<f64> = matrix.iter().map(|a| a.abs()).collect();
        let rounding = self.excess((&absolute, &sizes), defect);
        let row = |i: usize| {
            let gets = self.mass[i] * slope[i];
            let missed = (ends[0][i] - gets).max(ends[1][i] - gets).max(0.0);
            missed + ROUNDING * (rounding[i] + gets.abs())
        };
        (0..from.len()).map(row).collect()
    }
}
