//! The transposed Jacobian of a system, and its massless part.

use lptn_integrate::linear::{self, Factorization};
use lptn_integrate::{FactorError, Pattern};

/// The transposed Jacobian in W/K.
pub(super) struct Transposed {
    pattern: Pattern,
    /// The slot of the Jacobian in each slot.
    from: Vec<usize>,
    /// Present values.
    values: Vec<f64>,
    states: usize,
    massless: Option<Massless>,
}

/// The rows and columns of massless nodes that are solved for.
struct Massless {
    /// The slot of the transposed Jacobian in each slot.
    slots: Vec<usize>,
    values: Vec<f64>,
    factors: Box<dyn Factorization>,
    /// True if the factors are those of the present values.
    ready: bool,
}

impl Transposed {
    /// Of a pattern whose first rows are those of the states.
    pub(super) fn new(pattern: &Pattern, states: usize) -> Result<Self, FactorError> {
        let (size, rows) = (pattern.size(), pattern.row_indices());
        let entries =
            || (0..size).flat_map(|column| pattern.column(column).map(move |slot| (column, slot)));
        let turned = Pattern::new(size, entries().map(|(column, slot)| (column, rows[slot])));
        let mut from = vec![usize::MAX; turned.len()];
        for (column, slot) in entries() {
            if let Some(place) = turned.slot(column, rows[slot]) {
                from[place] = slot;
            }
        }
        let values = vec![0.0; turned.len()];
        let massless = (states < size).then(|| Massless::new(&turned, states)).transpose()?;
        Ok(Self { pattern: turned, from, values, states, massless })
    }

    pub(super) fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Takes the values of the Jacobian.
    pub(super) fn take(&mut self, jacobian: &[f64]) {
        for (value, from) in self.values.iter_mut().zip(&self.from) {
            *value = jacobian.get(*from).copied().unwrap_or(0.0);
        }
        self.massless.iter_mut().for_each(|massless| massless.ready = false);
    }

    /// The values in the order of the pattern.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Completes `x` in 1/J, whose states are given, by the values of the massless nodes at which
    /// their rows of `J^T x + weights` are zero, and writes the rows of the states.
    pub(super) fn balance(
        &mut self,
        weights: &[f64],
        x: &mut [f64],
        out: &mut [f64],
    ) -> Result<(), FactorError> {
        x[self.states..].fill(0.0);
        let mut product = vec![0.0; x.len()];
        if let Some(massless) = &mut self.massless {
            self.pattern.multiply(&self.values, x, &mut product);
            let rows = product[self.states..].iter().zip(&weights[self.states..]);
            let mut solved: Vec<f64> = rows.map(|(row, weight)| -row - weight).collect();
            massless.solve(&self.values, &mut solved)?;
            x[self.states..].copy_from_slice(&solved);
        }
        self.pattern.multiply(&self.values, x, &mut product);
        let rows = product.iter().zip(weights).take(self.states);
        out.iter_mut().zip(rows).for_each(|(out, (row, weight))| *out = row + weight);
        Ok(())
    }
}

impl Massless {
    fn new(turned: &Pattern, states: usize) -> Result<Self, FactorError> {
        let (mut entries, mut slots) = (Vec::new(), Vec::new());
        for column in states..turned.size() {
            for slot in turned.column(column) {
                if let Some(row) = turned.row_indices()[slot].checked_sub(states) {
                    entries.push((row, column - states));
                    slots.push(slot);
                }
            }
        }
        let pattern = Pattern::new(turned.size() - states, entries.into_iter());
        let factors = linear::for_exact(&pattern)?;
        Ok(Self { values: vec![0.0; slots.len()], slots, factors, ready: false })
    }

    fn solve(&mut self, all: &[f64], b: &mut [f64]) -> Result<(), FactorError> {
        if !self.ready {
            let taken = self.values.iter_mut().zip(&self.slots);
            taken.for_each(|(value, slot)| *value = all[*slot]);
            self.factors.factorize(&self.values)?;
            self.ready = true;
        }
        self.factors.solve_in_place(b)
    }
}
