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
use crate::operating_point::OperatingPoint;

/// The state, and how far the linear network was tried from it.
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

    /// The reduction near it; the disturbance that is tried is what heat at the port makes.
    pub(super) fn reduce(
        &mut self,
        (system, port): (&ThermalSystem, NodeId),
        options: &ReductionOptions,
    ) -> Result<Reduction, ReduceError> {
        let failed = |error| ReduceError::Response(ResponseError::Linearised(error));
        let state = &self.point.state;
        let mut linear = Linearised::of(system, Some(state)).map_err(failed)?;
        let reduction = Reduction::near(system, port, (&linear, state), options)?;
        self.tried = linear.tried_along(&reduction.norton.response).map_err(failed)?;
        Ok(reduction)
    }

    /// As [`OperatingPoint::passed`].
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

    /// How far it was tried.
    pub(super) fn notes(&self) -> Vec<String> {
        self.point.notes(self.tried)
    }

    pub(super) fn json(&self) -> Value {
        self.point.json(self.tried)
    }
}
