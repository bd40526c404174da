//! Distances of controls and switches from their thresholds.

#[cfg(doc)]
use lptn_network::Network;
use lptn_network::{ControlId, InputError, SwitchId};

use crate::system::ThermalSystem;
use crate::workspace::Workspace;

impl ThermalSystem {
    /// Excess of a control over the threshold at which it leaves its state, in K, from the inputs
    /// and temperatures last read and recovered; see [`Network::control_excess`].
    ///
    /// # Errors
    /// [`InputError`] if a threshold cannot be evaluated.
    pub fn control_excess(&self, work: &mut Workspace, id: ControlId) -> Result<f64, InputError> {
        let (scope, temperature) = work.current();
        self.network().control_excess(id, scope, temperature)
    }

    /// The difference of the two sides of a switch and its slope, from the inputs and temperatures
    /// last read and recovered; see [`Network::switch_difference`].
    ///
    /// # Errors
    /// [`InputError`] if a side cannot be evaluated.
    pub fn switch_difference(
        &self,
        work: &mut Workspace,
        id: SwitchId,
    ) -> Result<(f64, f64), InputError> {
        let (scope, temperature) = work.current();
        self.network().switch_difference(id, scope, temperature)
    }
}
