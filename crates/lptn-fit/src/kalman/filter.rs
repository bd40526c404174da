//! One reading after the other.

use super::{Gaussian, Reading, Step, advanced, carried, dot, multiplied};

/// What is known after the readings so far.
#[derive(Clone, Debug)]
pub struct Filter {
    state: Gaussian,
    log_likelihood: f64,
}

/// By how much a reading was not what was expected of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation {
    /// The reading less what was expected.
    pub residual: f64,
    /// The variance of that, noise included.
    pub variance: f64,
}

impl Filter {
    /// Begins with what is known before the first reading.
    pub fn new(state: Gaussian) -> Self {
        Self { state, log_likelihood: 0.0 }
    }

    /// What is known now.
    pub fn state(&self) -> &Gaussian {
        &self.state
    }

    /// The logarithm of the probability density of all readings so far, by their innovations
    /// (F. C. Schweppe, IEEE Trans. Inf. Theory 11 (1965) 61).
    pub fn log_likelihood(&self) -> f64 {
        self.log_likelihood
    }

    /// Goes on to the time of the next reading.
    pub fn predict(&mut self, step: &Step) {
        let n = self.state.mean.len();
        let Gaussian { mean, covariance } = &mut self.state;
        *mean = advanced(&step.transition, mean);
        mean.iter_mut().zip(&step.input).for_each(|(x, u)| *x += u);
        *covariance = carried(&step.transition, covariance, n);
        let d = step.input.len();
        let rows = covariance.chunks_exact_mut(n).zip(step.noise.chunks_exact(d));
        rows.for_each(|(row, noise)| row.iter_mut().zip(noise).for_each(|(p, q)| *p += q));
    }

    /// Takes a reading in.
    pub fn update(&mut self, reading: &Reading) -> Innovation {
        let (gain, innovation) = self.gain(reading);
        let n = gain.len();
        let Innovation { residual, variance } = innovation;
        let Gaussian { mean, covariance } = &mut self.state;
        let spread = multiplied(covariance, &reading.of);
        mean.iter_mut().zip(&gain).for_each(|(x, k)| *x += k * residual);
        // (1 - k h) P (1 - k h)' + k r k' (P. D. Joseph), which stays a covariance when rounded
        for i in 0..n {
            for j in 0..=i {
                let p = covariance[i * n + j] - gain[i] * spread[j] - spread[i] * gain[j]
                    + gain[i] * gain[j] * variance;
                (covariance[i * n + j], covariance[j * n + i]) = (p, p);
            }
        }
        let size = (std::f64::consts::TAU * variance).ln();
        self.log_likelihood -= 0.5 * (size + residual * residual / variance);
        innovation
    }

    /// What a reading changes per unit that it was not expected, and that it was not.
    pub(super) fn gain(&self, reading: &Reading) -> (Vec<f64>, Innovation) {
        let Gaussian { mean, covariance } = &self.state;
        let spread = multiplied(covariance, &reading.of);
        let variance = dot(&reading.of, &spread) + reading.variance;
        let residual = reading.value - dot(&reading.of, mean);
        (spread.iter().map(|p| p / variance).collect(), Innovation { residual, variance })
    }
}
