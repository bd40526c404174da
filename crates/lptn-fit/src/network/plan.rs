//! Tasks from a `[fit.NAME]` of a netlist.

use lptn_analysis::RunAnalysis;
use lptn_netlist::{FitInitial, FitRecord, FitStudy, Netlist, Observed, Sensor};
use lptn_network::{End, Network, NodeId, Time};

use crate::network::error::NetworkFitError;
use crate::network::recorded::{RecordedSignal, RecordedStart};
use crate::network::task::{Instrument, Measurand, MeasuredColumn, MeasuredRun, NetworkFitTask};

/// Default number of searches that begin between the bounds.
const MORE_STARTS: usize = 4;

/// Temperature of the nodes while an expression is evaluated, in K. Powers of 2 keep sums exact.
const BASE: f64 = 256.0;

/// Rise of one of them in K.
const RAISED: f64 = 64.0;

impl NetworkFitTask {
    /// The task of a study: each record is a run of the network, and the times of its rows are
    /// times of that run. It begins at `[run] start` (0 s without one), or at the first row if
    /// nodes begin at their readings: nothing is known of them before it.
    ///
    /// # Errors
    /// [`NetworkFitError`] for a column that measures no quantity of a run, for columns whose units
    /// cannot be compared, and for numbers of the study that cannot be evaluated.
    pub fn of(
        netlist: &Netlist,
        study: &FitStudy,
        threads: usize,
    ) -> Result<Self, NetworkFitError> {
        let network = &netlist.network;
        let plan = study.plan(network, &netlist.overrides())?;
        let settings = settings(netlist);
        let of: Vec<Measurand> =
            study.observed.iter().map(|o| measurand(network, o)).collect::<Result<_, _>>()?;
        let sensors = &netlist.studies.sensors;
        let sensor_of = |observed: &Observed| {
            sensors.iter().position(|sensor| observed.sensor.as_ref() == Some(&sensor.name))
        };
        // rounding to steps of q adds a variance of q^2 / 12
        let step = |observed: &Observed| sensor_of(observed).and_then(|s| sensors[s].resolution);
        let sigma = |(observed, sigma): (&Observed, &Option<f64>)| {
            Some(sigma.as_ref()?.hypot(step(observed).unwrap_or(0.0) / 12_f64.sqrt()))
        };
        let sigmas: Vec<Option<f64>> = study.observed.iter().zip(&plan.sigmas).map(sigma).collect();
        comparable(study, &sigmas)?;
        let mut runs = Vec::with_capacity(study.records.len());
        for (record, parameters) in study.records.iter().zip(plan.parameters) {
            let column = |(i, observed): (usize, &Observed)| {
                let values = record.record.column(&observed.column);
                let values = values.map_or_else(Vec::new, |c| c.values.clone());
                MeasuredColumn {
                    name: observed.column.clone(),
                    of: of[i].clone(),
                    ty: observed.ty,
                    sensor: sensor_of(observed),
                    sigma: sigmas[i],
                    values,
                }
            };
            let settings = begin(settings.clone(), study, record);
            let begun = Begun { study, record, sensors, start: settings.start() };
            runs.push(MeasuredRun {
                signals: begun.signals(network)?,
                initial: begun.initial(&of)?,
                name: record.csv.clone(),
                parameters,
                settings,
                times: record.record.time.clone(),
                columns: study.observed.iter().enumerate().map(column).collect(),
            });
        }
        let sensors = sensors.iter().map(Instrument::from).collect();
        let (parameters, correlations, more_starts) = (plan.varied, plan.correlations, MORE_STARTS);
        Ok(Self {
            network: network.clone(),
            parameters,
            correlations,
            sensors,
            runs,
            more_starts,
            threads,
        })
    }
}

/// Start and controls of the runs of a netlist.
pub(crate) fn settings(netlist: &Netlist) -> RunAnalysis {
    let run = netlist.run.as_ref();
    let of = |run| RunAnalysis::of(&netlist.network, run);
    run.map_or_else(|| RunAnalysis::until(Time(1.0)), of).bare()
}

