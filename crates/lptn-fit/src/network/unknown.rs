//! Everything that a fit finds: parameters of the network and values of sensors.
//!
//! Values of a sensor are unknowns like parameters, but they change the readings only
//! (`readings.rs`) and cost no run. The exceptions are values that a signal follows or a node
//! starts from (`held.rs`). They change the run and cost two runs each, whose difference is their
//! derivative.

use lptn_netlist::Certainty;
use lptn_network::ParameterId;
use lptn_units::{Dimension, Distribution, Type};

use crate::network::task::{Instrument, NetworkFitTask};

/// Quantity of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnknownOf {
    /// A parameter of the network.
    Parameter(ParameterId),
    /// The offset of a sensor, by its index in the task: for all records, or for one.
    Offset {
        /// Index of the sensor.
        sensor: usize,
        /// Index of the record.
        run: Option<usize>,
    },
    /// The gain of a sensor.
    Gain {
        /// Index of the sensor.
        sensor: usize,
    },
    /// The time constant of a sensor.
    Lag {
        /// Index of the sensor.
        sensor: usize,
    },
}

/// A number to find, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its quantity.
    pub of: UnknownOf,
    /// Its name: a parameter's, or `tc1.offset`.
    pub name: String,
    /// Its own value: the start of a search, and the prior value.
    pub own: f64,
    /// Its least and its greatest value.
    pub bounds: (f64, f64),
    /// Prior standard deviation.
    pub prior: Option<f64>,
    /// Distribution of the prior: a rectangle counts as normal with its standard deviation.
    pub distribution: Distribution,
    /// Its type.
    pub ty: Type,
}

impl Unknown {
    /// The parameter of the network, if it is one.
    pub fn parameter(&self) -> Option<ParameterId> {
        match self.of {
            UnknownOf::Parameter(id) => Some(id),
            _ => None,
        }
    }

    /// The only record that it concerns, if there is one.
    pub fn run(&self) -> Option<usize> {
        match self.of {
            UnknownOf::Offset { run, .. } => run,
            _ => None,
        }
    }

    /// The index of the sensor, if it is a value of one.
    pub fn sensor(&self) -> Option<usize> {
        match self.of {
            UnknownOf::Parameter(_) => None,
            UnknownOf::Offset { sensor, .. }
            | UnknownOf::Gain { sensor }
            | UnknownOf::Lag { sensor } => Some(sensor),
        }
    }

    /// True if its zero has no meaning, so that it never counts as a logarithm.
    pub fn is_shift(&self) -> bool {
        self.ty.absolute || matches!(self.of, UnknownOf::Offset { .. })
    }
}

impl NetworkFitTask {
    /// The unknowns of the fit: the varied parameters, then the unknown values of the sensors that
    /// its records use, sensor by sensor.
    pub fn unknowns(&self) -> Vec<Unknown> {
        let parameter = |varied: &lptn_network::Varied| {
            let parameter = &self.network.parameters()[varied.parameter.index()];
            let set = self.runs.first().and_then(|run| run.parameters.deviation(varied.parameter));
            let spread = set.or(parameter.deviation);
            Unknown {
                of: UnknownOf::Parameter(varied.parameter),
                name: parameter.name.clone(),
                own: self.network.parameter_value(varied.parameter),
                bounds: varied.bounds,
                prior: varied.prior,
                distribution: spread.map_or_else(Default::default, |spread| spread.distribution),
                ty: parameter.ty,
            }
        };
        let mut all: Vec<Unknown> = self.parameters.iter().map(parameter).collect();
        let used = |sensor: usize| self.runs.iter().any(|run| run.reads(sensor).is_some());
        for (i, sensor) in self.sensors.iter().enumerate().filter(|(i, _)| used(*i)) {
            all.extend(self.unknowns_of(i, sensor));
        }
        all
    }

    fn unknowns_of(&self, sensor: usize, instrument: &Instrument) -> Vec<Unknown> {
        const ABOVE: (f64, f64) = (f64::MIN_POSITIVE, f64::INFINITY);
        const ANY: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
        // an instrument may follow at once
        const FROM_0: (f64, f64) = (0.0, f64::INFINITY);
        let measures = |run: &usize| self.runs[*run].reads(sensor).is_some();
        let records: Vec<Option<usize>> = match instrument.per_record {
            true => (0..self.runs.len()).filter(measures).map(Some).collect(),
            false => vec![None],
        };
        let own = self.runs.iter().find_map(|run| run.reads(sensor));
        let dimension = own.map_or(Dimension::TEMPERATURE, |ty| ty.dimension);
        let offset =
            |run| (UnknownOf::Offset { sensor, run }, instrument.offset, Type::of(dimension));
        let mut values: Vec<_> = records.into_iter().map(offset).collect();
        values.push((UnknownOf::Gain { sensor }, instrument.gain, Type::SCALAR));
        values.push((UnknownOf::Lag { sensor }, instrument.lag, Type::of(Dimension::TIME)));
        let estimated = values.into_iter().filter(|(_, value, _)| value.is_estimated());
        let unknown = |(of, value, ty): (UnknownOf, lptn_netlist::SensorValue, Type)| Unknown {
            of,
            name: format!("{}.{}", instrument.name, word(of)),
            own: value.value,
            bounds: match of {
                UnknownOf::Offset { .. } => ANY,
                UnknownOf::Lag { .. } => FROM_0,
                UnknownOf::Gain { .. } | UnknownOf::Parameter(_) => ABOVE,
            },
            prior: match value.certainty {
                Certainty::Deviation(deviation) => Some(deviation),
                Certainty::Exact | Certainty::Free => None,
            },
            distribution: Distribution::Normal,
            ty,
        };
        estimated.map(unknown).collect()
    }
}

fn word(of: UnknownOf) -> &'static str {
    match of {
        UnknownOf::Parameter(_) => "",
        UnknownOf::Offset { .. } => "offset",
        UnknownOf::Gain { .. } => "gain",
        UnknownOf::Lag { .. } => "lag",
    }
}
