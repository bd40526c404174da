//! Reasons why a result of a run has no gradient.

use lptn_assembly::ChangeError;
use lptn_integrate::{FactorError, IntegrateError};
use lptn_network::{InputError, NoTangents};

use crate::error::TransientError;
use crate::margin::BentMargin;
use crate::trajectory::NoTrajectory;
use crate::unsolved::Unsolved;

lptn_units::errors! {
/// Reason why a result of a run has no gradient.
#[derive(Debug)]
pub enum BackwardError {
    /// The states of the run are not known.
    Trajectory => NoTrajectory;
    /// The network has no derivatives.
    Tangents => NoTangents;
    /// The result has no derivative at fixed temperatures.
    Margin => BentMargin;
    /// A balance of the run is not solved again.
    Unsolved => Unsolved;
    /// The way back cannot be integrated.
    Run => TransientError;
    /// The balances of massless nodes are singular.
    Factorization(error: FactorError) = "solve::singular", error, source error,
        class lptn_units::Class::Numbers;
    /// It was interrupted.
    Interrupted = "run::interrupted", "the gradient was interrupted";
    /// A control or comparison only just reaches its threshold: its name and the time in s.
    Grazes { name: String, time: f64 } = "gradient::grazes",
        format!("`{name}` only just reaches its threshold at {time} s: a small change of a \
                 parameter may leave the switch out, so that there is no gradient"),
        help "begin at another value, or use a method without derivatives";
    /// A result is integrated that changes too fast.
    Unresolved { name: String } = "gradient::unresolved",
        format!("`{name}` changes too fast for its integral to have an exact gradient"),
        help "take the mean of a temperature instead";
    /// The result is not a number of one moment, a mean or an integral: its text.
    Functional { name: String } = "gradient::functional",
        format!("`{name}` has no gradient: last, max, min, mean and integral have one"),
        help "use a method without derivatives";
}
}

impl From<InputError> for BackwardError {
    fn from(error: InputError) -> Self {
        BentMargin::from(error).into()
    }
}

impl From<ChangeError> for BackwardError {
    fn from(error: ChangeError) -> Self {
        BentMargin::from(error).into()
    }
}

impl From<FactorError> for BackwardError {
    fn from(error: FactorError) -> Self {
        Self::Factorization(error)
    }
}

impl From<IntegrateError> for BackwardError {
    fn from(error: IntegrateError) -> Self {
        TransientError::Integrator(error).into()
    }
}
