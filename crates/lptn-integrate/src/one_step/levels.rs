//! Step sizes that are powers of four, and the factors that belong to them.

use std::collections::BTreeMap;

use crate::linear::Factorization;
use crate::{FactorError, LinearSolverKind};

/// Limit of the numbers in the factors of all levels: 256 MiB. Those used longest ago go first.
const ROOM: usize = 32 << 20;

/// The same for incomplete factors, which are made again in the time of an iteration or two.
const ROOM_TO_ITERATE: usize = ROOM / 4;

/// The size of the steps of a level, `4^level`: exact.
pub(super) fn step_of(level: i32) -> f64 {
    2.0_f64.powi(2 * level)
}

/// The highest level whose step is not longer than this, positive.
pub(super) fn level_within(step: f64) -> i32 {
    // beyond this range nothing is a time
    let level = (step.log2() * 0.5).floor().clamp(-250.0, 250.0) as i32;
    // the logarithm is rounded
    if step_of(level + 1) <= step { level + 1 } else { level }
}

struct Kept {
    factors: Box<dyn Factorization>,
    used: u64,
}

/// The factors of `M - g h J` for the step sizes met up to now.
pub(super) struct Levels {
    /// Analysed, never factorised.
    analysed: Box<dyn Factorization>,
    kept: BTreeMap<i32, Kept>,
    /// Number of requests for factors.
    pub(super) asked: u64,
    pub(super) factorizations: u64,
    /// Iterations of factors that are gone.
    iterations: u64,
}

impl Levels {
    pub(super) fn new(analysed: Box<dyn Factorization>) -> Self {
        Self { analysed, kept: BTreeMap::new(), asked: 0, factorizations: 0, iterations: 0 }
    }

    /// Forgets all factors: there is another matrix.
    pub(super) fn clear(&mut self) {
        self.iterations = self.iterations();
        self.kept.clear();
    }

    pub(super) fn kind(&self) -> LinearSolverKind {
        self.kept.values().next_back().map_or(self.analysed.kind(), |kept| kept.factors.kind())
    }

    /// Count of the numbers in all factors.
    pub(super) fn fill(&self) -> usize {
        self.kept.values().map(|kept| kept.factors.fill()).sum()
    }

    pub(super) fn iterations(&self) -> u64 {
        self.iterations + self.kept.values().map(|kept| kept.factors.iterations()).sum::<u64>()
    }

    /// True if the factors of a level are there; counts as a request.
    pub(super) fn are_ready(&mut self, level: i32) -> bool {
        self.asked += 1;
        self.kept.contains_key(&level)
    }

    /// Makes the factors of a level from the values of its matrix.
    pub(super) fn make(&mut self, level: i32, values: &[f64]) -> Result<(), FactorError> {
        let mut factors = self.analysed.sibling()?;
        self.factorizations += 1;
        self.make_room(factors.fill());
        factors.factorize(values)?;
        self.make_room(factors.fill()); // the size of some is only known now
        self.kept.insert(level, Kept { factors, used: self.asked });
        Ok(())
    }

    /// The factors of a level, which are ready.
    pub(super) fn factors(&mut self, level: i32) -> Result<&mut dyn Factorization, FactorError> {
        let asked = self.asked;
        match self.kept.get_mut(&level) {
            Some(kept) => {
                kept.used = asked;
                Ok(kept.factors.as_mut())
            }
            None => Err(FactorError::NotFactorized),
        }
    }

    fn make_room(&mut self, needed: usize) {
        let room = match self.analysed.kind() {
            LinearSolverKind::Pcg => ROOM_TO_ITERATE,
            _ => ROOM,
        };
        while self.fill() + needed > room {
            let oldest =
                self.kept.iter().min_by_key(|(_, kept)| kept.used).map(|(&level, _)| level);
            let Some(gone) = oldest.and_then(|level| self.kept.remove(&level)) else { return };
            self.iterations += gone.factors.iterations();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{level_within, step_of};

    #[test]
    fn a_level_is_the_highest_that_fits() {
        for (step, level) in [(1.0, 0), (3.99, 0), (4.0, 1), (15.9, 1), (0.25, -1), (0.2, -2)] {
            assert_eq!(level_within(step), level, "{step}");
            assert!(step_of(level) <= step && step_of(level + 1) > step);
        }
    }
}
