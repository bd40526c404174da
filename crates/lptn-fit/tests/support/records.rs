//! Records of one exponential with slow noise, rounded as a logger rounds them.

use lptn_fit::step::{Estimated, StepFit};
use lptn_solve::{available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// What a record is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Truth {
    /// `T_i` and `T_f` in degC, `t_RC` in s.
    pub(crate) curve: [f64; 3],
    /// Number of samples, and their distance in s.
    pub(crate) samples: usize,
    pub(crate) spacing: f64,
    /// Correlation of the noise from sample to sample (AR(1)), and its standard deviation in K.
    pub(crate) rho: f64,
    pub(crate) deviation: f64,
    /// Standard deviation in K and correlation time in s of a slow drift beside it.
    pub(crate) drift: (f64, f64),
    /// Degrees of freedom of Student's t of what drives the fast noise; infinite for a normal one.
    pub(crate) tails: f64,
    /// What the standard deviation of the fast noise is multiplied by in the first and the second
    /// half.
    pub(crate) halves: (f64, f64),
    /// Step of the logger in K; 0 for none.
    pub(crate) step: f64,
    /// Amplitude in K and time constant in s of a second exponential.
    pub(crate) second: (f64, f64),
}

impl Truth {
    /// 25 minutes at 5 Hz of the seed paper's 7000 rpm, noise of 0.1 K rounded to 0.1 K.
    pub(crate) const PAPER: Self = Self {
        curve: [25.5, 92.7, 810.0],
        samples: 7500,
        spacing: 0.2,
        rho: 0.9,
        deviation: 0.1,
        drift: (0.0, 1.0),
        tails: f64::INFINITY,
        halves: (1.0, 1.0),
        step: 0.1,
        second: (0.0, 1.0),
    };

    /// Times in s and temperatures in degC; each seed has its own noise.
    pub(crate) fn record(&self, seed: u128) -> (Vec<f64>, Vec<f64>) {
        let mut random =
            Pcg64::new(0xcafe_f00d_d15e_a5e5 + seed, 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut noise = self.deviation * normal();
        let mut drift = self.drift.0 * normal();
        let kept = (-self.spacing / self.drift.1).exp();
        let times: Vec<f64> = (0..self.samples).map(|i| i as f64 * self.spacing).collect();
        let [initial, settled, tau] = self.curve;
        let mut value = |t: &f64| {
            let slow = (initial - settled - self.second.0) * (-t / tau).exp();
            let half = 0.5 * self.samples as f64 * self.spacing;
            let fast = noise * if *t < half { self.halves.0 } else { self.halves.1 };
            let exact = settled + slow + self.second.0 * (-t / self.second.1).exp() + fast + drift;
            let driven = match self.tails.is_finite() {
                // of variance 1
                true => {
                    let n = self.tails.round();
                    let squares: f64 = (0..n as u32).map(|_| normal().powi(2)).sum();
                    normal() * ((n - 2.0) / squares).sqrt()
                }
                false => normal(),
            };
            noise = self.rho * noise + (1.0 - self.rho * self.rho).sqrt() * self.deviation * driven;
            if self.drift.0 > 0.0 {
                drift = kept * drift + (1.0 - kept * kept).sqrt() * self.drift.0 * normal();
            }
            if self.step > 0.0 { (exact / self.step).round() * self.step } else { exact }
        };
        let values = times.iter().map(&mut value).collect();
        (times, values)
    }

    /// The fits of so many records.
    pub(crate) fn fits(&self, records: u32) -> Vec<StepFit> {
        let seeds: Vec<u32> = (0..records).collect();
        in_parallel(&seeds, available_threads(), |&seed| {
            let (times, values) = self.record(seed.into());
            StepFit::new(&times, &values).unwrap_or_else(|error| panic!("record {seed}: {error}"))
        })
    }
}

/// In how many percent of the fits the 95 % intervals of `T_i`, `T_f` and `t_RC` hold the truth.
pub(crate) fn coverage(truth: &Truth, fits: &[StepFit]) -> [f64; 3] {
    let numbers = |fit: &StepFit| [fit.initial, fit.settled, fit.tau];
    let holds =
        |estimated: &Estimated, value: f64| (estimated.value - value).abs() <= estimated.half_width;
    std::array::from_fn(|k| {
        let inside = fits.iter().filter(|fit| holds(&numbers(fit)[k], truth.curve[k])).count();
        100.0 * inside as f64 / fits.len() as f64
    })
}
