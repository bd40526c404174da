//! Reasons why results have no gradient.

use lptn_analysis::{AnalysisError, RunError};
use lptn_assembly::ChangeError;
use lptn_network::{BuildErrors, InputError};
use lptn_solve::{BackwardError, SensitiveError, SlopesError, SteadyError};

lptn_units::errors! {
/// Reason why results have no derivatives by parameters.
#[derive(Debug)]
pub enum GradientError {
    /// The network with these values.
    Change => ChangeError;
    /// It has no steady state, or its run failed.
    Analysis => AnalysisError;
    /// The run with its sensitivities failed.
    Sensitive => SensitiveError;
    /// A result has no derivative there.
    Slopes => SlopesError;
    /// The run has no adjoint.
    Backward => BackwardError;
    /// A value of the network cannot be evaluated.
    Input => InputError;
    /// A time in s at which the run has no results.
    Outside { time: f64, start: f64, stop: f64 } = "gradient::outside",
        format!("the run goes from {start} s to {stop} s and has no results at {time} s"),
        help "take times of the run, or begin it earlier: `start` of [run]";
    /// The results are those of a cycle.
    Periodic = "gradient::periodic", "a periodic steady state has no gradient",
        help "take the results over a run that lasts several periods";
    /// The netlist has no run.
    NoRun = "run::no_run", "the netlist has no [run], so the duration of a run is not known",
        help "add these lines:\n\n[run]\nstop = \"25 min\"";
    /// A functional that has no derivative here; its text.
    Functional { name: String } = "gradient::functional",
        format!("`{name}` has no gradient: last, max, min, mean and integral have one"),
        help "use a method without derivatives";
    /// The times of the run depend on a parameter.
    Times = "gradient::times", "the times of the run depend on a parameter of the gradient",
        help "write `start` and `stop` of [run] as numbers";
    /// A quantity jumps at a time that depends on the parameters.
    Jumps { name: String, time: f64 } = "gradient::jumps",
        format!("`{name}` jumps at {time} s, and parameters move that time: its integral has no \
                 exact gradient"),
        help "take the mean of a temperature instead";
    /// A comparison in a quantity changes at a time that depends on temperatures or parameters.
    MovingJump { name: String } = "gradient::moving_jump",
        format!(
            "`{name}` compares temperatures or parameters of the gradient: it may jump at a time \
             that they move, and then it has no exact gradient"
        ),
        help "leave out the comparison, or use a method without derivatives";
    /// The quantity changes faster than its integral resolves.
    Unresolved { name: String } = "gradient::unresolved",
        format!("`{name}` changes too fast for its integral to have an exact gradient"),
        help "write rows in shorter intervals: `every` of `output` in [run]";
    /// The network has no exact sensitivities; why.
    Differences { why: String } = "gradient::differences",
        format!("the network has no exact sensitivities: {why}"),
        help "use a method without derivatives";
}
}

impl From<SteadyError> for GradientError {
    fn from(error: SteadyError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<RunError> for GradientError {
    fn from(error: RunError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<BuildErrors> for GradientError {
    fn from(errors: BuildErrors) -> Self {
        Self::Change(errors.into())
    }
}
