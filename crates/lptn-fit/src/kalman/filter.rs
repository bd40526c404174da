//! A filter that takes one reading after the other.

use super::{Fade, Gaussian, Reading, Step, weighed};

/// The state after the readings up to now.
#[derive(Clone, Debug)]
pub struct Filter {
    state: Gaussian,
    log_likelihood: f64,
    /// Room for two matrices.
    room: [Vec<f64>; 2],
}

/// Difference of a reading from its prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation {
    /// The reading less its prediction.
    pub residual: f64,
    /// The variance of that, noise included.
    pub variance: f64,
}

impl Filter {
    /// Begins with the state before the first reading.
    pub fn new(state: Gaussian) -> Self {
        let room = vec![0.0; state.covariance.len()];
        Self { state, log_likelihood: 0.0, room: [room.clone(), room] }
    }

    /// The present state.
    pub fn state(&self) -> &Gaussian {
        &self.state
    }

    /// The logarithm of the probability density of all readings up to now, by their innovations
    /// (F. C. Schweppe, IEEE Trans. Inf. Theory 11 (1965) 61).
    pub fn log_likelihood(&self) -> f64 {
        self.log_likelihood
    }

    /// Goes on to the time of the next reading.
    pub fn predict(&mut self, step: &Step) {
        let n = self.state.mean.len();
        let Gaussian { mean, covariance } = &mut self.state;
        *mean = step.transition.advanced(&step.fades, mean);
        mean.iter_mut().zip(step.input.iter()).for_each(|(x, u)| *x += u);
        let [half, out] = &mut self.room;
        step.transition.carried(&step.fades, covariance, (half, out));
        std::mem::swap(covariance, out);
        let d = step.transition.side();
        let rows = covariance.chunks_exact_mut(n).zip(step.noise.chunks_exact(d.max(1)));
        rows.for_each(|(row, noise)| row.iter_mut().zip(noise).for_each(|(p, q)| *p += q));
        for (i, Fade { variance, .. }) in step.fades.iter().enumerate() {
            covariance[(d + i) * (n + 1)] += variance;
        }
    }

    /// Takes a reading in.
    pub fn update(&mut self, reading: &Reading) -> Innovation {
        self.taken(reading).1
    }

    /// The same, with the change of the states per unit of the residual first.
    pub(super) fn taken(&mut self, reading: &Reading) -> (Vec<f64>, Innovation) {
        let spread = self.state.spread(&reading.of);
        let variance = weighed(&reading.of, &spread) + reading.variance;
        let residual = reading.value - weighed(&reading.of, &self.state.mean);
        let gain: Vec<f64> = spread.iter().map(|p| p / variance).collect();
        let Gaussian { mean, covariance } = &mut self.state;
        mean.iter_mut().zip(&gain).for_each(|(x, k)| *x += k * residual);
        joseph(covariance, (&spread, &gain), variance);
        let size = (std::f64::consts::TAU * variance).ln();
        self.log_likelihood -= 0.5 * (size + residual * residual / variance);
        (gain, Innovation { residual, variance })
    }
}

/// `(1 - k h) P (1 - k h)' + k r k'` (P. D. Joseph), which stays a covariance when rounded.
fn joseph(covariance: &mut [f64], (spread, gain): (&[f64], &[f64]), variance: f64) {
    let n = gain.len();
    for i in 0..n {
        let (own, more) = (gain[i], spread[i]);
        if own.abs() + more.abs() <= 0.0 {
            continue;
        }
        let row = covariance[i * n..][..=i].iter_mut().zip(spread.iter().zip(gain));
        row.for_each(|(p, (s, k))| *p = *p - own * s - more * k + own * k * variance);
    }
    for i in 0..n {
        for j in 0..i {
            covariance[j * n + i] = covariance[i * n + j];
        }
    }
}
