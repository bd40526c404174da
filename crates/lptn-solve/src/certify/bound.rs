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
    /// For each unknown the sum of the absolute values of the matrix in W/K.
    sums: Vec<f64>,
    /// At the present time.
    now: Vec<f64>,
}

/// The bounds over one step.
#[derive(Clone, Debug, Default)]
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
    /// The bounds of the unknowns in K at a time in s after the start of the step.
    pub(super) fn at(&self, after: f64) -> impl Fn(usize) -> f64 + '_ {
        let growth = (after / self.time).exp();
        move |unknown| {
            let line = self.from[unknown] + after * self.slope[unknown];
            (line + self.added[unknown] * growth).max(0.0)
        }
    }

    /// The bounds at the start of the step in K.
    pub(super) fn start(&self) -> &[f64] {
        &self.from
    }

    /// The most in K that a bound grows over the step.
    pub(super) fn adds(&self) -> f64 {
        let most = self.most();
        (0..self.from.len()).map(|i| most(i) - self.from[i]).fold(0.0, f64::max)
    }

    /// Bounds of the unknowns over the whole step, in K.
    pub(super) fn most(&self) -> impl Fn(usize) -> f64 + '_ {
        let growth = (self.length / self.time).exp();
        move |unknown| {
            let end = self.from[unknown] + self.length * self.slope[unknown];
            self.from[unknown].max(end) + self.added[unknown] * growth
        }
    }
}

impl Bound {
    pub(super) fn new(pattern: &Pattern, mass: &[f64]) -> Result<Self, FactorError> {
        Ok(Self::with(Shifted::new(pattern, mass)?, pattern, mass))
    }

    /// For one symmetric matrix, in W/K.
    pub(super) fn constant(
        pattern: &Pattern,
        mass: &[f64],
        matrix: &[f64],
    ) -> Result<Self, FactorError> {
        let mut bound = Self::with(Shifted::symmetric(pattern, mass)?, pattern, mass);
        bound.set_matrix(matrix);
        Ok(bound)
    }

    fn with(factors: Shifted, pattern: &Pattern, mass: &[f64]) -> Self {
        let zeros = vec![0.0; mass.len()];
        let (pattern, mass) = (pattern.clone(), mass.to_vec());
        Self { pattern, mass, factors, sums: zeros.clone(), now: zeros }
    }

    /// The matrix of the next steps in W/K: the diagonal from above, the others in absolute value.
    pub(super) fn set_matrix(&mut self, matrix: &[f64]) {
        self.factors.set(matrix);
        self.sums.fill(0.0);
        for (slope, row) in matrix.iter().zip(self.pattern.row_indices()) {
            self.sums[*row] += slope.abs();
        }
    }

    /// For each unknown the sum of the absolute values of the matrix in W/K.
    pub(super) fn sums(&self) -> &[f64] {
        &self.sums
    }

    /// Adds a share of the absolute values of the matrix times sizes of the unknowns in K.
    pub(super) fn add_sizes(&self, share: f64, sizes: impl Iterator<Item = f64>, heat: &mut [f64]) {
        let (pattern, matrix) = (&self.pattern, self.factors.matrix());
        for (column, size) in sizes.enumerate() {
            for slot in pattern.column(column) {
                heat[pattern.row_indices()[slot]] += share * size * matrix[slot].abs();
            }
        }
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
        let at_end = line.at(line.length);
        self.now.iter_mut().enumerate().for_each(|(i, bound)| *bound = at_end(i));
    }

    /// The bounds over a step of this length in s for a bound on the defect in W; `None` if none
    /// was found.
    pub(super) fn over(&mut self, length: f64, defect: &[f64]) -> Option<Line> {
        let time = power_of_two_above(length);
        self.factors.factorize(time)?;
        let from = self.now.clone();
        let mut heat = vec![0.0; from.len()];
        self.factors.multiply(&from, &mut heat);
        let mut slope: Vec<f64> = heat.iter().zip(defect).map(|(a, r)| a + r).collect();
        self.factors.solve(&mut slope)?;
        let missed = self.missed((&from, &slope), length, (heat, defect));
        let added = self.cover(missed, time)?;
        Some(Line { from, slope, added, time, length })
    }

    /// A `v` with `C/H v - A v >= m` and `v >= 0`, rounding included; `None` if none was found. The
    /// factors only propose: the inequality is checked, and its violations are corrected.
    fn cover(&mut self, missed: Vec<f64>, time: f64) -> Option<Vec<f64>> {
        let mut added = vec![0.0; missed.len()];
        let mut heat = added.clone();
        let mut wanting = missed.clone();
        for _ in 0..CORRECTIONS {
            wanting.iter_mut().for_each(|w| *w *= time * GENEROUS);
            self.factors.solve(&mut wanting)?;
            added.iter_mut().zip(&wanting).for_each(|(v, more)| *v = (*v + more).max(0.0));
            self.factors.multiply(&added, &mut heat);
            let mut covered = true;
            for (i, wanting) in wanting.iter_mut().enumerate() {
                let stored = self.mass[i] / time * added[i];
                let diagonal = self.factors.matrix()[self.pattern.diagonal_slot(i)];
                // the other entries are not negative
                let absolute = heat[i] - 2.0 * diagonal.min(0.0) * added[i];
                let rounding = ROUNDING * (stored + absolute);
                let short = missed[i] + rounding - (stored - heat[i]);
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

    /// The heat in W by which a line misses `C w' >= A w + r` at most, at either end: between them
    /// it is linear. Rounding is added. `heat` is `A w` at the start.
    fn missed(
        &self,
        (from, slope): (&[f64], &[f64]),
        length: f64,
        (heat, defect): (Vec<f64>, &[f64]),
    ) -> Vec<f64> {
        let mut rising = vec![0.0; from.len()];
        self.factors.multiply(slope, &mut rising);
        let pairs = from.iter().zip(slope);
        let size = pairs.map(|(w, s)| w.abs() + length * s.abs()).fold(0.0, f64::max);
        let row = |(i, heat): (usize, f64)| {
            let gets = self.mass[i] * slope[i];
            let most = heat + (length * rising[i]).max(0.0) + defect[i];
            let rounding = self.sums[i] * size + defect[i] + gets.abs();
            (most - gets).max(0.0) + ROUNDING * rounding
        };
        heat.into_iter().enumerate().map(row).collect()
    }
}
