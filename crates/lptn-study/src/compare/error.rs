//! Why a candidate has no results.

use std::sync::Arc;

use lptn_analysis::RunError;
use lptn_network::InputError;
use lptn_solve::{PeriodicError, SteadyError, TransientError, Unsolved};
use lptn_units::Class;

lptn_units::errors! {
/// Why a candidate has no results.
#[derive(Debug)]
pub enum CompareError {
    /// It is not run and has no steady state.
    Steady => SteadyError as Class::not_an_answer;
    /// Its run failed.
    Run => Box<TransientError>;
    /// A limit, source or boundary has no value.
    Input => InputError;
    /// The balances of its massless nodes have no solution at the start.
    Start => Unsolved as Class::of_numbers;
    /// It has no periodic steady state, and that was requested.
    Cycle(error: Arc<PeriodicError>) = error.code(),
        format!("there is no periodic steady state: {error}"),
        source error.as_ref(), help error.help(), class error.class().not_an_answer();
    /// Its inputs change with time, and no signal is repeated.
    NoPeriod = "periodic::no_period",
        "its inputs change with time and no signal is repeated, so there is no periodic steady \
         state",
        help "let a signal repeat: after_end = \"repeat\"";
    /// Its run was interrupted at this time in s: peaks and limits of a part would read like those
    /// of the whole.
    Interrupted(time: f64) = "run::interrupted", format!("the run was interrupted at {time} s"),
        class Class::Interrupted;
}
}

impl From<RunError> for CompareError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Failed(error) => Self::Run(error),
            RunError::Interrupted { time, .. } => Self::Interrupted(time),
        }
    }
}

impl CompareError {
    /// The input that has no value, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(input) => Some(input),
            Self::Steady(error) => error.input(),
            Self::Run(error) => error.input(),
            Self::Start(unsolved) => unsolved.input(),
            Self::Cycle(error) => error.input(),
            _ => None,
        }
    }
}
