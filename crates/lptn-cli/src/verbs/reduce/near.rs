//! `lptn reduce --at`: the equivalent of a network near one of its states.

use lptn_assembly::ThermalSystem;
use lptn_netlist::Diagnostic;
use lptn_network::NodeId;
use lptn_reduce::{Allowed, Judge, ReduceError, Reduction, ReductionOptions};
use lptn_solve::{Linearised, ResponseError, Tried};
use serde_json::Value;

use super::Limit;
use super::args::{ReduceArgs, ReduceFormat};
use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::operating_point::OperatingPoint;

/// The state, and how far the linear network was tried from it.
pub(crate) struct Near {
    point: OperatingPoint,
    tried: Option<Tried>,
}

impl Near {
    /// The state that is asked for, if one is.
    pub(super) fn find(
        args: &ReduceArgs,
        input: &Input,
        console: &Console,
    ) -> Result<Option<Self>, Failure> {
        let point = args.at.find(input, console)?;
        Ok(point.map(|point| Self { point, tried: None }))
    }

    /// The reduction near it; the disturbance that is tried is what heat at the port makes.
    pub(super) fn reduce(
        self,
        (system, port): (&ThermalSystem, NodeId),
        options: &ReductionOptions,
    ) -> Result<(Reduction, Option<Self>), ReduceError> {
        let failed = |error| ReduceError::Response(ResponseError::Linearised(error));
        let state = &self.point.state;
        let mut linear = Linearised::of(system, Some(state)).map_err(failed)?;
        let reduction = Reduction::near(system, port, (&linear, state), options)?;
        let tried = linear.tried_along(&reduction.norton.response).map_err(failed)?;
        Ok((reduction, Some(Self { tried, ..self })))
    }

    /// "the steady state".
    pub(super) fn name(&self) -> &str {
        self.point.name()
    }

    /// How far it was tried.
    pub(super) fn notes(&self) -> Vec<String> {
        self.point.notes(self.tried)
    }

    pub(super) fn json(&self) -> Value {
        self.point.json(self.tried)
    }
}

/// Refuses what is about the whole network, or about its run, near a state.
pub(super) fn allowed(args: &ReduceArgs, limit: &Limit) -> Result<(), Failure> {
    let options = [
        (args.write.is_some(), "--write"),
        (args.format == ReduceFormat::Toml, "--format toml"),
        (args.bias, "--bias"),
        (args.judge == Judge::Run, "--for run"),
        (matches!(limit.allowed, Allowed::Kelvin(_)), "--max-error in K"),
    ];
    let Some((_, option)) = options.into_iter().find(|(asked, _)| *asked && args.at.at.is_some())
    else {
        return Ok(());
    };
    let message =
        format!("{option} is about whole runs, and --at about small disturbances of a state");
    let help = "leave one of them out; R_eq, C_eq, T_ref and Q_N of the table make a netlist by \
        hand, if it is to stay near that state";
    Err(Failure::new(Exit::Input, Diagnostic::error("reduce::near", message).help(help)))
}
