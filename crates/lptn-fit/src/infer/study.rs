//! From an `[infer.NAME]` of a netlist to a task.

use lptn_netlist::{InferStart, InferStudy, Netlist, SoughtSignal};
use lptn_network::{Network, ParameterId};

use crate::infer::error::InferError;
use crate::infer::task::{InferTask, Sought, Start};
use crate::network::NetworkFitTask;

impl<'a> InferTask<'a> {
    /// The task of a study. Every parameter with a `±` is uncertain.
    ///
    /// # Errors
    /// [`InferError`] for a column that does not measure a temperature of a node or a mean of some,
    /// and what the evaluation of the study's numbers reports.
    pub fn of(netlist: &'a Netlist, study: &InferStudy) -> Result<Self, InferError> {
        let network = &netlist.network;
        let mut read = NetworkFitTask::of(netlist, &study.reads, 1)?;
        let changes = study.changes(network)?;
        let sought = |(sought, change): (&SoughtSignal, Option<f64>)| {
            let place = network.signals().iter().position(|own| own.name == sought.name)?;
            Some(Sought {
                signal: network.signal_ids().nth(place)?,
                name: sought.name.clone(),
                positive: sought.positive,
                intensity: change.map(|change| change * change),
            })
        };
        let sought = study.sought.iter().zip(changes).filter_map(sought).collect();
        let start = match study.start {
            InferStart::Network => Start::Known,
            InferStart::Record => Start::Measured,
            InferStart::Free => Start::Free,
        };
        let run = read.runs.swap_remove(0);
        Ok(Self {
            network,
            run,
            sensors: read.sensors,
            sought,
            uncertain: uncertain(network),
            start,
        })
    }
}

/// The parameters with a `±`.
fn uncertain(network: &Network) -> Vec<(ParameterId, f64)> {
    let all = network.parameter_ids().filter_map(|id| {
        let deviation = network.parameters()[id.index()].deviation?;
        (deviation > 0.0).then_some((id, deviation))
    });
    all.collect()
}
