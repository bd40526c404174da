//! From an `[infer.NAME]` of a netlist to a task.

use lptn_assembly::ChangeError;
use lptn_netlist::{EstimatedSignal, InferStart, InferStudy, Netlist};
use lptn_network::ParameterId;
use lptn_units::Dimension;

use crate::infer::error::InferError;
use crate::infer::task::{Drift, Estimated, InferTask, Start, Uncertain};
use crate::network::plan::weights;
use crate::network::{Instrument, NetworkFitError, NetworkFitTask};

impl InferTask {
    /// The task of a study. Every parameter with a `±`, its own or that of a posterior, is
    /// uncertain, with its correlations.
    ///
    /// # Errors
    /// [`InferError`] for a column that is not a temperature of a node, or a mean or difference of
    /// some, and for numbers of the study that cannot be evaluated.
    pub fn of(netlist: &Netlist, study: &InferStudy) -> Result<Self, InferError> {
        let network = &netlist.network;
        let mut read = NetworkFitTask::of(netlist, &study.reads, 1)?;
        let changes = study.changes(network)?;
        let estimated = |(estimated, change): (&EstimatedSignal, Option<f64>)| {
            let place = network.signals().iter().position(|own| own.name == estimated.name)?;
            Some(Estimated {
                signal: network.signal_ids().nth(place)?,
                name: estimated.name.clone(),
                positive: estimated.positive,
                intensity: change.map(|change| change * change),
                jumps: estimated.jumps,
            })
        };
        let estimated = study.estimated.iter().zip(changes).filter_map(estimated).collect();
        let start = match study.start {
            InferStart::Network => Start::Known,
            InferStart::Record => Start::Measured,
            InferStart::Free => Start::Free,
        };
        let drift = study.drift(network)?;
        let drift = drift.map_or(Drift::Open, |(deviation, time)| Drift::Known { deviation, time });
        // a filter follows results that are linear in temperatures of nodes, and no others
        study.reads.observed.iter().try_for_each(|observed| match observed.ty.dimension {
            of if of == Dimension::TEMPERATURE => weights(network, observed).map(|_| ()),
            _ => Err(NetworkFitError::NotLinear {
                column: observed.column.clone(),
                result: observed.text.clone(),
            }),
        })?;
        let run = read.runs.swap_remove(0);
        // a lag that no time of the record resolves is 0: rates by it would be beyond all numbers
        let latest = run.times.iter().fold(0.0, |latest: f64, time| latest.max(time.abs()));
        let prompt = |sensor: &&mut Instrument| sensor.lag.value < f64::EPSILON * latest;
        read.sensors.iter_mut().filter(prompt).for_each(|sensor| sensor.lag.value = 0.0);
        let believed = netlist.overrides();
        let given = network.with(&run.parameters).map_err(ChangeError::from)?;
        let known = |(id, spread)| Uncertain::new(id, given.parameter_value(id), spread);
        let uncertain: Vec<Uncertain> = believed.uncertain().into_iter().map(known).collect();
        let ids: Vec<ParameterId> = uncertain.iter().map(|own| own.parameter).collect();
        let together = believed.correlations_of(&ids);
        Ok(Self {
            network: network.clone(),
            run,
            sensors: read.sensors,
            estimated,
            uncertain,
            together,
            start,
            drift,
        })
    }
}