/// The run of a record. If nodes begin at their readings, it begins at the first row or later: a
/// reading is the temperature at the time of its row.
fn begin(settings: RunAnalysis, study: &FitStudy, record: &FitRecord) -> RunAnalysis {
    let (start, stop) = (settings.start(), settings.stop());
    match (study.initial, record.record.time.first()) {
        (FitInitial::First | FitInitial::Mean(_), Some(&first)) if first > start => {
            settings.lasting(first, stop.max(first))
        }
        _ => settings,
    }
}

/// One record, with its study and the instruments.
struct Begun<'a> {
    study: &'a FitStudy,
    record: &'a FitRecord,
    sensors: &'a [Sensor],
    /// Start of its run in s.
    start: f64,
}

impl Begun<'_> {
    /// The signals that follow its columns: straight lines between its rows, over gaps too, and the
    /// first value before them.
    fn signals(&self, network: &Network) -> Result<Vec<RecordedSignal>, NetworkFitError> {
        let (all, times) = (network.signals(), &self.record.record.time);
        let mut found = Vec::new();
        for own in &self.study.signals {
            let place = all.iter().position(|signal| signal.name == own.name);
            let id = place.and_then(|place| network.signal_ids().nth(place));
            let column = self.record.record.column(&own.column);
            let (Some(signal), Some(column)) = (id, column) else { continue };
            let rows = times.iter().zip(&column.values).filter(|(_, value)| !value.is_nan());
            let (mut times, mut values): (Vec<f64>, Vec<f64>) = rows.unzip();
            let (record, column) = (self.record.csv.clone(), own.column.clone());
            if times.len() < 2 {
                return Err(NetworkFitError::Signal { record, column });
            }
            let sensor = self.sensor(own.sensor.as_ref().or_else(|| self.sensor_of(&own.column)));
            if let Some(slow) = sensor.map(|sensor| &self.sensors[sensor])
                && (slow.lag.value > 0.0 || slow.lag.is_estimated())
            {
                let sensor = slow.name.clone();
                return Err(NetworkFitError::SignalLag { column, sensor });
            }
            if times[0] > self.start {
                times.insert(0, self.start);
                values.insert(0, values[0]);
            }
            found.push(RecordedSignal { signal, ty: own.ty, times, values, sensor });
        }
        Ok(found)
    }

    /// A column that is compared has one instrument, whatever else follows it.
    fn sensor_of(&self, column: &str) -> Option<&String> {
        self.study.observed.iter().find(|observed| observed.column == column)?.sensor.as_ref()
    }

    fn sensor(&self, name: Option<&String>) -> Option<usize> {
        self.sensors.iter().position(|sensor| Some(&sensor.name) == name)
    }

    /// Start of the nodes whose temperature a column measures.
    fn initial(&self, of: &[Measurand]) -> Result<Vec<RecordedStart>, NetworkFitError> {
        let long = match self.study.initial {
            FitInitial::Network => return Ok(Vec::new()),
            FitInitial::First => 0.0,
            FitInitial::Mean(seconds) => self.short(seconds)?,
        };
        let mut found: Vec<RecordedStart> = Vec::new();
        for (observed, of) in self.study.observed.iter().zip(of) {
            let Measurand::Temperatures(of) = of else { continue };
            let ([(node, factor)], true) = (of.as_slice(), observed.ty.absolute) else { continue };
            let column = self.record.record.column(&observed.column);
            let (Some(column), true) = (column, (factor - 1.0).abs() < 1e-12) else { continue };
            let rows = self.record.record.time.iter().zip(&column.values);
            let mut rows = rows.filter(|(_, value)| !value.is_nan()).peekable();
            let Some(first) = rows.peek().map(|(time, _)| **time) else { continue };
            let values: Vec<f64> =
                rows.take_while(|(time, _)| **time <= first + long).map(|(_, v)| *v).collect();
            let reading = values.iter().sum::<f64>() / values.len() as f64;
            if found.iter().all(|other| other.node != *node) {
                let sensor = self.sensor(observed.sensor.as_ref());
                found.push(RecordedStart { node: *node, reading, read_at: first, sensor });
            }
        }
        Ok(found)
    }

    /// The time in s over which a mean is taken, if it is at most half of the record: the fit is
    /// checked against the rest.
    fn short(&self, mean: f64) -> Result<f64, NetworkFitError> {
        let times = &self.record.record.time;
        let ends = times.first().zip(times.last());
        let length = ends.map_or(0.0, |(first, last)| last - first);
        let record = self.record.csv.clone();
        match mean > 0.5 * length {
            true => Err(NetworkFitError::InitialLong { record, mean, length }),
            false => Ok(mean),
        }
    }
}

