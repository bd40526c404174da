//! The end state of a run, from which another one can start.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::NodeId;

/// The state of a network at the end that a run reached.
#[derive(Clone, Debug, PartialEq)]
pub struct LastState {
    /// The time in s: the stop, or the last time up to which the run is complete.
    pub time: f64,
    /// Temperature of every node in K.
    pub temperatures: Vec<f64>,
    /// The nodes at their single melting temperature, with their molten share, from 0 to 1, which
    /// the temperature does not determine. Ascending.
    pub melted: Vec<(NodeId, f64)>,
}

impl LastState {
    /// The state from the integrator's variables, and the workspace at that state.
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
