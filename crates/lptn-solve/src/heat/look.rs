//! Evaluations of states other than those of the integrator. They change nothing of a run.

use lptn_assembly::JacobianForm;
use lptn_integrate::{OdeSystem, Retry};
use lptn_network::{Evaluation, InputError};

use super::Heat;

impl Heat<'_> {
    /// Temperatures of all vertices in K, nodes then boundaries, at a state within a step; `None`
    /// if they cannot be computed.
    pub(crate) fn look(&mut self, time: f64, y: &[f64]) -> Option<&[f64]> {
        let kept = (self.failure.take(), self.refused.take(), self.fold);
        let stood = self.unfold.is_guarded().then(|| self.unfold.algebraic().to_vec());
        let seen = self.recover(time, y).is_ok();
        (self.failure, self.refused, self.fold) = kept;
        if let Some(stood) = stood {
            self.unfold.seed(&stood);
        }
        seen.then(|| self.system.vertex_temperatures(&self.work))
    }

    /// A number for the pieces of an element at the state that was evaluated last; 0 if it has no
    /// heat.
    pub(crate) fn pieces(&mut self, element: usize) -> u64 {
        self.system.pieces(&mut self.work, element).unwrap_or(0)
    }

    /// Adds the heat of some elements to that of every vertex in W, at a time in s and temperatures
    /// of all vertices in K; `None` if one has no heat.
    pub(crate) fn heat_of(
        &mut self,
        mut elements: impl Iterator<Item = usize>,
        (time, temperatures): (f64, &[f64]),
        heat: &mut [f64],
    ) -> Option<()> {
        let (at, segment) = self.held.unwrap_or((time, self.segment));
        self.system.read_inputs(&mut self.work, at, segment).ok()?;
        self.system.place_vertices(&mut self.work, temperatures);
        elements.try_for_each(|i| self.system.add_heat_of(&mut self.work, i, heat)).ok()
    }

    /// The Jacobian at the temperatures of the last evaluation.
    pub(crate) fn jacobian_here(
        &mut self,
        form: JacobianForm,
        values: &mut [f64],
    ) -> Result<(), InputError> {
        self.system.jacobian_at(&mut self.work, self.unfold.last(), form, values)
    }

    /// Inputs of expressions other than temperatures.
    pub(crate) fn scope(&mut self) -> &Evaluation {
        self.system.scope(&mut self.work)
    }

    /// Rates of the temperatures of all vertices at a state in K/s; 0 if they are not known.
    pub(crate) fn rates(&mut self, time: f64, y: &[f64], rates: &mut [f64]) {
        let mut flow = vec![0.0; y.len()];
        let kept = (self.failure.take(), self.refused.take(), self.fold);
        let known: Result<(), Retry> = OdeSystem::flow(self, time, y, &mut flow);
        (self.failure, self.refused, self.fold) = kept;
        if known.is_err() {
            return;
        }
        let (slopes, capacity) = (self.unfold.slopes(), self.system.capacity());
        for (i, id) in self.system.states().iter().enumerate() {
            rates[id.index()] = slopes[i] * flow[i] / capacity[i];
        }
    }
}

#[cfg(test)]
mod tests;
