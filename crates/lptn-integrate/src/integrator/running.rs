//! What runs along with the state: its integrals, and what is read of it before a new start.

use super::Integrator;
use crate::memory::Flag;
use crate::vector::Vector;
use crate::{IntegrateError, OdeSystem};

impl<S: OdeSystem> Integrator<S> {
    /// The running integrals from the start to [`time`](Self::time), restarts included; one per
    /// [`OdeSystem::quadrature_count`].
    ///
    /// # Errors
    /// [`IntegrateError::Sundials`] only.
    pub fn quadratures(&mut self) -> Result<&[f64], IntegrateError> {
        self.read_quadratures().map_err(|flag| self.unexpected(flag))?;
        Ok(self.quadratures.as_ref().map_or(&[], Vector::as_slice))
    }

    pub(super) fn read_quadratures(&mut self) -> Result<(), Flag> {
        match &mut self.quadratures {
            // Before the first step after a (re)start CVODES has no step to evaluate them in; they are as they were set.
            Some(quadratures) if self.memory.counters().steps > 0 => self.memory.quadratures(quadratures),
            _ => Ok(()),
        }
    }

    /// Running integrals and sensitivities at the present time, from which CVODES can begin anew.
    pub(super) fn read_running(&mut self) -> Result<(), Flag> {
        self.read_quadratures()?;
        self.read_sensitivities()
    }
}
