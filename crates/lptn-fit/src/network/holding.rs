//! A model with some parameters fixed.

use crate::least_squares::{Evaluated, LeastSquaresError, Residuals};
use crate::network::model::Model;

/// The same residuals with some parameters fixed.
pub(crate) struct Holding<'h, 'a> {
    pub(crate) model: &'h mut Model<'a>,
    /// Their indices, ascending, and their coordinates.
    pub(crate) held: Vec<(usize, f64)>,
}

impl Holding<'_, '_> {
    /// All parameters, with these in the places that are not fixed.
    pub(crate) fn all(&self, others: &[f64]) -> Vec<f64> {
        let mut all = others.to_vec();
        self.held.iter().for_each(|&(place, at)| all.insert(place, at));
        all
    }

    /// The parameters that are not fixed.
    pub(crate) fn others(&self, all: &[f64]) -> Vec<f64> {
        let is_held = |place: usize| self.held.iter().any(|(held, _)| *held == place);
        (0..all.len()).filter(|place| !is_held(*place)).map(|place| all[place]).collect()
    }
}

impl Residuals for Holding<'_, '_> {
    fn parameters(&self) -> usize {
        self.model.parameters() - self.held.len()
    }

    fn evaluate(&mut self, p: &[f64], derivatives: bool) -> Evaluated {
        let all = self.all(p);
        let (residuals, mut jacobian): (_, Vec<f64>) =
            Residuals::evaluate(self.model, &all, derivatives)?;
        if jacobian.len() < residuals.len() * all.len() {
            return Err(LeastSquaresError::Interrupted);
        }
        for (place, _) in self.held.iter().rev() {
            jacobian.drain(place * residuals.len()..(place + 1) * residuals.len());
        }
        Ok((residuals, jacobian))
    }
}
