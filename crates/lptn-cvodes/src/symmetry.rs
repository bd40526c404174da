//! The rule by which LU replaces symmetric Newton matrices.
//!
//! Symmetric Newton matrices are abandoned, never repaired. Radiation and G(T) enter with the mean
//! of their two derivatives, so that Cholesky serves. After three failed attempts in a row, or 15
//! failures in 60 steps, the rest of the run takes exact derivatives and LU. Streams and couplings
//! to third nodes take LU from the start.

use std::ffi::c_int;

use sundials_sys as sys;

use crate::memory::Flag;
use lptn_integrate::{LinearSolver, OdeSystem, Statistics};

/// Attempts at one step that may fail before the symmetric matrices count as the reason.
pub(crate) const SYMMETRIC_ATTEMPTS: c_int = 3;

/// CVODES' own number of attempts at one step.
pub(crate) const ATTEMPTS: c_int = 10;

/// Steps over which failures are counted. A matrix that makes Newton's method diverge above some
/// step size is not a failure of any one step: the step shrinks by four, succeeds, grows, fails.
/// This is one failure in three steps (measured on a stream with the Jacobian 0); radiating plates
/// with symmetrised Jacobians stay below one in ten.
const WINDOW: u64 = 60;

/// Failures in a window that give the symmetric values up.
const TOO_MANY: u64 = 15;

/// Decides if the values of the Newton matrix are treated as symmetric.
pub(crate) struct Symmetry {
    /// The linear solver asked for.
    choice: LinearSolver,
    /// True while there are symmetric values to give up.
    held: bool,
    switched: Option<f64>,
    /// Steps and failures at the start of the window.
    window: (u64, u64),
}

impl Symmetry {
    /// A constant Jacobian has nothing to give up: no one symmetrised it.
    pub(crate) fn of(system: &impl OdeSystem, choice: LinearSolver) -> Self {
        let held = system.symmetric() && !system.jacobian_is_constant();
        Self { choice, held, switched: None, window: (0, 0) }
    }

    pub(crate) fn is_held(&self) -> bool {
        self.held
    }

    pub(crate) fn switched(&self) -> Option<f64> {
        self.switched
    }

    pub(crate) fn set_switched(&mut self, time: f64) {
        self.switched = Some(time);
    }

    /// True if CVODES gave up a step for a reason that better Newton iterates may remove. CVODES
    /// counts all these failures together. Each must be listed here, or it would end the
    /// integration sooner than without a switch.
    pub(crate) fn is_to_blame(&self, flag: &Flag) -> bool {
        let reasons = [
            sys::CV_CONV_FAILURE,
            sys::CV_REPTD_RHSFUNC_ERR,
            sys::CV_REPTD_QRHSFUNC_ERR,
            sys::CV_REPTD_SRHSFUNC_ERR,
        ];
        self.held && reasons.contains(&flag.value)
    }

    /// True if a window of steps ends with at least `TOO_MANY` failures of Newton's method.
    pub(crate) fn stalls(&mut self, so_far: &Statistics) -> bool {
        let (steps, failures) = self.window;
        if !self.held || so_far.steps < steps + WINDOW {
            return false;
        }
        self.window = (so_far.steps, so_far.newton_failures);
        so_far.newton_failures >= failures + TOO_MANY
    }

    /// Gives the symmetric values up; returns the linear solver to use instead.
    pub(crate) fn leave(&mut self) -> LinearSolver {
        self.held = false;
        match self.choice {
            LinearSolver::Cholesky | LinearSolver::Pcg => LinearSolver::Lu,
            choice => choice,
        }
    }
}
