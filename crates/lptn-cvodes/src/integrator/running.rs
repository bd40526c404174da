//! Running integrals of the state, and the values that are read before a new start.
//!
//! Quadratures take part in the error test. Otherwise CVODES 6.4.1 and 7.1.1 do not save their
//! correction before they raise the order. The energy balance was then off by 4.5e-8, whatever the
//! settings of Newton's method (`tests/books.rs`). The tolerance of a quadrature is a share of the
//! heat that has flowed, or the heat of the temperature tolerance in all capacities together. If
//! tiny capacities follow a ramp, the heat asks for small steps and the state does not.

use super::Cvodes;
use crate::memory::Flag;
use lptn_integrate::OdeSystem;

impl<S: OdeSystem> Cvodes<S> {
    pub(super) fn read_quadratures(&mut self) -> Result<(), Flag> {
        match &mut self.quadratures {
            // Before the first step after a (re)start CVODES has no step to evaluate them in; they
            // are as they were set.
            Some(quadratures) if self.memory.counters().steps > 0 => {
                self.memory.quadratures(quadratures)
            }
            _ => Ok(()),
        }
    }

    /// Reads the integrals and sensitivities at the present time, from which CVODES can restart.
    pub(super) fn read_running(&mut self) -> Result<(), Flag> {
        self.read_quadratures()?;
        self.read_sensitivities()
    }
}
