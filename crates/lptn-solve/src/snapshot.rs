//! The state of a network at one instant.
//!
//! A steady state contains a snapshot and lends its fields by `Deref`; a solution gives one for any
//! row. Pictures and reports take a snapshot and use nothing of its origin but `settled`.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{End, Evaluation, HeatOf, InputError, Network, Positions, Received};

use crate::balance::Balance;
use crate::quantity::Quantity;
use crate::times::just_after;

/// Temperatures and heat flows at one instant, of a steady state or of a run.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// The time in s; that of its inputs if it is a steady state.
    pub time: f64,
    /// Temperature of each node in K.
    pub temperatures: Vec<f64>,
    /// Temperature of each boundary in K.
    pub boundary_temperatures: Vec<f64>,
    /// Heat that the two ends of each conductor receive in W: equal and opposite but for a stream.
    pub received: Vec<Received>,
    /// Heat of each source in W.
    pub source_heat: Vec<f64>,
    /// Heat that each boundary gives to the network in W.
    pub boundary_heat: Vec<f64>,
    /// Controls that are on and comparisons that are true.
    pub positions: Positions,
    /// True if it is a steady state, in which no node stores anything.
    pub settled: bool,
}

impl Snapshot {
    /// The snapshot of a workspace at `time` in s, when its inputs are read and its nodes recovered
    /// from these unknowns.
    pub(crate) fn of_workspace(
        system: &ThermalSystem,
        work: &mut Workspace,
        unknowns: &[f64],
        (time, settled): (f64, bool),
    ) -> Result<Self, InputError> {
        let network = system.network();
        let mut boundary_heat = vec![0.0; network.boundaries().len()];
        system.boundary_heat(work, unknowns, &mut boundary_heat)?;
        let received: Result<_, InputError> =
            network.conductor_ids().map(|id| system.received(work, id)).collect();
        Ok(Self {
            time,
            temperatures: system.node_temperatures(work).to_vec(),
            boundary_temperatures: system.boundary_temperatures(work).to_vec(),
            received: received?,
            source_heat: heats(system, work),
            boundary_heat,
            positions: work.positions().clone(),
            settled,
        })
    }

    /// The heat balance of a node or boundary.
    pub fn balance(&self, network: &Network, of: End) -> Balance {
        Balance::of_flows(network, of, &self.received, &self.source_heat)
    }

    /// Heat that each node receives by all its paths and sources together in W, and stores: nothing
    /// but rounding in a steady state.
    pub fn stored(&self, network: &Network) -> Vec<f64> {
        let mut stored = vec![0.0; network.nodes().len()];
        for (conductor, received) in network.conductors().iter().zip(&self.received) {
            for (end, heat) in [conductor.from, conductor.to].into_iter().zip(received) {
                if let End::Node(id) = end {
                    stored[id.index()] += heat;
                }
            }
        }
        for (source, heat) in network.sources().iter().zip(&self.source_heat) {
            source.into.iter().for_each(|(id, share)| stored[id.index()] += share * heat);
        }
        stored
    }

    /// The scope in which expressions of results (limits, requirements, reports) find this state.
    pub fn evaluation(&self, network: &Network) -> Evaluation {
        let mut scope = network.evaluation();
        scope.set_positions(&self.positions);
        scope.set_time(self.time, just_after(self.time));
        network.place_temperatures(&mut scope, &self.temperatures, &self.boundary_temperatures);
        let heats: Vec<f64> =
            network.named_heats().map(|heat| self.heat(network, heat, &mut scope)).collect();
        scope.set_heats(&heats);
        scope
    }

    fn heat(&self, network: &Network, heat: HeatOf, scope: &mut Evaluation) -> f64 {
        match heat {
            HeatOf::Conductor(id) | HeatOf::ReceivedTo(id) => self.received[id.index()][1],
            HeatOf::ReceivedFrom(id) => self.received[id.index()][0],
            HeatOf::Told(item, key) => network.told(item, key, scope).unwrap_or(f64::NAN),
            HeatOf::Source(id) => self.source_heat[id.index()],
            HeatOf::Boundary(id) => self.boundary_heat[id.index()],
            HeatOf::FacePath(id) => {
                let parts = network.face_paths()[id.index()].conductors();
                parts.map(|part| self.received[part.index()][1]).sum()
            }
        }
    }

    /// One quantity in SI units; `scope` is [`Snapshot::evaluation`].
    pub(crate) fn value(
        &self,
        network: &Network,
        quantity: Quantity,
        scope: &mut Evaluation,
    ) -> Result<f64, InputError> {
        match quantity {
            Quantity::Node(id) => Ok(self.temperatures[id.index()]),
            Quantity::Grid(value) => Ok(network.grid_value(value, &self.temperatures)),
            Quantity::BoundaryTemperature(id) => Ok(self.boundary_temperatures[id.index()]),
            Quantity::Heat(HeatOf::Told(item, key)) => network.told(item, key, scope),
            Quantity::Heat(heat) => Ok(self.heat(network, heat, scope)),
            Quantity::State(id) => Ok(network.state_value(id, &self.temperatures)),
            Quantity::Signal(id) => Ok(scope.signal(id)),
            Quantity::Control(id) => Ok(scope.control(id)),
            Quantity::Report(id) => network.report_value(id, scope),
            Quantity::Side(id, side) => network.limit_side((id, side), scope),
        }
    }
}

/// The heat of each source in W; none of one that changes a state.
fn heats(system: &ThermalSystem, work: &Workspace) -> Vec<f64> {
    let mut heats = system.source_powers(work).to_vec();
    system.network().without_states(&mut heats);
    heats
}
