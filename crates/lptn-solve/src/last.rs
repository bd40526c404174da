//! Where a run ended: what another one can start from.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::NodeId;

/// The state of a network at the end that a run reached.
#[derive(Clone, Debug, PartialEq)]
pub struct LastState {
    /// The time in s: the stop, or the last time up to which the run is whole.
    pub time: f64,
    /// Temperature of every node in K.
    pub temperatures: Vec<f64>,
    /// The nodes that stand at a temperature at which alone they melt, with how much of them is
    /// molten, from 0 to 1: their temperature does not tell. Ascending.
    pub melted: Vec<(NodeId, f64)>,
}

impl LastState {
    /// The state from what the integrator carries, and the workspace that was brought there.
    pub(crate) fn new(
        system: &ThermalSystem,
        work: &Workspace,
        (time, carried): (f64, &[f64]),
    ) -> Self {
        let network = system.network();
        let mut last = Self {
            time,
            temperatures: system.node_temperatures(work).to_vec(),
            melted: Vec::new(),
        };
        for ((&id, &y), capacity) in system.states().iter().zip(carried).zip(system.capacity()) {
            let Some(curve) = network.enthalpy(id) else {
                last.temperatures[id.index()] = y;
                continue;
            };
            let heat = capacity * (y - network.initial(id));
            if let Some(content) = curve.temperature(heat) {
                last.temperatures[id.index()] = content.temperature;
            }
            last.melted.extend(curve.melted(heat).map(|share| (id, share)));
        }
        last
    }
}
