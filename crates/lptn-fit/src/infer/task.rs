//! Tasks of inference.

use lptn_network::{Course, Network, ParameterId, SignalId};
use lptn_units::{Correlations, Distribution, Spread};

use crate::network::{Held, Instrument, MeasuredRun};

/// Time histories of signals to infer from one record.
#[derive(Clone, Debug)]
pub struct InferTask {
    /// The network. Estimated signals begin at their own time histories.
    pub network: Network,
    /// The record. Its run begins at `settings.start`.
    pub run: MeasuredRun,
    /// The instruments that columns name.
    pub sensors: Vec<Instrument>,
    /// The estimated signals, each once.
    pub estimated: Vec<Estimated>,
    /// Parameters that are not known exactly. The record updates them too.
    pub uncertain: Vec<Uncertain>,
    /// Their correlations.
    pub together: Correlations,
    /// Knowledge of the start.
    pub start: Start,
    /// Knowledge of the slow part of the noise.
    pub drift: Drift,
}

impl InferTask {
    /// The time histories of the signals that follow the record, whose instruments are known.
    pub(crate) fn inputs(&self) -> Vec<(SignalId, Course)> {
        let held = |sensor: Option<usize>| Held::of(sensor.and_then(|i| self.sensors.get(i)));
        self.run.signals.iter().map(|s| (s.signal, s.course(held(s.sensor)))).collect()
    }
}

/// A parameter that is not known exactly. Its coordinate counts standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The parameter.
    pub parameter: ParameterId,
    /// Standard deviation in SI units, above 0; for a lognormal one, that of its logarithm.
    pub deviation: f64,
    /// True if its logarithm is normal, so that it stays above 0.
    pub lognormal: bool,
}

impl Uncertain {
    /// A parameter of this value with its spread.
    pub fn new(parameter: ParameterId, value: f64, spread: Spread) -> Self {
        let lognormal = spread.distribution == Distribution::Lognormal && value > 0.0;
        let deviation = if lognormal { spread.of_logarithm(value) } else { spread.sigma(value) };
        Self { parameter, deviation, lognormal }
    }

    /// One standard deviation in SI units at a value, to first order.
    pub fn unit(&self, value: f64) -> f64 {
        if self.lognormal { self.deviation * value } else { self.deviation }
    }

    /// The value moved by a number of standard deviations.
    pub(crate) fn moved(&self, value: f64, by: f64) -> f64 {
        let far = self.deviation * by;
        if self.lognormal { value * far.exp() } else { value + far }
    }

    /// Number of standard deviations from another value to this one.
    pub(crate) fn beyond(&self, value: f64, other: f64) -> f64 {
        let far = if self.lognormal { (value / other).ln() } else { value - other };
        far / self.deviation
    }
}

/// A signal with a time history to be estimated: a random walk, or one of its logarithm.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimated {
    /// The signal.
    pub signal: SignalId,
    /// Its name.
    pub name: String,
    /// True if its logarithm walks, so that it stays above 0.
    pub positive: bool,
    /// Variance of the walk per s, in SI units squared per s or, for a logarithm, 1/s; `None` for
    /// the value that makes the record most likely.
    pub intensity: Option<f64>,
    /// True if it may jump when the record shows it.
    pub jumps: bool,
}

/// The part of the noise of each column that decays with `exp(-t / time)`; the rest is white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drift {
    /// The one that makes the record most likely. The standard deviation of a column is then that
    /// of both parts.
    Open,
    /// The same for all columns, in addition to their own standard deviation.
    Known {
        /// Standard deviation in K; 0 if all noise is white.
        deviation: f64,
        /// Time in s, above 0.
        time: f64,
    },
}

/// Knowledge of the temperatures at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// They are those of the network.
    Known,
    /// Unknown for nodes that a column measures; the others are those of the network.
    Measured,
    /// All are unknown.
    Free,
}
