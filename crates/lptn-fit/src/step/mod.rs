//! The seed paper's fit: one exponential through the record of a thermocouple.
//!
//! `T(t) = T_f + (T_i - T_f) exp(-t / t_RC)` (the paper's equation 10, which prints `T_i` and `T_f`
//! exchanged) by least squares: [`StepFit`]. With a capacity follow `R_eq = t_RC / C` and
//! `P = dT / R_eq` (equations 8 and 11): [`Power`]. With a model follow the errors of the method:
//! [`ModelBias`]. Without one, no error that is stated here includes that bias.
//!
//! Units: s, K, W, J/K. Temperatures may be on any scale with kelvins as steps; differences come
//! out the same.

mod bias;
mod error;
mod lack;
mod posterior;
mod power;
mod saturation;
mod second;
mod still;
mod terms;

use lptn_reduce::fit_exponential;
use lptn_units::statistics::student_95;

use crate::Covariance;
use crate::noise::{Middle, Noise, resolution};

pub use bias::{FittedValue, ModelBias};
pub use error::{Lack, StepError};
pub use power::{Capacity, Parted, Power, ReferenceTemperature, Sensor};
pub use second::{LikelihoodRatioTest, TwoExponentials};
pub use terms::{
    ExponentialSum, MOST_TERMS, PositiveEstimate, StepCurve, TermEstimate, TermsError, TermsTried,
};

/// A record shorter than this many time constants extrapolates.
pub const LONG_ENOUGH: f64 = 3.0;

/// A number with its standard error and 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimated {
    /// The number, in the unit of its quantity.
    pub value: f64,
    /// Its standard error, corrected for residuals that depend on each other.
    pub standard_error: f64,
    /// The error if every sample were independent of the others: for comparison, it is too small.
    pub naive: f64,
    /// Half the width of the 95 % interval: the error times the quantile of Student's t.
    pub half_width: f64,
    /// The degrees of freedom of that quantile.
    pub degrees_of_freedom: f64,
}

impl Estimated {
    /// The 95 % interval.
    pub fn interval(&self) -> (f64, f64) {
        (self.value - self.half_width, self.value + self.half_width)
    }
}

/// One exponential through one column of a record, time counted from the record's first.
#[derive(Clone, Debug, PartialEq)]
pub struct StepFit {
    /// `T_i`: the curve at the first time.
    pub initial: Estimated,
    /// `T_f`: the limit of the curve.
    pub settled: Estimated,
    /// `t_RC` in s.
    pub tau: Estimated,
    /// Root mean square of the residuals, in K.
    pub rms: f64,
    /// Number of samples that were fitted.
    pub samples: usize,
    /// Number of cells without a value, which are left out.
    pub gaps: usize,
    /// From the first to the last sample, in s.
    pub length: f64,
    /// Distance of `T_f` beyond the curve's end, in K: if the record is shorter than
    /// [`LONG_ENOUGH`] time constants, that much is extrapolated.
    pub beyond: f64,
    /// The random part of the record.
    pub noise: Noise,
    /// The step of the instrument's numbers in K, if they have one.
    pub resolution: Option<f64>,
    /// True if the residuals are little more than the rounding to that step. It then follows the
    /// curve and does not average out as noise does: the intervals contain the true value less
    /// often than they say (in 86 of 100 records with a step of five deviations of slow noise).
    pub coarse: bool,
    /// Time in s, on the clock of the record, until which it is constant, if that is more than a
    /// tenth of `t_RC`: the step begins later than the record, and one exponential does not.
    pub still_until: Option<f64>,
    /// Test for a second exponential in the residuals.
    pub second: LikelihoodRatioTest,
    /// Data for the errors of derived quantities.
    random: Random,
}

/// Random errors of any function of fitted numbers.
#[derive(Clone, Debug, PartialEq)]
struct Random {
    /// `(J^T J)^-1`.
    inverse: Covariance,
    middle: Middle,
    /// The sandwich of both.
    covariance: Covariance,
    /// Standard deviation of the residuals.
    deviation: f64,
}

impl Random {
    /// From the derivatives of residuals at these times, one number after the other; `None` if they
    /// do not determine all numbers.
    fn new(times: &[f64], jacobian: &[f64], noise: &Noise) -> Option<Self> {
        let all: Vec<usize> = (0..jacobian.len() / times.len()).collect();
        let inverse = Covariance::inverse(jacobian, times.len(), &all)?;
        let middle = noise.middle(times, jacobian);
        let covariance = inverse.sandwich(&middle.values);
        Some(Self { inverse, middle, covariance, deviation: noise.deviation })
    }