/// Quantity that a column measures: a sum of temperatures if possible, which costs least.
fn measurand(network: &Network, observed: &Observed) -> Result<Measurand, NetworkFitError> {
    match weights(network, observed) {
        Ok(nodes) => Ok(Measurand::Temperatures(nodes)),
        Err(_) if network.reads_results(&observed.value) => {
            Ok(Measurand::Result(observed.value.clone()))
        }
        Err(_) => Err(NetworkFitError::Observed {
            column: observed.column.clone(),
            result: observed.text.clone(),
        }),
    }
}

/// Values in different units are compared by their standard deviations, so each needs one.
fn comparable(study: &FitStudy, sigmas: &[Option<f64>]) -> Result<(), NetworkFitError> {
    let first = &study.observed[0];
    let other = study.observed.iter().find(|o| o.ty.dimension != first.ty.dimension);
    let unknown = study.observed.iter().zip(sigmas).find(|(_, sigma)| sigma.is_none());
    match (other, unknown) {
        (Some(other), Some((column, _))) => Err(NetworkFitError::Units {
            column: column.column.clone(),
            units: [first, other].map(|observed| observed.ty.dimension.si_unit()),
        }),
        _ => Ok(()),
    }
}

/// The nodes whose temperatures make up a result, with their factors.
///
/// # Errors
/// [`NetworkFitError::NotLinear`] if it is not such a sum.
pub(crate) fn weights(
    network: &Network,
    observed: &Observed,
) -> Result<Vec<(NodeId, f64)>, NetworkFitError> {
    if let Some(End::Node(node)) = observed.end {
        return Ok(vec![(node, 1.0)]);
    }
    linear(network, observed).ok_or_else(|| NetworkFitError::NotLinear {
        column: observed.column.clone(),
        result: observed.text.clone(),
    })
}

/// The factors of a result that is a weighted sum of temperatures of nodes. Its inputs are known
/// from its code: a parameter that is 0 now may be another number later. The factors are found by
/// raising the temperatures one after the other. If the result differs when all are raised by
/// different amounts, it is not such a sum.
fn linear(network: &Network, observed: &Observed) -> Option<Vec<(NodeId, f64)>> {
    if !network.reads_node_temperatures_only(&observed.value) {
        return None;
    }
    let mut scope = network.evaluation();
    let count = network.nodes().len();
    let boundaries = |t: f64| vec![t; network.boundaries().len()];
    let heats = vec![f64::NAN; network.named_heats().len()];
    let mut at = |nodes: &[f64], boundary: f64| {
        scope.set_temperatures(nodes, &boundaries(boundary));
        scope.set_heats(&heats);
        observed.value.at(&mut scope).ok().filter(|value| value.is_finite())
    };
    let mut nodes = vec![BASE; count];
    let base = at(&nodes, BASE)?;
    let mut weights = Vec::new();
    for id in network.node_ids() {
        nodes[id.index()] = BASE + RAISED;
        let weight = (at(&nodes, BASE)? - base) / RAISED;
        nodes[id.index()] = BASE;
        if weight.abs() > 0.0 {
            weights.push((id, weight));
        }
    }
    let uneven: Vec<f64> =
        (0..count).map(|i| BASE + RAISED * (1.0 + (i % 7) as f64 - (i % 3) as f64)).collect();
    let terms = || weights.iter().map(|(id, weight)| weight * uneven[id.index()]);
    let (sum, size): (f64, f64) = (terms().sum(), terms().map(f64::abs).sum());
    let is_sum = |value: f64| (value - sum).abs() <= 1e-12 * size;
    (!weights.is_empty() && is_sum(at(&uneven, BASE)?) && is_sum(at(&uneven, 2.0 * BASE)?))
        .then_some(weights)
}
