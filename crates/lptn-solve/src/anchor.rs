//! Starting points of evaluations of massless nodes.
//!
//! Newton's method ends with a small correction, so that the last digits of its solution depend on
//! its start and on its factors. Rows, limits and windows evaluate a step as often as they like.
//! Each evaluation begins as if there were no other, with the known solutions of the step.
//!
//! An evaluation starts between the integrator's solutions at the two ends of the step, with its
//! factors. Newton's method stops within 1e-10 K, so its last digits depend on its start. Rows,
//! limits and windows used to start from the end of the evaluation before. Without capacities, a
//! walk through each part of the inputs replaces the steps; nothing printed changes it.

use crate::newton::Newton;
use crate::unfold::Unfold;

/// Temperatures of the massless nodes that are solved for, in K, at some times in s, ascending.
#[derive(Clone, Debug, Default)]
pub(crate) struct Anchor {
    known: Vec<(f64, Vec<f64>)>,
}

impl Anchor {
    /// Forgets everything but this.
    pub(crate) fn stand(&mut self, time: f64, algebraic: &[f64]) {
        self.known.clear();
        self.add(time, algebraic);
    }

    /// Forgets all but the last, which is then known at `time`.
    pub(crate) fn go_on(&mut self, time: f64) {
        self.known.drain(..self.known.len().saturating_sub(1));
        self.known.iter_mut().for_each(|(at, _)| *at = time);
    }

    /// Adds the known temperatures at a time after all others.
    pub(crate) fn add(&mut self, time: f64, algebraic: &[f64]) {
        self.known.push((time, algebraic.to_vec()));
    }

    /// Sets the start of an evaluation at `time`: between the known solutions before and after, or,
    /// if there may be several solutions, at the one before.
    pub(crate) fn begin(&self, time: f64, unfold: &mut Unfold<'_>) {
        unfold.lean();
        let after = self.known.partition_point(|(at, _)| *at <= time);
        let Some((from, before)) = self.known.get(after.saturating_sub(1)) else { return };
        let (to, next) = self.known.get(after).map_or((from, before), |(to, next)| (to, next));
        let share =
            if unfold.is_guarded() || to <= from { 0.0 } else { (time - from) / (to - from) };
        unfold.begin(before.iter().zip(next).map(|(a, b)| a + share * (b - a)));
    }
}

impl Newton<'_> {
    /// The matrix of the last factors; empty if there are none.
    pub(crate) fn matrix(&self) -> &[f64] {
        if self.ready { &self.values } else { &[] }
    }

    /// Takes a matrix with whose factors evaluations must begin; without any if it is empty.
    pub(crate) fn lean_on(&mut self, matrix: &[f64]) {
        let same = self.base.iter().map(|v| v.to_bits()).eq(matrix.iter().map(|v| v.to_bits()));
        if !same {
            self.base.clear();
            self.base.extend_from_slice(matrix);
            self.leans = false;
        }
    }

    /// Takes the matrix of the present factors.
    pub(crate) fn lean_on_itself(&mut self) {
        if !self.leans {
            self.base = self.matrix().to_vec();
            self.leans = true;
        }
    }

    /// Begins an evaluation with the factors of that matrix, whatever was solved since.
    pub(crate) fn lean(&mut self) {
        if !self.leans {
            self.ready = !self.base.is_empty() && self.factors.factorize(&self.base).is_ok();
            self.leans = true;
        }
    }
}

#[cfg(test)]
mod tests;
