//! Candidates: one network with other values of its parameters.

use lptn_network::{BuildErrors, Network, Parameters};

use crate::error::AssemblyError;
use crate::system::ThermalSystem;

lptn_units::errors! {
/// Why there is no system with other values of the parameters.
#[derive(Clone, Debug)]
pub enum ChangeError {
    /// There is no such network.
    Network => BuildErrors;
    /// It cannot be assembled.
    Assembly => AssemblyError;
}
}

impl ThermalSystem {
    /// The system of the same network with other values of its parameters, for loops over
    /// candidates: nothing is read or compiled again, and names and expressions are shared.
    ///
    /// ```
    /// # use lptn_assembly::ThermalSystem;
    /// # fn sweep(system: &ThermalSystem) -> Result<(), Box<dyn std::error::Error>> {
    /// for text in ["2 mK/W", "20 mK/W"] {
    ///     let candidate = system.with(&system.network().overrides().with("R_joint", text)?)?;
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`ChangeError`] if the values make no network, or one that cannot be assembled.
    pub fn with(&self, parameters: &Parameters) -> Result<Self, ChangeError> {
        Self::of(self.network(), parameters)
    }

    /// Assembles a network with other values of its parameters.
    ///
    /// # Errors
    /// As [`ThermalSystem::with`].
    pub fn of(network: &Network, parameters: &Parameters) -> Result<Self, ChangeError> {
        Ok(Self::assemble(&network.with(parameters)?)?)
    }
}
