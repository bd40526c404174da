//! The kind of analysis of a network, chosen while the program runs.

use lptn_assembly::ThermalSystem;
use lptn_solve::{Periodic, Solution, SteadyState};

use crate::error::AnalysisError;
use crate::run::{Observer, RunAnalysis};
use crate::steady::{steady, steady_within};
use crate::trust::Trust;
use crate::trusted::Trusted;

/// A kind of analysis of a network.
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
    /// The periodic steady state.
    Cycle(RunAnalysis),
}

/// The answer to an [`Analysis`].
#[derive(Clone, Debug)]
pub enum Found {
    /// A steady state.
    Steady(Trusted<SteadyState>),
    /// A run.
    Run(Trusted<Solution>),
    /// A periodic steady state.
    Cycle(Trusted<Periodic>),
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
    /// The trust in it.
    pub fn trust(&self) -> &Trust {
        match self {
            Self::Steady(answer) => &answer.trust,
            Self::Run(answer) => &answer.trust,
            Self::Cycle(answer) => &answer.trust,
        }
    }
}
