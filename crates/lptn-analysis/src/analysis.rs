//! Over what a network is analysed, chosen while the program runs.

use lptn_assembly::ThermalSystem;
use lptn_network::InputError;
use lptn_solve::{Periodic, Solution, SteadyState};

use crate::answer::Answer;
use crate::error::AnalysisError;
use crate::limits::LimitResult;
use crate::run::{Observer, RunAnalysis};
use crate::steady::{steady, steady_within};
use crate::trust::Trust;

/// Over what a network is analysed.
#[derive(Clone, Debug)]
pub enum Analysis {
    /// Its steady state.
    Steady {
        /// The time in s at which inputs are read.
        time: f64,
        /// The tolerance in K of a run to it; `None` for the steady state itself.
        within: Option<f64>,
    },
    /// A run.
    Run(RunAnalysis),
    /// The cycle that it settles to.
    Cycle(RunAnalysis),
}

/// The answer to an [`Analysis`].
#[derive(Clone, Debug)]
pub enum Found {
    /// A steady state.
    Steady(Answer<SteadyState>),
    /// A run.
    Run(Answer<Solution>),
    /// A settled cycle.
    Cycle(Answer<Periodic>),
}

impl Analysis {
    /// Analyses a network.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn ask(
        &self,
        system: &ThermalSystem,
        observer: &mut Observer<'_>,
    ) -> Result<Found, AnalysisError> {
        Ok(match self {
            Self::Steady { time, within: None } => Found::Steady(steady(system, *time)?),
            Self::Steady { time, within: Some(tolerance) } => {
                Found::Steady(steady_within(system, *time, *tolerance)?)
            }
            Self::Run(run) => Found::Run(run.solve(system, observer)?),
            Self::Cycle(run) => Found::Cycle(run.cycle(system, observer)?),
        })
    }
}

impl Found {
    /// How far it can be trusted.
    pub fn trust(&self) -> &Trust {
        match self {
            Self::Steady(answer) => &answer.trust,
            Self::Run(answer) => &answer.trust,
            Self::Cycle(answer) => &answer.trust,
        }
    }

    /// What it is over time; `None` for a steady state.
    pub fn over_time(&self) -> Option<&Solution> {
        match self {
            Self::Steady(_) => None,
            Self::Run(answer) => Some(answer),
            Self::Cycle(answer) => Some(&answer.solution),
        }
    }

    /// What became of the limits of its network, in their order.
    ///
    /// # Errors
    /// [`InputError`] if a limit has no value in steady state.
    pub fn limits(&self, system: &ThermalSystem) -> Result<Vec<LimitResult>, InputError> {
        match self {
            Self::Steady(answer) => LimitResult::of_steady(system.network(), answer),
            Self::Run(answer) => Ok(answer.limits().iter().map(LimitResult::of_run).collect()),
            Self::Cycle(answer) => Ok(LimitResult::of_cycle(answer)),
        }
    }
}
