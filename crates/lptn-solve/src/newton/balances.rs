//! Balances of the free unknowns and their slopes.

use lptn_assembly::{JacobianForm, Workspace};
use lptn_network::InputError;

use super::Newton;
use crate::newton_error::NewtonError;

impl Newton<'_> {
    /// Takes `-J` into the values.
    pub(crate) fn linearize(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<(), NewtonError> {
        (self.ready, self.leans) = (false, false);
        let (system, whole) = (self.system, &mut self.whole);
        whole.resize(system.pattern().entries(), 0.0);
        let jacobian = match &self.part {
            Some(part) => system.jacobian_of(part, work, temperatures, whole),
            None => system.jacobian_at(work, temperatures, JacobianForm::Exact, whole),
        };
        jacobian.map_err(NewtonError::Input)?;
        self.take_slopes();
        Ok(())
    }

    /// Takes `-J` as it was evaluated last into the values.
    pub(crate) fn take_slopes(&mut self) {
        for (value, &slot) in self.values.iter_mut().zip(&self.slots) {
            *value = -self.whole[slot];
        }
    }

    /// The heat that is left over at the free unknowns, in W.
    pub(crate) fn residual(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<Vec<f64>, NewtonError> {
        self.evaluate(work, temperatures).map_err(NewtonError::Input)?;
        Ok(self.free.iter().map(|&i| self.flow[i]).collect())
    }

    /// Evaluates the heat flow into the free unknowns.
    pub(super) fn evaluate(
        &mut self,
        work: &mut Workspace,
        temperatures: &[f64],
    ) -> Result<(), InputError> {
        match &self.part {
            Some(part) => self.system.flow_of(part, work, temperatures, &mut self.flow),
            None => self.system.flow(work, temperatures, &mut self.flow),
        }
    }

    /// The largest heat that was left over when the flow was last evaluated, in W.
    pub(super) fn left_over(&self) -> f64 {
        self.free.iter().map(|&i| self.flow[i].abs()).fold(0.0, f64::max)
    }

    /// Solves the states with a balance first, at the temperatures of the start: without pressures
    /// there are no flows, and without flows nothing determines a temperature. If that fails, the
    /// search begins where it would have begun.
    pub(super) fn balance_states(&self, work: &mut Workspace, temperatures: &mut [f64]) {
        let network = self.system.network();
        let balanced = |unknown: &usize| {
            network.state_at(self.system.unknowns()[*unknown]).is_some_and(|state| state.balanced)
        };
        let first: Vec<usize> = self.free.iter().copied().filter(balanced).collect();
        if first.is_empty() || first.len() == self.free.len() {
            return;
        }
        let before = temperatures.to_vec();
        let solved =
            Self::new(self.system, first).and_then(|mut newton| newton.solve(work, temperatures));
        if solved.is_err() {
            temperatures.copy_from_slice(&before);
        }
    }
}
