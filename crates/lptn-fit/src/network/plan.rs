//! From a `[fit.NAME]` of a netlist to a task.

use lptn_netlist::{FitStudy, Netlist, Observed};
use lptn_network::{End, Network, NodeId, Time};
use lptn_solve::Transient;

use crate::network::error::NetworkFitError;
use crate::network::task::{Instrument, MeasuredColumn, MeasuredRun, NetworkFitTask};

/// Searches that begin between the bounds, where the netlist does not say.
const MORE_STARTS: usize = 4;

/// A temperature that nodes are thought to have while an expression is looked at, in K. Powers of 2
/// keep sums exact.
const BASE: f64 = 256.0;

/// By how much one of them is raised.
const RAISED: f64 = 64.0;

impl<'a> NetworkFitTask<'a> {
    /// The task of a study: each record is a run of the network that begins at `[run] start` (0 s
    /// without one), and the times of its rows are times of that run.
    ///
    /// # Errors
    /// [`NetworkFitError`] for a result that is not a temperature of a node or a mean of some, and
    /// what the evaluation of the study's numbers reports.
    pub fn of(
        netlist: &'a Netlist,
        study: &FitStudy,
        threads: usize,
    ) -> Result<Self, NetworkFitError> {
        let network = &netlist.network;
        let plan = study.plan(network, &netlist.overrides())?;
        let settings = netlist
            .run
            .as_ref()
            .map_or_else(|| Transient::until(Time(1.0)), |run| Transient::of(network, run));
        let of: Vec<_> =
            study.observed.iter().map(|o| weights(network, o)).collect::<Result<_, _>>()?;
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
        let mut runs = Vec::with_capacity(study.records.len());
        for (record, parameters) in study.records.iter().zip(plan.parameters) {
            let column = |(i, observed): (usize, &Observed)| {
                let values = record
                    .record
                    .column(&observed.column)
                    .map_or_else(Vec::new, |c| c.values.clone());
                MeasuredColumn {
                    name: observed.column.clone(),
                    of: of[i].clone(),
                    sensor: sensor_of(observed),
                    sigma: sigmas[i],
                    values,
                }
            };
            runs.push(MeasuredRun {
                name: record.csv.clone(),
                parameters,
                settings: settings.clone(),
                times: record.record.time.clone(),
                columns: study.observed.iter().enumerate().map(column).collect(),
            });
        }
        let sensors = sensors.iter().map(Instrument::from).collect();
        let parameters = plan.varied;
        Ok(Self { network, parameters, sensors, runs, more_starts: MORE_STARTS, threads })
    }
}

/// The nodes whose temperatures make up a result, with their factors.
fn weights(network: &Network, observed: &Observed) -> Result<Vec<(NodeId, f64)>, NetworkFitError> {
    if let Some(End::Node(node)) = observed.end {
        return Ok(vec![(node, 1.0)]);
    }
    let refused = || NetworkFitError::Observed {
        column: observed.column.clone(),
        result: observed.text.clone(),
    };
    if !observed.ty.absolute {
        return Err(refused());
    }
    linear(network, observed).ok_or_else(refused)
}

/// The factors of a result that is a weighted sum of temperatures of nodes. What it reads is known
/// from its code: a parameter that is 0 now may be another number later. The factors are found by
/// raising the temperatures one after the other; a result that answers otherwise when all are
/// raised by different amounts is not such a sum.
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
    let sum: f64 = weights.iter().map(|(id, weight)| weight * uneven[id.index()]).sum();
    let is_sum = |value: f64| (value - sum).abs() <= 1e-12 * sum.abs();
    (!weights.is_empty() && is_sum(at(&uneven, BASE)?) && is_sum(at(&uneven, 2.0 * BASE)?))
        .then_some(weights)
}
