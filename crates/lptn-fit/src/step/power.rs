//! Heat from a time constant.

use lptn_units::statistics;
use lptn_units::statistics::student_95;

use super::error::StepError;
use super::{Random, StepFit};
use crate::noise::Noise;

/// The capacity that is believed, with one standard deviation, in J/K. The paper gives none for its
/// 2659 J/K, although `P` is proportional to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capacity {
    /// The most likely value, above 0.
    pub value: f64,
    /// One standard deviation; 0 if it is taken as exact.
    pub deviation: f64,
}

/// Possible errors of a thermocouple of some class.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensor {
    /// The limit of its offset, in K: ± 3 K in the paper. All offsets inside are assumed equally
    /// likely, so one standard deviation is this over sqrt(3) (GUM, JCGM 100:2008, 4.3.7). It drops
    /// out of differences of one sensor.
    pub class: f64,
    /// One standard deviation of its gain, relative.
    pub gain: f64,
}

/// The zero of `dT`. The paper uses three: `T_i`, the bed at some time, and the bed's mean.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceTemperature<'a> {
    /// `T_i` of the fit: the same sensor.
    Initial,
    /// The mean of another column over the whole record.
    Column {
        /// The name of the column in the record.
        name: String,
        /// The record's times in s.
        times: &'a [f64],
        /// Its temperatures in K, NaN if there is none.
        temperatures: &'a [f64],
    },
    /// A temperature in K, on the scale of the record, taken as exact.
    Value(f64),
}

/// A number with separate random and systematic errors: the first falls with more samples or
/// repeated runs, the second is the same in every run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    /// The number, in the unit of its quantity.
    pub value: f64,
    /// Its random standard error.
    pub random: f64,
    /// Half the width of the 95 % interval that the random error alone gives.
    pub half_width: f64,
    /// Its systematic standard error.
    pub systematic: f64,
}

/// Results of a step with a capacity. The errors do not include that a network of several nodes
/// does not follow one exponential: see [`ModelBias`](super::ModelBias).
#[derive(Clone, Debug, PartialEq)]
pub struct Power {
    /// `R_eq = t_RC / C` in K/W (equation 8).
    pub resistance: Parted,
    /// `dT = T_f - T_ref` in K.
    pub rise: Parted,
    /// `P = dT / R_eq` in W (equation 11).
    pub power: Parted,
    /// The reference: `initial`, the column's name, or `value`.
    pub reference: String,
    /// Its temperature in K, with its random standard error.
    pub reference_temperature: f64,
    /// Random standard error of that temperature.
    pub reference_error: f64,
    /// Change of the reference column over the record by its straight line, in K; 0 for the others.
    /// A bed that warms is not fixed ground.
    pub drift: f64,
}

impl Power {
    /// `R_eq`, `dT` and `P` from a fit.
    ///
    /// # Errors
    /// [`StepError::Capacity`], and [`StepError::Reference`] if the column is empty.
    pub fn new(
        fit: &StepFit,
        capacity: Capacity,
        reference: &ReferenceTemperature<'_>,
        sensor: Sensor,
    ) -> Result<Self, StepError> {
        let positive =
            capacity.value > 0.0 && capacity.value.is_finite() && capacity.deviation >= 0.0;
        if !positive {
            return Err(StepError::Capacity(capacity.value));
        }
        let zero = Zero::new(fit, reference)?;
        let (c, tau, rise) = (capacity.value, fit.tau.value, fit.settled.value - zero.value);
        let relative = capacity.deviation / c;
        let resistance = parted(fit, tau / c, [0.0, 0.0, 1.0 / c], 0.0, tau / c * relative);
        let offset = f64::sqrt(zero.sensors) * sensor.class / 3_f64.sqrt();
        let in_rise = offset.hypot(sensor.gain * rise);
        // T_i takes part only if it is the reference
        let initial = if zero.own { -1.0 } else { 0.0 };
        let of_rise = parted(fit, rise, [initial, 1.0, 0.0], zero.error, in_rise);
        let heat = c * rise / tau;
        let by = [initial * c / tau, c / tau, -heat / tau];
        let power =
            parted(fit, heat, by, zero.error * c / tau, (heat * relative).hypot(in_rise * c / tau));
        Ok(Self {
            resistance,
            rise: of_rise,
            power,
            reference: zero.name,
            reference_temperature: zero.value,
            reference_error: if zero.own { fit.initial.standard_error } else { zero.error },
            drift: zero.drift,
        })
    }
}

/// A number with these derivatives by `T_i`, `T_f`, `t_RC` and another random error.
fn parted(fit: &StepFit, value: f64, gradient: [f64; 3], more: f64, systematic: f64) -> Parted {
    let found = fit.random.estimated(value, &gradient);
    let random = found.standard_error.hypot(more);
    Parted { value, random, half_width: random * student_95(found.degrees_of_freedom), systematic }
}

/// The zero of dT.
struct Zero {
    name: String,
    value: f64,
    /// Random error from other sources than the fit.
    error: f64,
    /// True if it is `T_i` of the fit.
    own: bool,
    /// Number of sensors whose offsets are in a difference to it.
    sensors: f64,
    drift: f64,
}

impl Zero {
    fn new(fit: &StepFit, reference: &ReferenceTemperature<'_>) -> Result<Self, StepError> {
        let (name, value, own, sensors) = match reference {
            ReferenceTemperature::Initial => ("initial", fit.initial.value, true, 0.0),
            ReferenceTemperature::Value(value) => ("value", *value, false, 1.0),
            ReferenceTemperature::Column { name, times, temperatures } => {
                return Self::column(name, times, temperatures);
            }
        };
        Ok(Self { name: name.into(), value, error: 0.0, own, sensors, drift: 0.0 })
    }

    /// The mean of a column. Its random error is that of the noise around the column's straight
    /// line.
    fn column(name: &str, times: &[f64], temperatures: &[f64]) -> Result<Self, StepError> {
        let rows = times.iter().zip(temperatures).filter(|(_, value)| value.is_finite());
        let (times, values): (Vec<f64>, Vec<f64>) = rows.map(|(t, v)| (*t, *v)).unzip();
        if values.is_empty() {
            return Err(StepError::Reference);
        }
        let (mean, middle) = (statistics::mean(&values), statistics::mean(&times));
        let apart: Vec<f64> = times.iter().map(|t| t - middle).collect();
        let square: f64 = apart.iter().map(|a| a * a).sum();
        let product: f64 = apart.iter().zip(&values).map(|(a, v)| a * (v - mean)).sum();
        let slope = if square > 0.0 { product / square } else { 0.0 };
        let residuals: Vec<f64> =
            apart.iter().zip(&values).map(|(a, v)| mean + slope * a - v).collect();
        let jacobian: Vec<f64> = std::iter::repeat_n(1.0, values.len()).chain(apart).collect();
        let error = || {
            let noise = Noise::estimate(&times, &residuals, &jacobian);
            Random::new(&times, &jacobian, &noise)?.covariance.standard_error(0)
        };
        let error = if values.len() > 2 { error().unwrap_or(0.0) } else { 0.0 };
        let drift = slope * (times[times.len() - 1] - times[0]);
        Ok(Self { name: name.to_owned(), value: mean, error, own: false, sensors: 2.0, drift })
    }
}
