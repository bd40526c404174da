//! A filter that takes one reading after the other.

use lptn_integrate::vectors::add;

use super::{Fade, Gaussian, Reading, Step, weighed};

/// The state after the readings up to now.
#[derive(Clone, Debug)]
pub struct Filter {
    state: Gaussian,
    likelihood: Likelihood,
    room: Room,
}

/// Room for the numbers of one step or one reading.
#[derive(Clone, Debug)]
struct Room {
    /// Part of a product of matrices.
    half: Vec<f64>,
    mean: Vec<f64>,
    /// The covariance of a reading with each state.
    spread: Vec<f64>,
    /// The same over the standard deviation of the reading.
    unit: Vec<f64>,
    /// The change of the states per unit of the residual.
    gain: Vec<f64>,
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
        let (n, half) = (state.mean.len(), vec![0.0; state.covariance.len()]);
        let row = || vec![0.0; n];
        let room = Room { half, mean: row(), spread: row(), unit: row(), gain: row() };
        Self { state, likelihood: Likelihood::default(), room }
    }

    /// The present state.
    pub fn state(&self) -> &Gaussian {
        &self.state
    }

    /// The logarithm of the probability density of all readings up to now, by their innovations
    /// (F. C. Schweppe, IEEE Trans. Inf. Theory 11 (1965) 61).
    pub fn log_likelihood(&self) -> f64 {
        self.likelihood.logarithm()
    }

    /// Goes on to the time of the next reading.
    pub fn predict(&mut self, step: &Step) {
        let Gaussian { mean, covariance } = &mut self.state;
        let (n, d) = (mean.len(), step.transition.side());
        step.transition.advance(&step.fades, mean, &mut self.room.mean);
        mean.iter_mut().zip(step.input.iter()).for_each(|(x, u)| *x += u);
        step.transition.carry(&step.fades, covariance, &mut self.room.half);
        let rows = covariance.chunks_exact_mut(n).zip(step.noise.chunks_exact(d.max(1)));
        rows.for_each(|(row, noise)| row.iter_mut().zip(noise).for_each(|(p, q)| *p += q));
        for (i, Fade { variance, .. }) in step.fades.iter().enumerate() {
            covariance[(d + i) * (n + 1)] += variance;
        }
    }

    /// Takes a reading in: `P - u u'`, with `u` the covariance of the reading with the states over
    /// its standard deviation.
    pub fn update(&mut self, reading: &Reading) -> Innovation {
        let Room { spread, unit, gain, .. } = &mut self.room;
        self.state.spread_to(&reading.of, spread);
        let Gaussian { mean, covariance } = &mut self.state;
        let variance = weighed(&reading.of, spread) + reading.variance;
        let residual = reading.value - weighed(&reading.of, mean);
        let deviation = variance.sqrt();
        unit.iter_mut().zip(&*spread).for_each(|(u, s)| *u = s / deviation);
        gain.iter_mut().zip(&*spread).for_each(|(k, s)| *k = s / variance);
        add(mean, residual, gain);
        for (row, own) in covariance.chunks_exact_mut(unit.len()).zip(&*unit) {
            if own.abs() > 0.0 {
                add(row, -own, unit);
            }
        }
        self.likelihood.take(residual, variance);
        Innovation { residual, variance }
    }

    /// The change of the states per unit of the last residual.
    pub(super) fn gain(&self) -> &[f64] {
        &self.room.gain
    }
}

/// The probability density of readings.
#[derive(Clone, Debug)]
struct Likelihood {
    /// Sum of the squares of the residuals over their variances.
    squares: f64,
    count: usize,
    /// The product of variances is that of `e` to the power `logarithms`, and `product`.
    logarithms: f64,
    product: f64,
}

impl Default for Likelihood {
    fn default() -> Self {
        Self { squares: 0.0, count: 0, logarithms: 0.0, product: 1.0 }
    }
}

impl Likelihood {
    fn take(&mut self, residual: f64, variance: f64) {
        self.squares += residual * residual / variance;
        self.count += 1;
        self.product *= variance;
        // one logarithm for many factors
        if !(1e-100..1e100).contains(&self.product) {
            self.logarithms += self.product.ln();
            self.product = 1.0;
        }
    }

    fn logarithm(&self) -> f64 {
        let whole = self.count as f64 * std::f64::consts::TAU.ln();
        -0.5 * (whole + self.logarithms + self.product.ln() + self.squares)
    }
}
