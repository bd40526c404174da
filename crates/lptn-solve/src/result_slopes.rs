//! Derivatives of results by parameters: of a steady state by its adjoint, of a run along its
//! sensitivities.
//!
//! A result depends on a parameter through the temperatures, whose derivatives are exact, and
//! directly. Both are read from the result itself, by five values that need no solution: good to
//! about eleven digits. The result is that of a limit, its margin, so that everything which a limit
//! compares has a derivative.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{InputError, Limit, LimitId, Network, NodeId, ParameterId};

use crate::adjoint::{Adjoint, AdjointError, ParameterSlopes};
use crate::replay::Replay;
use crate::sensitive_run::{SensitiveRun, step};
use crate::steady::SteadyState;
use crate::stencil::slope;
use crate::times::just_after;

/// Step of a temperature in K for the derivative of a result by it.
const KELVIN: f64 = 0.01;

lptn_units::errors! {
/// Reason why a result has no derivative.
#[derive(Debug)]
pub enum SlopesError {
    /// The temperatures have none.
    Adjoint => AdjointError;
    /// The heats have none by a parameter.
    Parameters => ParameterSlopes;
    /// The network takes no other value of a parameter.
    Change => ChangeError;
    /// The result has no value.
    Input => InputError;
    /// It is not smooth: to both sides it changes differently.
    Bends { name: String, by: String } = "gradient::bends",
        format!("`{name}` is not smooth here: it has no derivative by `{by}`"),
        help "begin at another value, or use a method without derivatives";
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

/// A steady state, to read the margin of a limit near it.
struct Near<'a> {
    system: &'a ThermalSystem,
    steady: &'a SteadyState,
    limit: LimitId,
}

impl Near<'_> {
    fn network(&self) -> &Network {
        self.system.network()
    }

    fn limit(&self) -> &Limit {
        &self.network().limits()[self.limit.index()]
    }

    fn replay<'b>(&self, system: &'b ThermalSystem) -> Replay<'b> {
        let mut replay = Replay::new(system);
        if system.network().has_events() {
            replay.set_positions(&self.steady.positions);
        }
        replay
    }

    fn at(&self, replay: &mut Replay<'_>, temperatures: &[f64]) -> Result<f64, InputError> {
        replay.go_to((self.steady.time, just_after(self.steady.time)), temperatures);
        replay.margin(self.limit)
    }

    fn bends(&self, by: &str) -> SlopesError {
        SlopesError::Bends { name: self.limit().text.clone(), by: by.to_owned() }
    }

    /// The nodes that the limit reads, if it reads nothing else.
    fn nodes_alone(&self) -> Option<Vec<NodeId>> {
        let sides = self.limit().sides().map(|side| self.network().nodes_alone(side));
        let [of, value] = sides;
        Some([of?, value?].concat())
    }

    /// The derivative of the margin by the temperature of each node.
    fn weights(&self, nodes: &[NodeId]) -> Result<Vec<f64>, SlopesError> {
        let mut replay = self.replay(self.system);
        let mut temperatures = self.steady.temperatures.clone();
        let mut weights = vec![0.0; temperatures.len()];
        for &node in nodes {
            let own = temperatures[node.index()];
            let found = slope(KELVIN, |change| {
                temperatures[node.index()] = own + change;
                self.at(&mut replay, &temperatures)
            })?;
            temperatures[node.index()] = own;
            let none = || self.bends(&format!("{}.T", self.network().nodes()[node.index()].name));
            weights[node.index()] = found.ok_or_else(none)?;
        }
        Ok(weights)
    }

    /// The derivative of the margin by a parameter while temperatures stay.
    fn directly(&self, parameter: ParameterId) -> Result<f64, SlopesError> {
        let own = self.network().parameter_value(parameter);
        let at = |change: f64| -> Result<f64, SlopesError> {
            let mut changed = self.network().given();
            changed.set(parameter, own + change);
            let system = self.system.with(&changed)?;
            Ok(self.at(&mut self.replay(&system), &self.steady.temperatures)?)
        };
        let found = slope(step(self.network(), parameter), at)?;
        found.ok_or_else(|| self.bends(&self.network().parameters()[parameter.index()].name))
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
        let near = Near { system, steady: self, limit };
        let margin = near.at(&mut near.replay(system), &self.temperatures)?;
        let alone = near.nodes_alone();
        let all = || system.network().thermal_nodes().collect::<Vec<_>>();
        let weights = near.weights(&alone.clone().unwrap_or_else(all))?;
        let adjoint = Adjoint::of_sum(system, self, &weights)?;
        let mut by = adjoint.by_parameters(parameters)?;
        if alone.is_none() {
            for (by, &parameter) in by.iter_mut().zip(parameters) {
                *by += near.directly(parameter)?;
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
        found.ok_or_else(|| SlopesError::Bends { name: name(), by: by() })
    }
}
