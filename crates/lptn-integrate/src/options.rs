//! Settings of an integration.

use crate::linear::LinearSolver;

/// Settings of an [`crate::Integrator`]; take [`Options::default`] and change some fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Absolute tolerance in units of y, positive; there is no relative one, because `y` may have
    /// an arbitrary zero. CVODE works with a third of it. For stable systems the error of every
    /// component stays below ten times the tolerance (a rule from measurement, not a bound).
    pub tolerance: f64,
    /// Largest error of running integrals in a step: a share of their value and, in their own unit,
    /// an amount that is of no interest; not negative, not both 0. If it is tighter than the error
    /// of the state requires, steps become smaller.
    pub integrals: Allowance,
    /// Largest number of steps over the life of the integrator, restarts included.
    pub max_steps: usize,
    /// Size of the first step after the start and after every restart, positive, in units of t.
    /// `None`: estimated.
    pub initial_step: Option<f64>,
    /// Largest step, positive, in units of t. `None`: no limit.
    pub max_step_size: Option<f64>,
    /// The linear solver.
    pub linear_solver: LinearSolver,
    /// Newton's method stops when its estimated error is below this fraction of the local
    /// tolerance; positive. `None`: a choice by kind of Jacobian that closes the energy balance,
    /// see [`crate::Integrator`].
    pub newton_coefficient: Option<f64>,
    /// Size of each parameter of [`crate::OdeSystem::sensitivity_flow`], positive, in units of
    /// `p_i`: the error allowed in `s_i` is the tolerance over this, so that `s_i` times the
    /// scale, a change of y, is as accurate as y. As many as there are parameters; empty: all 1.
    pub sensitivity_scales: Vec<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance: 1e-5,
            integrals: Allowance { share: 0.0, amount: f64::INFINITY },
            max_steps: 10_000_000,
            initial_step: None,
            max_step_size: None,
            linear_solver: LinearSolver::Auto,
            newton_coefficient: None,
            sensitivity_scales: Vec::new(),
        }
    }
}

/// Error that a running integral may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// Share of the value of the integral.
    pub share: f64,
    /// Amount in the unit of the integral; infinite if there is no requirement.
    pub amount: f64,
}
