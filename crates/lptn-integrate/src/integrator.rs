//! Interface of a stiff integrator, which steps a system from one discontinuity to the next.

use crate::{IntegrateError, LinearSolverKind, OdeSystem, SeriesStep, Statistics};

/// One internal step, in units of t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Start of the step.
    pub from: f64,
    /// End of the step: the present time of the integrator.
    pub to: f64,
    /// True if it ended at the stop time.
    pub at_stop: bool,
    /// True if it ended at a root: see [`OdeSystem::roots`] and [`Integrator::root_directions`].
    pub roots: bool,
}

/// Integrates an [`OdeSystem`] that it owns, in steps that it chooses.
///
/// Steps may be shorter than the distance of two doubles at a time far from 0; the flow is then
/// evaluated at rounded times.
///
/// The running integrals obey the same formula as the state, so a balance such as
/// `sum of M (y1 - y0) = integral of the total flow` is exact up to the residual of Newton's
/// method. The defaults keep that small; see
/// [`Options::newton_coefficient`](crate::Options::newton_coefficient).
pub trait Integrator<S: OdeSystem> {
    /// Present time.
    fn time(&self) -> f64;

    /// State at [`time`](Self::time), in units of y.
    fn state(&self) -> &[f64];

    /// The system.
    fn system(&self) -> &S;

    /// The system, to be changed. A change that makes `f` jump must be followed by
    /// [`restart`](Self::restart); its size, pattern, symmetry and number of quadratures must stay.
    fn system_mut(&mut self) -> &mut S;

    /// From now on no step crosses `t`, until another stop time is set; `f64::INFINITY` means no
    /// stop. The first step of CVODES after a start is at most a tenth of the way to the stop time.
    fn set_stop(&mut self, t: f64);

    /// From now on no step is longer than this, positive, in units of t; it replaces
    /// [`Options::max_step_size`](crate::Options::max_step_size).
    fn set_longest_step(&mut self, step: f64);

    /// Takes one step of the size that the error allows. At the stop time it does nothing, and
    /// returns a step of no length that says so.
    ///
    /// If the Jacobian is symmetric but not constant, and Newton's method fails three times in a
    /// row (the matrix not being positive definite is one way to fail) or in a quarter of 60 steps,
    /// the symmetric values are given up for the rest of the run: see [`OdeSystem::leave_symmetry`]
    /// and [`Statistics::switched_to_lu`]. The running integrals go on.
    ///
    /// # Errors
    /// See [`IntegrateError`]; [`time`](Self::time) and [`state`](Self::state) are then those of
    /// the last good step.
    fn step(&mut self) -> Result<Step, IntegrateError>;

    /// Writes the state at a time inside the last step, ends included, to `y` (one value per
    /// component).
    ///
    /// # Errors
    /// [`IntegrateError::OutsideLastStep`] (after a start or a restart only the present time is
    /// inside), a wrong length.
    fn interpolate(&mut self, t: f64, y: &mut [f64]) -> Result<(), IntegrateError>;

    /// Restarts at [`time`](Self::time), from the present state or from `y`, because `f` or the
    /// state jumps here. The running integrals go on, and so do the sensitivities, unless they jump
    /// too: see [`set_sensitivities`](Self::set_sensitivities).
    ///
    /// # Errors
    /// A state of the wrong length or not finite.
    fn restart(&mut self, y: Option<&[f64]>) -> Result<(), IntegrateError>;

    /// Goes back to a time inside the last step, ends included, and restarts there as
    /// [`restart`](Self::restart) does: with the state of [`interpolate`](Self::interpolate), the
    /// running integrals and the sensitivities at that time.
    ///
    /// # Errors
    /// [`IntegrateError::OutsideLastStep`]; then nothing is changed.
    fn rewind(&mut self, t: f64) -> Result<(), IntegrateError>;

    /// For every function of [`OdeSystem::roots`] at the last step that ended at a root: 1 if it
    /// rises through zero, -1 if it falls, 0 if it has no root there. All 0 before the first.
    ///
    /// After such a step [`step`](Self::step) takes the rest of the same internal step, if nothing
    /// is done; a [`restart`](Self::restart) is due if the flow jumps.
    fn root_directions(&self) -> &[i32];

    /// The running integrals from the start to [`time`](Self::time), restarts included; one per
    /// [`OdeSystem::quadrature_count`].
    ///
    /// # Errors
    /// [`IntegrateError::Sundials`], or the error of an [`OdeSystem::quadrature`] that is due.
    fn quadratures(&mut self) -> Result<&[f64], IntegrateError>;

    /// The sensitivities at [`time`](Self::time): [`OdeSystem::sensitivity_count`] blocks of
    /// [`OdeSystem::size`] values, one after the other, in units of y per unit of the parameter.
    /// They begin at 0.
    ///
    /// Their error against those of the exact solution stays below ten times the tolerance over
    /// [`Options::sensitivity_scales`](crate::Options::sensitivity_scales), by the same rule as
    /// that of the state.
    ///
    /// # Errors
    /// [`IntegrateError::Sundials`] only.
    fn sensitivities(&mut self) -> Result<&[f64], IntegrateError>;

    /// Sets the sensitivities at [`time`](Self::time), in the order of
    /// [`sensitivities`](Self::sensitivities): because the start depends on the parameters, or
    /// because the state or the time of a jump does. If steps were taken since the last start, this
    /// restarts as [`restart`](Self::restart) does and counts as one; after a start, a restart
    /// or a rewind it costs nothing.
    ///
    /// If `f` jumps by `D` (after minus before) at the time `tau` that itself moves with a
    /// parameter, `s_i` jumps by `-D / M dtau/dp_i`.
    ///
    /// # Errors
    /// A wrong length, a value that is not finite ([`IntegrateError::InvalidState`] with its place
    /// in all blocks).
    fn set_sensitivities(&mut self, s: &[f64]) -> Result<(), IntegrateError>;

    /// Writes the sensitivities at a time inside the last step, ends included, in the order of
    /// [`sensitivities`](Self::sensitivities).
    ///
    /// # Errors
    /// [`IntegrateError::OutsideLastStep`] (after a start or a restart only the present time is
    /// inside), a wrong length.
    fn interpolate_sensitivities(&mut self, t: f64, s: &mut [f64]) -> Result<(), IntegrateError>;

    /// The present step of the one-step method as a series; `None` before the first one, and for
    /// other methods.
    fn series(&self) -> Option<SeriesStep<'_>> {
        None
    }

    /// Counters since the integrator was made.
    fn statistics(&self) -> Statistics;

    /// The linear solver in use.
    fn linear_solver(&self) -> LinearSolverKind;
}
