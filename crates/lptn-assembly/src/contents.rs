//! Heat contents of nodes whose mass changes, for the energy balance.

use lptn_network::{InputError, InputProblem, NodeId};

use crate::scaled::Scaled;
use crate::system::ThermalSystem;
use crate::workspace::Workspace;

impl ThermalSystem {
    /// Capacities in J/K, at the temperatures `y` of the states in K, of each of
    /// [`Network::state_capacities`](lptn_network::Network::state_capacities); NaN for one without a
    /// value.
    pub fn capacities_of_states(&self, work: &mut Workspace, y: &[f64]) -> Vec<f64> {
        self.put(work, y);
        let one = |scaled: &Scaled| {
            let Workspace { scope, temperature, .. } = &mut *work;
            match self.network().capacity_at(&scaled.of, scope, temperature) {
                Ok(capacity) => capacity,
                Err(InputError { problem: InputProblem::NoCapacity(capacity), .. }) => capacity,
                Err(_) => f64::NAN,
            }
        };
        self.scaled.iter().map(one).collect()
    }

    /// Heat content in J over the temperature of the start, at the temperatures `y` of the states in
    /// K, of each of [`Network::state_capacities`](lptn_network::Network::state_capacities).
    ///
    /// # Errors
    /// [`InputError`] if a capacity has no value.
    pub fn contents(&self, work: &mut Workspace, y: &[f64]) -> Result<Vec<f64>, InputError> {
        self.put(work, y);
        let one = |scaled: &Scaled| {
            let Workspace { scope, temperature, .. } = &mut *work;
            let capacity = self.network().capacity_at(&scaled.of, scope, temperature)?;
            Ok(capacity * self.rise(scaled.of.node, y[scaled.unknown]))
        };
        self.scaled.iter().map(one).collect()
    }

    /// Writes the heat in W, over the temperature of the start, that comes with its mass into each of
    /// [`Network::state_capacities`](lptn_network::Network::state_capacities): the change of its
    /// capacity times its rise. From the sources last evaluated.
    ///
    /// # Errors
    /// As [`ThermalSystem::contents`].
    pub fn mass_heat(
        &self,
        work: &mut Workspace,
        y: &[f64],
        heat: &mut [f64],
    ) -> Result<(), InputError> {
        let mut slopes = Vec::new();
        for (heat, scaled) in heat.iter_mut().zip(self.scaled.iter()) {
            let Workspace { scope, temperature, power, .. } = &mut *work;
            let network = self.network();
            network.capacity_slopes(&scaled.of, scope, temperature, &mut slopes)?;
            let changes = scaled.of.states.iter().zip(&slopes).map(|(state, slope)| {
                let source = network.state_at(*state).and_then(|state| state.source);
                source.map_or(0.0, |id| slope * power[id.index()])
            });
            *heat = changes.sum::<f64>() * self.rise(scaled.of.node, y[scaled.unknown]);
        }
        Ok(())
    }

    /// The rise of a node over its start, in K.
    fn rise(&self, node: NodeId, temperature: f64) -> f64 {
        temperature - self.network().initial(node)
    }
}
