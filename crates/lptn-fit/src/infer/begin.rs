//! The prior of a model with its noises and walks.

use crate::infer::model::Model;
use crate::infer::strength::{Noise, Strength};
use crate::kalman::Gaussian;

impl Model {
    /// The prior before any reading, with these noises.
    pub(crate) fn begin(&self, noises: &[Noise]) -> Gaussian {
        self.started(self.prior.clone(), noises)
    }

    pub(crate) fn started(&self, mut prior: Gaussian, noises: &[Noise]) -> Gaussian {
        let side = prior.mean.len() + 1;
        for column in &self.states.drifts {
            let place = self.states.drift(*column);
            place
                .into_iter()
                .for_each(|p| prior.covariance[p * side] = noises[*column].drift.powi(2));
        }
        prior
    }

    /// A prior with the slopes that the time histories begin with. Nothing singles the first row
    /// out, so they have walked before it for as long as after it.
    pub(crate) fn sloped(&self, mut prior: Gaussian, strength: &Strength) -> Gaussian {
        let side = prior.mean.len() + 1;
        for j in 0..self.states.estimated {
            let walked = strength.intensities[2 * j + 1] * self.length();
            prior.covariance[self.states.slope(j) * side] += walked;
        }
        prior
    }
}
