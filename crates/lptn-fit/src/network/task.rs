//! Tasks of fits.

use std::fmt;

use lptn_analysis::RunAnalysis;
use lptn_netlist::{Sensor, SensorValue};
use lptn_network::{Network, NodeId, Parameters, Value, Varied, ZERO_CELSIUS};
use lptn_solve::{Proceed, Progress, RecordedNodes};
use lptn_units::{Correlations, Type};

use crate::network::recorded::{RecordedSignal, RecordedStart};

/// A fit of parameters of a network to records of its temperatures and heat flows.
#[derive(Clone, Debug)]
pub struct NetworkFitTask {
    /// The network; the start values of the parameters are its own.
    pub network: Network,
    /// The varied parameters, each once.
    pub parameters: Vec<Varied>,
    /// Correlations of their priors, in their order.
    pub correlations: Correlations,
    /// The instruments that columns name.
    pub sensors: Vec<Instrument>,
    /// The records, each of a separate run.
    pub runs: Vec<MeasuredRun>,
    /// Number of searches from points between the bounds, in addition to the one from the own
    /// values.
    pub more_starts: usize,
    /// Number of runs that are computed at once; nothing depends on it.
    pub threads: usize,
}

/// Progress of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FitStage {
    /// The search, from 1; 0 for the last one, from the best of them with all rows.
    pub search: usize,
    /// Number of searches.
    pub of: usize,
    /// Number of times that the runs of all records were begun.
    pub evaluations: usize,
}

impl fmt::Display for FitStage {
    /// `search 2 of 5, round 14`, `the last search, round 3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.search {
            0 => write!(f, "the last search, round {}", self.evaluations),
            search => write!(f, "search {search} of {}, round {}", self.of, self.evaluations),
        }
    }
}

/// Is called after every step of every run, on its thread, and may interrupt the fit.
pub type FitObserver<'a> = dyn Fn(FitStage, Progress) -> Proceed + Sync + 'a;

/// A record, and its run.
#[derive(Clone, Debug)]
pub struct MeasuredRun {
    /// The name of the record.
    pub name: String,
    /// The values that the parameters have in this run, but for the varied ones; see
    /// [`Network::overrides`].
    pub parameters: Parameters,
    /// The time histories of signals that the record has measured.
    pub signals: Vec<RecordedSignal>,
    /// Nodes that do not begin at the temperature of the network.
    pub initial: Vec<RecordedStart>,
    /// Start and controls of the run; its stop, rows and tolerance follow from the record.
    pub settings: RunAnalysis,
    /// The times of the rows in s, ascending, on the clock of the run: none before its start, at
    /// least one after it.
    pub times: Vec<f64>,
    /// The measured columns.
    pub columns: Vec<MeasuredColumn>,
}

/// An instrument that measures a temperature x over 0 degC. It reads `gain y + offset` over 0 degC,
/// with `lag dy/dt = x - y` from rest at the start of the run. All in SI units. Other quantities
/// than temperatures count from their own zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Instrument {
    /// Its name.
    pub name: String,
    /// Offset in the SI unit of its columns, K for a temperature.
    pub offset: SensorValue,
    /// Gain, a factor.
    pub gain: SensorValue,
    /// Its time constant in s; 0 without one.
    pub lag: SensorValue,
    /// True if an unknown offset differs from record to record.
    pub per_record: bool,
}

impl From<&Sensor> for Instrument {
    fn from(sensor: &Sensor) -> Self {
        Self {
            name: sensor.name.clone(),
            offset: sensor.offset,
            gain: sensor.gain,
            lag: sensor.lag,
            per_record: sensor.per_record,
        }
    }
}

/// Quantity that a column measures.
#[derive(Clone, Debug)]
pub enum Measurand {
    /// The sum of temperatures of nodes times these factors: one of them, a mean, a difference.
    Temperatures(Vec<(NodeId, f64)>),
    /// An expression of temperatures and heat flows, compiled for the network.
    Result(Value),
}

/// A measured column.
#[derive(Clone, Debug)]
pub struct MeasuredColumn {
    /// The name of the column in its file.
    pub name: String,
    /// The measured quantity.
    pub of: Measurand,
    /// Its type; values are in the SI unit of that.
    pub ty: Type,
    /// Index of its instrument among those of the task; `None` for an ideal one.
    pub sensor: Option<usize>,
    /// Standard deviation of one value; `None` counts as 1.
    pub sigma: Option<f64>,
    /// One value for each time; NaN if nothing was measured.
    pub values: Vec<f64>,
}

impl MeasuredColumn {
    /// The standard deviation that residuals are divided by.
    pub(crate) fn weight(&self) -> f64 {
        self.sigma.unwrap_or(1.0)
    }

    /// Zero of its instrument.
    pub(crate) fn zero(&self) -> f64 {
        if self.ty.absolute { ZERO_CELSIUS } else { 0.0 }
    }

    /// The nodes whose temperatures make it up, with their factors; none if it is an expression of
    /// other results.
    pub fn nodes(&self) -> &[(NodeId, f64)] {
        match &self.of {
            Measurand::Temperatures(nodes) => nodes,
            Measurand::Result(_) => &[],
        }
    }
}

impl NetworkFitTask {
    /// The type of differences of the measured quantities, if all columns have its unit; `None` if
    /// there is no common one.
    pub fn unit(&self) -> Option<Type> {
        let mut all = self.runs.iter().flat_map(|run| &run.columns).map(|column| column.ty);
        let first = all.next()?.dimension;
        all.all(|ty| ty.dimension == first).then_some(Type::of(first))
    }

    /// The largest magnitude of an instrument's readings: over 0 degC for a temperature.
    pub(crate) fn largest_of(&self, sensor: usize) -> f64 {
        let columns = self.runs.iter().flat_map(|run| &run.columns);
        let own = columns.filter(|column| column.sensor == Some(sensor));
        let sizes = own.flat_map(|column| column.values.iter().map(|v| (v - column.zero()).abs()));
        sizes.fold(0.0, f64::max)
    }
}

impl MeasuredRun {
    /// The starts whose readings are of a later time: after its start by more than the usual time
    /// between two rows, the median.
    pub fn late_starts(&self) -> impl Iterator<Item = &RecordedStart> {
        let mut between: Vec<f64> = self.times.windows(2).map(|two| two[1] - two[0]).collect();
        between.sort_unstable_by(f64::total_cmp);
        let usual = between.get(between.len() / 2).copied().unwrap_or(0.0);
        let known_from = self.settings.start() + usual;
        self.initial.iter().filter(move |start| start.read_at > known_from)
    }

    /// The nodes that its columns need, ascending.
    pub(crate) fn nodes(&self) -> Vec<NodeId> {
        let mut nodes: Vec<NodeId> = self
            .columns
            .iter()
            .flat_map(|column| column.nodes().iter().map(|(node, _)| *node))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// The type of an instrument's readings in it, if there are any.
    pub(crate) fn reads(&self, sensor: usize) -> Option<Type> {
        let columns = self.columns.iter().map(|column| (column.sensor, column.ty));
        let signals = self.signals.iter().map(|signal| (signal.sensor, signal.ty));
        columns.chain(signals).find(|(own, _)| *own == Some(sensor)).map(|(_, ty)| ty)
    }

    /// The nodes that must be kept of its run.
    pub(crate) fn kept(&self) -> RecordedNodes {
        let follows = |column: &MeasuredColumn| matches!(column.of, Measurand::Result(_));
        match self.columns.iter().any(follows) {
            true => RecordedNodes::All,
            false => RecordedNodes::Nodes(self.nodes()),
        }
    }
}
