//! What evaluating a system needs besides the system: one per thread, so that evaluating allocates
//! nothing.

use lptn_network::{Evaluation, InputError, Network, Positions};

use crate::slopes::Slopes;

/// Inputs at one time, and the temperatures of all vertices.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(crate) scope: Evaluation,
    /// Heat of every source in W.
    pub(crate) power: Vec<f64>,
    /// Heat put into every vertex in W, that of massless nodes handed on.
    pub(crate) heat: Vec<f64>,
    /// Heat that elements other than constant conductances bring to every vertex in W.
    pub(crate) element_heat: Vec<f64>,
    /// Temperature of every vertex in K: nodes, then boundaries.
    pub(crate) temperature: Vec<f64>,
    pub(crate) slopes: Slopes,
    /// Which controls are on and which comparisons hold.
    positions: Positions,
    /// Whether the inputs have to be evaluated again when the time changes.
    varies: bool,
    /// The time and segment that the inputs were read for.
    read_at: Option<(f64, f64)>,
}

impl Workspace {
    pub(crate) fn new(network: &Network) -> Self {
        let vertices = network.nodes().len() + network.boundaries().len();
        Self {
            scope: network.evaluation(),
            power: vec![0.0; network.sources().len()],
            heat: vec![0.0; vertices],
            element_heat: vec![0.0; vertices],
            temperature: vec![f64::NAN; vertices],
            slopes: Slopes::default(),
            positions: network.initial_positions(),
            varies: network.has_time_dependent_inputs(),
            read_at: None,
        }
    }

    /// Reads sources and boundaries at `time` [s] unless that was done; says whether they are new.
    pub(crate) fn read(
        &mut self,
        network: &Network,
        time: f64,
        segment: f64,
    ) -> Result<bool, InputError> {
        let now = (time.to_bits(), segment.to_bits());
        let known =
            self.read_at.is_some_and(|(t, s)| !self.varies || (t.to_bits(), s.to_bits()) == now);
        if known {
            return Ok(false);
        }
        self.read_at = None; // an error leaves nothing half read
        self.scope.set_time(time, segment);
        network.source_powers(&mut self.scope, &mut self.power)?;
        network.boundary_temperatures(
            &mut self.scope,
            &mut self.temperature[network.nodes().len()..],
        )?;
        self.read_at = Some((time, segment));
        Ok(true)
    }

    /// Sets which controls are on and which comparisons hold, as the network begins with
    /// [`Network::initial_positions`]; inputs have to be read again.
    pub fn set_positions(&mut self, positions: &Positions) {
        self.scope.set_positions(positions);
        self.positions.clone_from(positions);
        self.forget();
    }

    /// Which controls are on and which comparisons hold.
    pub fn positions(&self) -> &Positions {
        &self.positions
    }

    /// What was read holds no longer.
    pub(crate) fn forget(&mut self) {
        self.read_at = None;
    }
}
