//! The equivalent of a network near one of its states.

use lptn_assembly::ThermalSystem;
use lptn_netlist::Diagnostic;
use lptn_network::NodeId;
use lptn_reduce::{ReduceError, Reduction, ReductionOptions};
use lptn_solve::{Linearised, ResponseError, Tried};
use serde_json::Value;

use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::operating_point::{OperatingPoint, without_slopes};

/// The state, and the check of the linear network near it.
#[derive(Debug)]
pub(super) struct Near {
    point: OperatingPoint,
    tried: Option<Tried>,
}

impl Near {
    /// The state that a text names.
    pub(super) fn find(
        text: &str,
        input: &Input,
        listener: &dyn Listener,
    ) -> Result<Self, Failure> {
        let point = OperatingPoint::find(text, input, listener)?;
        Ok(Self { point, tried: None })
    }

    /// The reduction near it. The disturbance for the check is the response to heat at the port.
    pub(super) fn reduce(
        &mut self,
        (system, port): (&ThermalSystem, NodeId),
        options: &ReductionOptions,
    ) -> Result<Reduction, ReduceError> {
        let failed = |error| ReduceError::Response(ResponseError::Linearised(error));
        let state = &self.point.state;
        let mut linear = Linearised::of(system, Some(state)).map_err(failed)?;
        let mut reduction = Reduction::near(system, port, (&linear, state), options)?;
        self.tried = linear.tried_along(&reduction.norton.response).map_err(failed)?;
        if let Some(dynamics) = reduction.dynamics.as_mut().filter(|_| self.fails().is_some()) {
            // errors of one node against a linear network that is wrong itself
            dynamics.pairs.iter_mut().for_each(|pair| pair.step = None);
            dynamics.recommended.by = None;
        }
        Ok(reduction)
    }

    /// Why no linear network describes the state, if none does.
    pub(super) fn fails(&self) -> Option<String> {
        self.tried.and_then(without_slopes)
    }

    /// True if the linear network misses more heat than the disturbance brings, if that is large.
    pub(super) fn is_coarse(&self) -> bool {
        self.tried.is_some_and(|tried| tried.share >= 1.0)
    }

    /// See [`OperatingPoint::passed`].
    pub(super) fn passed<T>(
        &self,
        found: Result<T, Failure>,
        heard: (&Input, &dyn Listener),
    ) -> Result<T, Failure> {
        self.point.passed(found, heard)
    }

    /// "the steady state".
    pub(super) fn name(&self) -> &str {
        self.point.name()
    }

    /// Doubts in the state.
    pub(super) fn doubts(&self) -> &[Diagnostic] {
        &self.point.doubts
    }

    /// Notes on the linearised network and its error.
    pub(super) fn notes(&self) -> Vec<String> {
        self.point.notes(self.tried)
    }

    pub(super) fn json(&self) -> Value {
        self.point.json(self.tried)
    }
}
