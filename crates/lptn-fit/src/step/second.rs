//! Test for a second exponential in a record, and its fit.

use lptn_integrate::vectors::{dot, take_off};
use lptn_reduce::ExponentialFit;
use lptn_units::statistics;

use super::{Estimated, Random};
use crate::least_squares::{Evaluated, LeastSquaresFit, Residuals, Settings, minimise};
use crate::noise::{Noise, orthonormal, stretches};

/// Number of stretches whose means are tested.
const STRETCHES: usize = 400;

/// At most some 10 of 1000 records without a second exponential have a larger likelihood ratio
/// (measured in the tests: its time constant is free, so the ratio does not follow chi-square with
/// two degrees of freedom, whose value would be 9.2).
const THRESHOLD: f64 = 13.0;

/// The likelihood ratio test for a second exponential in the residuals.
#[derive(Clone, Debug, PartialEq)]
pub struct LikelihoodRatioTest {
    /// Twice the logarithm of the ratio of the likelihoods with and without it, both with noise
    /// that is correlated as its residuals are: slow noise alone does not ask for it.
    pub ratio: f64,
    /// The limit that the ratio has to exceed.
    pub threshold: f64,
    /// The second exponential, if the test asks for it.
    pub offer: Option<TwoExponentials>,
}

/// `T_f + A_1 exp(-t / t_1) + A_2 exp(-t / t_2)`, time counted from the record's first.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoExponentials {
    /// `T_f` in K.
    pub settled: Estimated,
    /// `A_1` and `A_2` in K; negative if the temperature rises.
    pub amplitudes: [Estimated; 2],
    /// `t_1 > t_2` in s.
    pub taus: [Estimated; 2],
    /// Root mean square of the residuals, in K.
    pub rms: f64,
}

impl TwoExponentials {
    /// The curve at a time in s from the record's first, in K.
    pub fn at(&self, time: f64) -> f64 {
        let parts = self.amplitudes.iter().zip(&self.taus);
        let sum: f64 = parts.map(|(a, tau)| a.value * (-time / tau.value).exp()).sum();
        self.settled.value + sum
    }
}

/// Compares one exponential with two, on means of stretches.
pub(super) fn ask(times: &[f64], values: &[f64], one: &ExponentialFit) -> LikelihoodRatioTest {
    let nothing = LikelihoodRatioTest { ratio: 0.0, threshold: THRESHOLD, offer: None };
    let size = (times.len() / STRETCHES).max(1);
    let (few, means) = (stretches::means(times, size), stretches::means(values, size));
    let scale = values.iter().map(|v| (v - one.settled).abs()).fold(0.0, f64::max);
    if few.len() < 12 || one.rms <= 1e-12 * scale {
        return nothing;
    }
    let (residuals, jacobian) = super::curve(&few, &means, [one.initial, one.settled, one.tau]);
    let mut two = Two { times: &few, values: &means };
    let Some(two) =
        two.start(one.tau, &residuals, &jacobian).and_then(|start| two.fitted(&start, 1e-3))
    else {
        return nothing;
    };
    let misfit = |residuals: &[f64], jacobian: &[f64]| {
        Noise::of_stretches(&few, residuals, jacobian, 1).means.misfit
    };
    let ratio = misfit(&residuals, &jacobian) - misfit(&two.residuals, &two.jacobian);
    let asked = ratio > THRESHOLD && distinct(&two, &few);
    let offer = asked.then(|| Two { times, values }.fitted(&two.parameters, 1e-6)).flatten();
    LikelihoodRatioTest {
        ratio,
        threshold: THRESHOLD,
        offer: offer.and_then(|found| offered(times, &found)),
    }
}

/// True if both parts are visible: no time constant is on its bound, and they differ.
fn distinct(found: &LeastSquaresFit, times: &[f64]) -> bool {
    let (p, length) = (&found.parameters, times[times.len() - 1] - times[0]);
    let seen = |log: f64| log.exp() < 30.0 * length;
    found.outcome.converged()
        && seen(p[3])
        && seen(p[4])
        && (p[3] - p[4]).abs() > 0.1
        && found.on_bound.iter().all(Option::is_none)
}

