//! Why an analysis has no answer.

use lptn_solve::{PeriodicError, Solution, SteadyError, TransientError};
use lptn_units::{Class, format_six};

use crate::trust::Trust;
use crate::trusted::Trusted;

lptn_units::errors! {
/// Why a run has no answer.
#[derive(Debug)]
pub enum RunError {
    /// It failed, or its energy balance does not close.
    Failed => Box<TransientError>;
    /// The observer ended it at this time in s. The part of a run up to then is complete; there is
    /// none of a cycle.
    Interrupted { time: f64, part: Option<Box<Solution>> } = "run::interrupted",
        format!("the run was interrupted at {} s", format_six(*time)), class Class::Interrupted;
}
}

lptn_units::errors! {
/// Errors of the search for a periodic steady state.
#[derive(Debug)]
pub enum CycleError {
    /// It does not exist or was not found.
    Missing => Box<PeriodicError>;
    /// A run of the search failed, or was interrupted.
    Run => RunError;
}
}

lptn_units::errors! {
/// Why an analysis has no answer.
#[derive(Debug)]
pub enum AnalysisError {
    /// No steady state exists or was found.
    Steady => SteadyError;
    /// The run failed or was interrupted.
    Run => RunError;
    /// No periodic steady state exists or was found.
    Cycle => Box<PeriodicError>;
}
}

impl From<CycleError> for AnalysisError {
    fn from(error: CycleError) -> Self {
        match error {
            CycleError::Missing(error) => Self::Cycle(error),
            CycleError::Run(error) => Self::Run(error),
        }
    }
}

impl RunError {
    /// The part of a run that was computed before it ended, with the error that ended it: `None`
    /// for one that was interrupted, and for one whose energy balance does not close, as its ledger
    /// shows.
    ///
    /// # Errors
    /// The same error if nothing was computed.
    pub fn into_part(self) -> Result<(Trusted<Solution>, Option<Box<TransientError>>), Self> {
        let answer = |result: Solution| Trusted { trust: Trust::of_run(&result), result };
        match self {
            Self::Interrupted { part: Some(part), .. } => Ok((answer(*part), None)),
            Self::Failed(error) => match *error {
                TransientError::Open { solution, .. } => Ok((answer(*solution), None)),
                TransientError::Stopped { ref partial, .. } => {
                    Ok((answer(partial.as_ref().clone()), Some(error)))
                }
                _ => Err(Self::Failed(error)),
            },
            error @ Self::Interrupted { .. } => Err(error),
        }
    }
}
