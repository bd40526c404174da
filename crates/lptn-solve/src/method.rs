//! The available integrators.

use lptn_network::IntegratorChoice;

/// The integrator that computed a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The one-step method for linear networks.
    OneStep,
    /// An implicit Runge-Kutta method, for inputs of many points.
    Esdirk,
    /// CVODES' backward differences.
    Cvode,
}

impl Method {
    /// Its name in `integrator` of `[run]`.
    pub fn name(self) -> &'static str {
        match self {
            Self::OneStep => IntegratorChoice::OneStep.word(),
            Self::Esdirk => IntegratorChoice::Esdirk.word(),
            Self::Cvode => IntegratorChoice::Cvode.word(),
        }
    }
}
