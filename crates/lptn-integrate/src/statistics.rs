//! Counters of an integration.

/// Work done since the integrator was made, restarts included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted internal steps.
    pub steps: u64,
    /// Calls of [`crate::OdeSystem::flow`].
    pub flow_evaluations: u64,
    /// Calls of [`crate::OdeSystem::jacobian`].
    pub jacobian_evaluations: u64,
    /// Calls of [`crate::OdeSystem::quadrature`].
    pub quadrature_evaluations: u64,
    /// Calls of [`crate::OdeSystem::sensitivity_flow`].
    pub sensitivity_evaluations: u64,
    /// Times that the integrator asked for a Newton matrix.
    pub linear_setups: u64,
    /// Numerical factorisations.
    pub factorizations: u64,
    /// Linear solves.
    pub linear_solves: u64,
    /// Iterations in all linear solves; 0 for exact factors.
    pub linear_iterations: u64,
    /// Numbers stored for the factors that are in use.
    pub fill: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Steps repeated because the estimated error was too large.
    pub error_test_failures: u64,
    /// Steps repeated because Newton's method did not converge.
    pub newton_failures: u64,
    /// Calls of [`crate::Integrator::restart`] and [`crate::Integrator::rewind`].
    pub restarts: u64,
    /// Time at which symmetric Newton matrices were given up for LU, in units of t; see
    /// [`crate::Integrator::step`].
    pub switched_to_lu: Option<f64>,
    /// Order of the last step, 1 to 11; 0 before the first.
    pub last_order: u32,
    /// Size of the last step in units of t; 0 before the first.
    pub last_step: f64,
}