    /// A function of the numbers with this value and these derivatives by them.
    fn estimated(&self, value: f64, gradient: &[f64]) -> Estimated {
        let standard_error = self.covariance.propagated(gradient);
        let degrees_of_freedom = self.middle.degrees_of_freedom(&self.inverse, gradient);
        let naive = self.deviation * self.inverse.propagated(gradient);
        let half_width = standard_error * student_95(degrees_of_freedom);
        Estimated { value, standard_error, naive, half_width, degrees_of_freedom }
    }
}

impl StepFit {
    /// Fits a column: `temperatures` in K at strictly ascending `times` in s, NaN if there is none.
    ///
    /// # Errors
    /// [`StepError`]
    pub fn new(times: &[f64], temperatures: &[f64]) -> Result<Self, StepError> {
        if times.len() != temperatures.len() {
            return Err(StepError::Length { times: times.len(), values: temperatures.len() });
        }
        let first = times.first().copied().unwrap_or(0.0);
        let rows = times.iter().zip(temperatures).filter(|(_, value)| !value.is_nan());
        let (times, values): (Vec<f64>, Vec<f64>) =
            rows.map(|(t, value)| (t - first, *value)).unzip();
        let gaps = temperatures.len() - values.len();
        let fit = fit_exponential(&times, &values).map_err(StepError::Fit)?;
        let step = resolution(&values);
        saturation::check(&times, &values, first, step.unwrap_or(0.0))?;
        let undetermined = |lack: Lack| StepError::Undetermined { tau: fit.tau, lack };
        if let Some(lack) = lack::between(&times, fit.tau) {
            return Err(undetermined(lack));
        }
        let (residuals, jacobian) = curve(&times, &values, [fit.initial, fit.settled, fit.tau]);
        let noise = Noise::with_drift(&times, &residuals, &jacobian);
        let random = Random::new(&times, &jacobian, &noise).ok_or(undetermined(Lack::Alike))?;
        let coarse = step.is_some_and(|step| step / 12_f64.sqrt() > 0.7 * fit.rms);
        let estimated = |j: usize, value: f64| {
            let gradient: [f64; 3] = std::array::from_fn(|k| if k == j { 1.0 } else { 0.0 });
            random.estimated(value, &gradient)
        };
        let tau = estimated(2, fit.tau);
        if let Some(lack) = lack::of(&tau, &values, &residuals) {
            return Err(undetermined(lack));
        }
        Ok(Self {
            initial: estimated(0, fit.initial),
            settled: estimated(1, fit.settled),
            tau,
            rms: fit.rms,
            samples: times.len(),
            gaps,
            length: times[times.len() - 1] - times[0],
            beyond: (fit.settled - fit.initial) * (-times[times.len() - 1] / fit.tau).exp(),
            still_until: still::until(&times, &values, fit.tau).map(|time| first + time),
            second: second::ask(&times, &values, &fit),
            resolution: step,
            coarse,
            noise,
            random,
        })
    }

    /// Covariance of `T_i`, `T_f` and `t_RC`, corrected as the errors are.
    pub fn covariance(&self) -> &Covariance {
        &self.random.covariance
    }

    /// The length of the record in time constants.
    pub fn time_constants(&self) -> f64 {
        self.length / self.tau.value
    }

    /// The curve at a time in s from the record's first, in K.
    pub fn at(&self, time: f64) -> f64 {
        let (from, to) = (self.initial.value, self.settled.value);
        to + (from - to) * (-time / self.tau.value).exp()
    }

    /// True if the record is so short that `T_f` and `t_RC` are extrapolated.
    pub fn extrapolates(&self) -> bool {
        self.time_constants() < LONG_ENOUGH
    }
}

/// Residuals of one exponential (curve less record), and its derivatives by `T_i`, `T_f` and
/// `t_RC`.
fn curve(times: &[f64], values: &[f64], [initial, settled, tau]: [f64; 3]) -> (Vec<f64>, Vec<f64>) {
    let decay: Vec<f64> = times.iter().map(|t| (-t / tau).exp()).collect();
    let misses =
        decay.iter().zip(values).map(|(d, v)| settled + (initial - settled) * d - v).collect();
    let slope = |(t, d): (&f64, &f64)| (initial - settled) * d * t / (tau * tau);
    let slopes = times.iter().zip(&decay).map(slope);
    let jacobian =
        decay.iter().copied().chain(decay.iter().map(|d| 1.0 - d)).chain(slopes).collect();
    (misses, jacobian)
}
