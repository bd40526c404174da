//! What is to be fitted to what.

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
    /// What is varied; each parameter once.
    pub parameters: Vec<Varied>,
    /// How what is known of them beforehand is correlated, in their order.
    pub correlations: Correlations,
    /// The instruments that columns name.
    pub sensors: Vec<Instrument>,
    /// The records, each of a run of its own.
    pub runs: Vec<MeasuredRun>,
    /// How many searches begin elsewhere between the bounds, beside the one from the own values.
    pub more_starts: usize,
    /// How many runs are computed at once; nothing depends on it.
    pub threads: usize,
}

/// How far a fit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FitStage {
    /// The search, from 1; 0 for what goes on from the best of them with all rows.
    pub search: usize,
    /// How many searches there are.
    pub of: usize,
    /// How often the runs of all records were begun.
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

/// A record, and the run that it is one of.
#[derive(Clone, Debug)]
pub struct MeasuredRun {
    /// The name of the record.
    pub name: String,
    /// The values that the parameters have in this run, but for the varied ones; see
    /// [`Network::overrides`].
    pub parameters: Parameters,
    /// The courses of signals that the record has measured.
    pub signals: Vec<RecordedSignal>,
    /// Nodes that begin at another temperature than the network says.
    pub initial: Vec<RecordedStart>,
    /// Start and controls of the run; its stop, rows and tolerance follow from the record.
    pub settings: RunAnalysis,
    /// The times of the rows in s, ascending, on the clock of the run: none before its start, at
    /// least one behind it.
    pub times: Vec<f64>,
    /// What was measured.
    pub columns: Vec<MeasuredColumn>,
}

/// What an instrument makes of the temperature x over 0 degC that it measures: `gain y + offset`
/// over 0 degC, where `lag dy/dt = x - y` from rest at the start of the run. All in SI units. What
/// else is measured than a temperature counts from its own zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Instrument {
    /// Its name.
    pub name: String,
    /// In the SI unit of its columns, K for a temperature.
    pub offset: SensorValue,
    /// A factor.
    pub gain: SensorValue,
    /// Its time constant in s; 0 without one.
    pub lag: SensorValue,
    /// Whether an offset that is sought is another one in each record.
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

/// What a column measures.
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
    /// What was measured.
    pub of: Measurand,
    /// Its type; values are in the SI unit of that.
    pub ty: Type,
    /// Place of its instrument among those of the task; an ideal one unless there is one.
    pub sensor: Option<usize>,
    /// Standard deviation of one value; `None` counts as 1.
    pub sigma: Option<f64>,
    /// One value for each time; NaN where nothing was measured.
    pub values: Vec<f64>,
}

impl MeasuredColumn {
    /// The standard deviation that residuals are divided by.
    pub(crate) fn weight(&self) -> f64 {
        self.sigma.unwrap_or(1.0)
    }

    /// From where its instrument counts.
    pub(crate) fn zero(&self) -> f64 {
        if self.ty.absolute { ZERO_CELSIUS } else { 0.0 }
    }

    /// The nodes whose temperatures make it up, with their factors; none where it is an expression
    /// of other results.
    pub fn nodes(&self) -> &[(NodeId, f64)] {
        match &self.of {
            Measurand::Temperatures(nodes) => nodes,
            Measurand::Result(_) => &[],
        }
    }
}

impl NetworkFitTask {
    /// The type whose unit all columns have in common, of differences of what they measure; `None`
    /// where there is none.
    pub fn unit(&self) -> Option<Type> {
        let mut all = self.runs.iter().flat_map(|run| &run.columns).map(|column| column.ty);
        let first = all.next()?.dimension;
        all.all(|ty| ty.dimension == first).then_some(Type::of(first))
    }

    /// The largest of what an instrument read, whatever its sign: over 0 degC of a temperature.
    pub(crate) fn largest_of(&self, sensor: usize) -> f64 {
        let columns = self.runs.iter().flat_map(|run| &run.columns);
        let own = columns.filter(|column| column.sensor == Some(sensor));
        let sizes = own.flat_map(|column| column.values.iter().map(|v| (v - column.zero()).abs()));
        sizes.fold(0.0, f64::max)
    }
}

impl MeasuredRun {
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

    /// The type of what an instrument read in it, if it did.
    pub(crate) fn reads(&self, sensor: usize) -> Option<Type> {
        let columns = self.columns.iter().map(|column| (column.sensor, column.ty));
        let signals = self.signals.iter().map(|signal| (signal.sensor, signal.ty));
        columns.chain(signals).find(|(own, _)| *own == Some(sensor)).map(|(_, ty)| ty)
    }

    /// What has to be kept of its run.
    pub(crate) fn kept(&self) -> RecordedNodes {
        let follows = |column: &MeasuredColumn| matches!(column.of, Measurand::Result(_));
        match self.columns.iter().any(follows) {
            true => RecordedNodes::All,
            false => RecordedNodes::Nodes(self.nodes()),
        }
    }
}
