//! One value of the parameter: the full network in steady state, and what is left of every
//! requirement.

use std::cell::Cell;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Goal, Requirement};
use lptn_network::{Network, ParameterId, Parameters};
use lptn_solve::{OutOfRange, SteadyState};

use crate::size::SizeError;

/// What is to be sized.
#[derive(Debug)]
pub struct SizeTask<'a> {
    /// The network with every parameter at its own value.
    pub network: &'a Network,
    /// The values that its other parameters keep; see [`Network::overrides`].
    pub parameters: Parameters,
    /// The parameter whose value is sought.
    pub parameter: ParameterId,
    /// The least and the largest value it may take, in SI units.
    pub range: (f64, f64),
    /// Which of several values that do is the best.
    pub goal: Goal,
    /// What has to be kept.
    pub requirements: &'a [Requirement],
    /// The time in s at which inputs are read.
    pub time: f64,
}

/// The network at one value of the parameter.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The value in SI units.
    pub value: f64,
    /// How far each requirement is from being broken, in SI units: positive while it is kept.
    pub margins: Vec<f64>,
    /// The laws that are outside the ranges in which they are known.
    pub out_of_range: Vec<OutOfRange>,
}

/// Solves the network again and again, and counts how often.
pub(crate) struct Trials<'a> {
    task: &'a SizeTask<'a>,
    count: Cell<usize>,
}

impl<'a> Trials<'a> {
    pub(crate) fn new(task: &'a SizeTask<'a>) -> Self {
        Self { task, count: Cell::new(0) }
    }

    pub(crate) fn count(&self) -> usize {
        self.count.get()
    }

    /// Solves the steady state at `value`: nothing is parsed, the structure is shared.
    pub(crate) fn at(&self, value: f64) -> Result<Trial, SizeError> {
        self.count.set(self.count.get() + 1);
        let task = self.task;
        let mut parameters = task.parameters.clone();
        parameters.set(task.parameter, value);
        let network = task
            .network
            .with(&parameters)
            .map_err(|errors| SizeError::Network { value, errors })?;
        let of_value = |error| match error {
            SizeError::Steady { error, .. } => SizeError::Steady { value, error },
            error => error,
        };
        let steady = solved(&network, task.time).map_err(of_value)?;
        let margins = margins(&network, task.requirements, &steady)?;
        let out_of_range = OutOfRange::of_steady(&network, &steady).unwrap_or_default();
        Ok(Trial { value, margins, out_of_range })
    }
}

/// How far each requirement is from being broken in the steady state of `network` with inputs as
/// they are at `time` in s: in SI units, positive while it is kept.
///
/// # Errors
/// [`SizeError`] if there is no steady state or a requirement has no value.
pub fn requirement_margins(
    network: &Network,
    requirements: &[Requirement],
    time: f64,
) -> Result<Vec<f64>, SizeError> {
    margins(network, requirements, &solved(network, time)?)
}

fn solved(network: &Network, time: f64) -> Result<SteadyState, SizeError> {
    let system = ThermalSystem::assemble(network).map_err(SizeError::Assembly)?;
    SteadyState::solve(&system, time).map_err(|error| SizeError::Steady { value: f64::NAN, error })
}

fn margins(
    network: &Network,
    requirements: &[Requirement],
    steady: &SteadyState,
) -> Result<Vec<f64>, SizeError> {
    let mut scope = steady.evaluation(network);
    let margin = |requirement: &Requirement| {
        let failed = |error| SizeError::Requirement { text: requirement.text.clone(), error };
        let margin = requirement.margin(&mut scope).map_err(|error| failed(Some(error)))?;
        if margin.is_finite() { Ok(margin) } else { Err(failed(None)) }
    };
    requirements.iter().map(margin).collect()
}
