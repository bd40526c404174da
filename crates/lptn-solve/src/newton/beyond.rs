//! The reason of a search that left the range of a table: the value that is outside at the answer,
//! not at the temperatures at which the search began.
//!
//! A search may begin at the coldest boundary, where a value fails that is well inside its range in
//! the end. The balances are therefore solved with the end values of all tables, and all values are
//! evaluated there as they are. If none fails, these temperatures are where the search begins again.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::InputError;

use super::Newton;
use crate::inside::lacks;
use crate::newton_error::NewtonError;

impl Newton<'_> {
    /// Solves the balances by way of those with the end values of tables. `failed` is the reason if
    /// that does not succeed either, unless another value fails at the temperatures found.
    pub(super) fn beyond(
        &mut self,
        work: &mut Workspace,
        temperatures: &mut [f64],
        failed: InputError,
    ) -> Result<(), NewtonError> {
        if self.tried || lacks(&failed).is_none() {
            return Err(NewtonError::Input(failed));
        }
        self.tried = true;
        let mut found = temperatures.to_vec();
        if self.with_end_values(work, &mut found).is_none() {
            return Err(NewtonError::Input(failed));
        }
        self.residual(work, &found)?;
        temperatures.copy_from_slice(&found);
        self.damped(work, temperatures)
    }

    /// Solves the balances with the end values of tables; `None` if that fails.
    fn with_end_values(&self, work: &mut Workspace, temperatures: &mut [f64]) -> Option<()> {
        let held = ThermalSystem::assemble(&self.system.network().holding()).ok()?;
        let mut newton = Newton::new(&held, self.free.clone()).ok()?;
        newton.tried = true;
        newton.solve(work, temperatures).ok()
    }
}
