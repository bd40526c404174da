//! The rows of sensitivities, written next to those of temperatures.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{NodeId, ParameterId};

use crate::error::TransientError;
use crate::newton_error::NewtonError;
use crate::sensitivity_rows::SensitivityRows;
use crate::tangent::Tangent;
use crate::unfold::Unfold;

/// Sensitivities that are being recorded.
pub(crate) struct Sensed<'a> {
    tangent: Tangent<'a>,
    /// The integrator's sensitivities at one time.
    carried: Vec<f64>,
    /// Those of all vertices by one parameter.
    vertices: Vec<f64>,
    rows: SensitivityRows,
}

impl<'a> Sensed<'a> {
    /// Ready to record; `None` if no parameters are asked for.
    pub(crate) fn of(
        system: &'a ThermalSystem,
        parameters: &[ParameterId],
    ) -> Result<Option<Self>, TransientError> {
        if parameters.is_empty() {
            return Ok(None);
        }
        let tangent = Tangent::new(system, parameters)?;
        let carried = vec![0.0; system.states().len() * parameters.len()];
        let rows = SensitivityRows { parameters: parameters.to_vec(), values: Vec::new() };
        Ok(Some(Self { tangent, carried, vertices: Vec::new(), rows }))
    }

    /// Takes the integrator's sensitivities.
    pub(crate) fn carry(&mut self, carried: &[f64]) {
        self.carried.copy_from_slice(carried);
    }

    /// The slice to which the integrator writes them.
    pub(crate) fn carried(&mut self) -> &mut [f64] {
        &mut self.carried
    }

    /// Writes a row, from inputs read and nodes recovered.
    pub(crate) fn push(
        &mut self,
        work: &mut Workspace,
        unfold: &Unfold<'_>,
        recorded: &[NodeId],
    ) -> Result<(), NewtonError> {
        self.tangent.recover(work, unfold, &self.carried)?;
        for k in 0..self.rows.parameters.len() {
            self.tangent.vertices_of(k, &mut self.vertices);
            self.rows.values.extend(recorded.iter().map(|id| self.vertices[id.index()]));
        }
        Ok(())
    }

    pub(crate) fn into_rows(self) -> SensitivityRows {
        self.rows
    }
}
