//! Amplitudes and phases of all nodes if one input oscillates.

use std::fmt;

use lptn_integrate::dense::Complex;
use lptn_integrate::linear::{self, Factorization, LinearSolver};
use lptn_integrate::{FactorError, Pattern};

use super::{Drive, Effect, ResponseError, grounded};
use crate::linearised::Linearised;

/// Steps of iterative refinement.
const REFINEMENTS: usize = 2;

/// Solves `(G + j omega C) x = b`, as `[G, -omega C; omega C, G]` for real and imaginary parts.
pub struct FrequencyResponse<'a, 'b> {
    linear: &'b Linearised<'a>,
    effect: Effect,
    pattern: Pattern,
    factors: Box<dyn Factorization>,
    /// Values with `G` in both blocks and zeros next to them.
    values: Vec<f64>,
    /// Slots of `-omega C` and `omega C` of each state.
    beside: Vec<[usize; 2]>,
}

impl fmt::Debug for FrequencyResponse<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FrequencyResponse").field("linear", &self.linear).finish_non_exhaustive()
    }
}

impl<'a, 'b> FrequencyResponse<'a, 'b> {
    /// The responses of a network to an input.
    ///
    /// # Errors
    /// [`ResponseError`]
    pub fn new(linear: &'b Linearised<'a>, drive: Drive) -> Result<Self, ResponseError> {
        let effect = Effect::of(linear, drive)?;
        let (single, conductances) = linear.conductances();
        let (size, states) = (single.size(), linear.capacity().len());
        let entries = || {
            (0..size).flat_map(|column| {
                single.column(column).map(move |slot| (single.row_indices()[slot], column))
            })
        };
        let blocks = entries().chain(entries().map(|(row, column)| (size + row, size + column)));
        let cross = (0..states).flat_map(|i| [(i, size + i), (size + i, i)]);
        let pattern = Pattern::new(2 * size, blocks.chain(cross));
        let place = |row, column| {
            pattern.slot(row, column).ok_or(FactorError::Singular { index: row.min(size) })
        };
        let mut values = vec![0.0; pattern.len()];
        for ((row, column), g) in entries().zip(&conductances) {
            values[place(row, column)?] = *g;
            values[place(size + row, size + column)?] = *g;
        }
        let beside = (0..states).map(|i| Ok([place(i, size + i)?, place(size + i, i)?]));
        let beside = beside.collect::<Result<_, FactorError>>()?;
        let factors = linear::new(&pattern, false, LinearSolver::Auto)?;
        Ok(Self { linear, effect, pattern, factors, values, beside })
    }

    /// Response of every node at an angular frequency in rad/s, 0 or above: in K per unit of the
    /// input, the input being `cos(omega t)` and the node `|x| cos(omega t + arg x)`.
    ///
    /// # Errors
    /// [`ResponseError::NoGround`] at 0; [`ResponseError::Factorization`].
    pub fn at(&mut self, omega: f64) -> Result<Vec<Complex>, ResponseError> {
        let system = self.linear.system();
        let size = self.effect.flow.len();
        let mut values = self.values.clone();
        for (slots, c) in self.beside.iter().zip(self.linear.capacity()) {
            values[slots[0]] = -omega * c;
            values[slots[1]] = omega * c;
        }
        if omega == 0.0 {
            grounded(system, &self.effect)?;
            self.tie_down(&mut values);
        }
        self.factors.factorize(&values)?;
        let mut flow = self.effect.flow.clone();
        flow.resize(2 * size, 0.0);
        let mut x = vec![0.0; 2 * size];
        let of = (&self.pattern, &values[..]);
        linear::solve_refined(&mut *self.factors, of, &flow, &mut x, REFINEMENTS)?;
        let real = self.effect.recovered(system, &x[..size], 1.0);
        let imaginary = self.effect.recovered(system, &x[size..], 0.0);
        Ok(real.into_iter().zip(imaginary).map(|(re, im)| Complex::new(re, im)).collect())
    }

    /// Makes the blocks of islands without a boundary regular: no heat enters them.
    fn tie_down(&self, values: &mut [f64]) {
        let system = self.linear.system();
        for loose in system.network().ungrounded().into_iter().flatten() {
            if let Some(i) = system.unknowns().iter().position(|id| *id == loose) {
                for row in [i, self.effect.flow.len() + i] {
                    let slot = self.pattern.diagonal_slot(row);
                    values[slot] = if values[slot] > 0.0 { 2.0 * values[slot] } else { 1.0 };
                }
            }
        }
    }
}