fn offered(times: &[f64], found: &LeastSquaresFit) -> Option<TwoExponentials> {
    let noise = Noise::estimate(times, &found.residuals, &found.jacobian);
    if !distinct(found, times) {
        return None;
    }
    let random = Random::new(times, &found.jacobian, &noise)?;
    // parameter j times this: a time constant is the exponential of its parameter
    let estimated = |j: usize, value: f64, scale: f64| {
        let gradient: [f64; 5] = std::array::from_fn(|k| if k == j { scale } else { 0.0 });
        random.estimated(value, &gradient)
    };
    let p = &found.parameters;
    let [slow, fast] = if p[3] > p[4] { [0, 1] } else { [1, 0] };
    let tau = |k: usize| estimated(3 + k, p[3 + k].exp(), p[3 + k].exp());
    Some(TwoExponentials {
        settled: estimated(0, p[0], 1.0),
        amplitudes: [slow, fast].map(|k| estimated(1 + k, p[1 + k], 1.0)),
        taus: [tau(slow), tau(fast)],
        rms: (found.squares / times.len() as f64).sqrt(),
    })
}

/// Two exponentials through a record.
struct Two<'a> {
    times: &'a [f64],
    values: &'a [f64],
}

impl Two<'_> {
    /// `T_f`, `A_1`, `A_2`, `ln t_1`, `ln t_2` by least squares. An offset of 1e-3
    /// changes the likelihood of 400 means by 4e-4.
    fn fitted(&mut self, start: &[f64], gradient: f64) -> Option<LeastSquaresFit> {
        let free = (f64::NEG_INFINITY, f64::INFINITY);
        let logs = ((0.1 * self.spacing()).ln(), (100.0 * self.length()).ln());
        let bounds = vec![free, free, free, logs, logs];
        let cost = gradient * gradient;
        let settings = Settings { bounds, gradient, cost, iterations: 40, ..Settings::default() };
        minimise(self, start, &settings).ok()
    }

    /// Start from one exponential: the time constant of a grid whose decay explains most of its
    /// `residuals` in addition to their derivatives. Time constants near the first one are not
    /// tried.
    fn start(&self, tau: f64, residuals: &[f64], jacobian: &[f64]) -> Option<Vec<f64>> {
        const GRID: usize = 24;
        let basis = orthonormal(jacobian, self.times.len());
        let (from, to) = (self.spacing().ln(), (5.0 * self.length()).ln());
        let mut best: Option<(f64, f64)> = None;
        for k in 0..GRID {
            let log = from + (to - from) * k as f64 / (GRID - 1) as f64;
            if (log - tau.ln()).abs() < 0.4 {
                continue;
            }
            let mut decay = self.decay(log);
            take_off(&mut decay, &basis);
            let taken = dot(&decay, residuals).powi(2) / dot(&decay, &decay);
            if taken.is_finite() && best.is_none_or(|(most, _)| taken > most) {
                best = Some((taken, log));
            }
        }
        let (_, log) = best?;
        let (settled, a, b) = self.linear(&self.decay(tau.ln()), &self.decay(log))?;
        Some(vec![settled, a, b, tau.ln(), log])
    }

    fn spacing(&self) -> f64 {
        self.times[1] - self.times[0]
    }

    fn length(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    fn decay(&self, log: f64) -> Vec<f64> {
        let rate = (-log).exp();
        self.times.iter().map(|t| (-t * rate).exp()).collect()
    }

    /// `values = s + a x + b y`, by least squares.
    fn linear(&self, x: &[f64], y: &[f64]) -> Option<(f64, f64, f64)> {
        let (mx, my, mv) =
            (statistics::mean(x), statistics::mean(y), statistics::mean(self.values));
        let [mut xx, mut xy, mut yy, mut xv, mut yv] = [0.0; 5];
        for ((x, y), v) in x.iter().zip(y).zip(self.values) {
            let (x, y, v) = (x - mx, y - my, v - mv);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
            (xv, yv) = (xv + x * v, yv + y * v);
        }
        let determinant = xx * yy - xy * xy;
        if determinant <= 1e-12 * xx * yy {
            return None;
        }
        let (a, b) = ((yy * xv - xy * yv) / determinant, (xx * yv - xy * xv) / determinant);
        Some((mv - a * mx - b * my, a, b))
    }
}

impl Residuals for Two<'_> {
    fn parameters(&self) -> usize {
        5
    }

    fn evaluate(&mut self, p: &[f64], derivatives: bool) -> Evaluated {
        let decays = [self.decay(p[3]), self.decay(p[4])];
        let curve = decays[0].iter().zip(&decays[1]).map(|(x, y)| p[0] + p[1] * x + p[2] * y);
        let residuals = curve.zip(self.values).map(|(curve, value)| curve - value).collect();
        let mut jacobian = Vec::new();
        if derivatives {
            jacobian.resize(self.times.len(), 1.0);
            jacobian.extend(decays.iter().flatten());
            for (k, decay) in decays.iter().enumerate() {
                let slope = |(t, d): (&f64, &f64)| p[1 + k] * d * t / p[3 + k].exp();
                jacobian.extend(self.times.iter().zip(decay).map(slope));
            }
        }
        Ok((residuals, jacobian))
    }
}
