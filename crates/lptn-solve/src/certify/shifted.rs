//! Solutions with `C - H A`, for capacities `C`, a Jacobian `A` and a time `H`.

use lptn_integrate::linear::{self, Factorization, LinearSolver};
use lptn_integrate::{FactorError, Pattern};

/// Numbers in all factors that are kept.
const ROOM: usize = 1 << 22;

/// Most factors that are kept.
const MOST: usize = 8;

/// Factors of `C - H A` for one matrix after another and some times.
pub(super) struct Shifted {
    pattern: Pattern,
    mass: Vec<f64>,
    analysed: Box<dyn Factorization>,
    /// The matrix in W/K.
    matrix: Vec<f64>,
    values: Vec<f64>,
    /// Times in s and their factors, the last one used last; the first ones may be out of use.
    kept: Vec<(f64, Box<dyn Factorization>)>,
    /// The factors at the end of `kept` that belong to the matrix.
    known: usize,
}

impl Shifted {
    pub(super) fn new(pattern: &Pattern, mass: &[f64]) -> Result<Self, FactorError> {
        Ok(Self::of(linear::for_exact(pattern)?, pattern, mass))
    }

    /// For symmetric matrices.
    pub(super) fn symmetric(pattern: &Pattern, mass: &[f64]) -> Result<Self, FactorError> {
        let analysed = linear::for_stages(pattern, true, LinearSolver::Auto)?;
        Ok(Self::of(analysed, pattern, mass))
    }

    fn of(analysed: Box<dyn Factorization>, pattern: &Pattern, mass: &[f64]) -> Self {
        Self {
            pattern: pattern.clone(),
            mass: mass.to_vec(),
            analysed,
            matrix: Vec::new(),
            values: vec![0.0; pattern.len()],
            kept: Vec::new(),
            known: 0,
        }
    }

    /// Takes another matrix in W/K.
    pub(super) fn set(&mut self, matrix: &[f64]) {
        if self.matrix != matrix {
            self.matrix.clear();
            self.matrix.extend_from_slice(matrix);
            self.known = 0;
        }
    }

    pub(super) fn matrix(&self) -> &[f64] {
        &self.matrix
    }

    /// The matrix times a vector.
    pub(super) fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.pattern.multiply(&self.matrix, x, y);
    }

    /// Makes the factors for a time in s, unless they are known.
    pub(super) fn factorize(&mut self, time: f64) -> Option<()> {
        let first = self.kept.len() - self.known;
        let mut places = first..self.kept.len();
        if let Some(place) = places.find(|i| self.kept[*i].0.to_bits() == time.to_bits()) {
            self.kept[place..].rotate_left(1);
            return Some(());
        }
        for (value, slope) in self.values.iter_mut().zip(&self.matrix) {
            *value = -time * slope;
        }
        for (mass, slot) in self.mass.iter().zip(self.pattern.diagonal()) {
            self.values[*slot] += mass;
        }
        let mut factors = self.room().or_else(|| self.analysed.sibling().ok())?;
        let made = factors.factorize(&self.values);
        self.kept.push((time, factors));
        self.known += usize::from(made.is_ok());
        made.ok()
    }

    /// Memory of factors that are out of use, or of those that were used longest ago if there is
    /// little room.
    fn room(&mut self) -> Option<Box<dyn Factorization>> {
        let fill: usize = self.kept.iter().map(|(_, factors)| factors.fill()).sum();
        let each = fill / self.kept.len().max(1);
        let free = self.kept.len() > self.known;
        let full = self.kept.len() >= MOST || (!self.kept.is_empty() && fill + each > ROOM);
        (free || full).then(|| {
            self.known = self.known.min(self.kept.len() - 1);
            self.kept.remove(0).1
        })
    }

    /// Replaces a right side in J by the solution in K with the factors used last.
    pub(super) fn solve(&mut self, right: &mut [f64]) -> Option<()> {
        self.kept.last_mut()?.1.solve_in_place(right).ok()
    }
}

/// The next power of two: a run has few of them, so that factors serve many steps.
pub(super) fn power_of_two_above(length: f64) -> f64 {
    length.log2().ceil().exp2()
}
