//! Derivatives of results by parameters: of a steady state by its adjoint, of a run along its
//! sensitivities.
//!
//! A result depends on a parameter through the temperatures, whose derivatives are exact, and
//! directly. Both are read from the result itself. The result is that of a limit, its margin, so
//! that everything which a limit compares has a derivative.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{InputError, LimitId, ParameterId};

use crate::adjoint::{Adjoint, AdjointError, ParameterSlopes};
use crate::margin::{BentMargin, Margin, Point};
use crate::sensitive_run::{SensitiveRun, step};
use crate::steady::SteadyState;
use crate::stencil::slope;
use crate::times::just_after;

lptn_units::errors! {
/// Reason why a result has no derivative.
#[derive(Debug)]
pub enum SlopesError {
    /// The temperatures have none.
    Adjoint => AdjointError;
    /// The heats have none by a parameter.
    Parameters => ParameterSlopes;
    /// The result has none at fixed temperatures.
    Margin => BentMargin;
}
}

/// The margin of a limit and its derivatives by parameters, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginSlopes {
    /// The margin.
    pub margin: f64,
    /// Its derivative by each parameter.
    pub by: Vec<f64>,
}

impl From<InputError> for SlopesError {
    fn from(error: InputError) -> Self {
        BentMargin::from(error).into()
    }
}

impl From<ChangeError> for SlopesError {
    fn from(error: ChangeError) -> Self {
        BentMargin::from(error).into()
    }
}

impl SteadyState {
    /// The margin of a limit in this state of a system, and its derivatives by parameters: one more
    /// solution, however many parameters there are.
    ///
    /// # Errors
    /// [`SlopesError`]
    pub fn margin_slopes(
        &self,
        system: &ThermalSystem,
        limit: LimitId,
        parameters: &[ParameterId],
    ) -> Result<MarginSlopes, SlopesError> {
        let reads = Margin { system, limit };
        let positions = system.network().has_events().then(|| self.positions.clone());
        let (at, nodes) = ((self.time, just_after(self.time)), self.temperatures.clone());
        let point = Point { at, positions, nodes, weight: 1.0 };
        let margin = reads.at(&point)?;
        let weights = reads.by_nodes(&point, (&reads.nodes(), 0.0))?;
        let adjoint = Adjoint::of_sum(system, self, &weights)?;
        let mut by = adjoint.by_parameters(parameters)?;
        if reads.nodes_alone().is_none() {
            for (by, &parameter) in by.iter_mut().zip(parameters) {
                *by += reads.directly(std::slice::from_ref(&point), parameter)?;
            }
        }
        Ok(MarginSlopes { margin, by })
    }
}

impl SensitiveRun {
    /// The derivative of the margin of a limit in a row by a parameter along exact sensitivities, in
    /// SI units; every node has to be recorded.
    ///
    /// # Errors
    /// [`SlopesError`]
    pub fn margin_derivative(
        &self,
        parameter: ParameterId,
        (limit, row): (LimitId, usize),
    ) -> Result<f64, SlopesError> {
        let network = self.solution.network();
        let own = network.parameter_value(parameter);
        let at = |change: f64| -> Result<f64, SlopesError> {
            Ok(self.solution.margin_beside((limit, row), (parameter, own + change))??)
        };
        let found = slope(step(network, parameter), at)?;
        let name = || network.limits()[limit.index()].text.clone();
        let by = || network.parameters()[parameter.index()].name.clone();
        found.ok_or_else(|| BentMargin::Bends { name: name(), by: by() }.into())
    }
}
