//! An integrator for inputs that bend or jump often: a drive cycle of many points, say.
//!
//! BDF methods restart at order one with tiny steps wherever an input has a kink. A Runge-Kutta
//! method needs no history: a step reaches from kink to kink at its full order. The
//! method is singly diagonally implicit with an explicit first stage ([`tableau`]): five stages
//! share one matrix, whose factors last while the step does ([`newton`]).
//!
//! State, dense output and running integrals are sums of the same stages with the same weights, so
//! the energy balance closes at every time inside a step.

mod attempt;
mod newton;
mod stepping;
mod tableau;

use crate::calls::linear_trouble;
use crate::clock::Clock;
use crate::{Allowance, IntegrateError, LinearSolver, OdeSystem, Options, Statistics, checks};
use newton::Newton;
use tableau::STAGES;

/// The least and the largest change of the step size.
const CHANGE: (f64, f64) = (0.2, 5.0);

/// Size of a step over the size that the error would allow.
const HOPED: f64 = 0.9;

/// A failed step is shortened to this share.
const SHORTER: f64 = 0.25;

/// Tries of a step with symmetric values before they are given up.
const ATTEMPTS: u32 = 3;

/// The first step as a share of the way to the stop.
const FIRST: f64 = 0.1;

/// Integrates `M y' = f(t, y)` with a constant `M` by an implicit Runge-Kutta method of order 4.
///
/// There are no sensitivities, no roots and no slope: steps do not end at events. To find an
/// event, use [`crate::Integrator::interpolate`] and [`crate::Integrator::rewind`].
pub struct Esdirk<S> {
    system: S,
    clock: Clock,
    state: Vec<f64>,
    tolerance: f64,
    allowance: Allowance,
    max_steps: u64,
    longest: f64,
    /// The size of the next step; `None` before the first.
    hoped: Option<f64>,
    newton: Newton,
    /// Failed tries in a row.
    short: u32,
    stages: Stages,
    /// The component with the largest error in the last try.
    worst: usize,
    /// Length of the last step; none between a start and the first step.
    length: Option<f64>,
    integrals: Vec<f64>,
    directions: Vec<i32>,
    counts: Statistics,
}

/// The stages of the last step.
struct Stages {
    /// The state at the start of the step.
    begin: Vec<f64>,
    /// State of each stage.
    y: [Vec<f64>; STAGES],
    /// Rate of change of each, in units of y per time.
    rate: [Vec<f64>; STAGES],
    /// The integrands at each, and the integrals at the start of the step.
    integrands: [Vec<f64>; STAGES],
    integrals: Vec<f64>,
    /// True if the last stage is the first of the next step.
    follows: bool,
    work: Vec<f64>,
}

/// Failure of a step.
enum Failed {
    /// A shorter step may succeed.
    Shorter,
    /// No step can succeed.
    Ended(IntegrateError),
}

impl<S: OdeSystem> Esdirk<S> {
    /// True if a system can be integrated: without sensitivities, and with states that are carried
    /// as themselves.
    pub fn suits(system: &S) -> bool {
        system.slope().is_none() && system.sensitivity_count() == 0
    }

    /// Takes the system at time `t0` in the state `y0` (one value per component, units of y).
    ///
    /// # Errors
    /// Lengths that do not match, options out of range, a state or a mass that is not usable, no
    /// memory.
    pub fn new(system: S, t0: f64, y0: &[f64], options: &Options) -> Result<Self, IntegrateError> {
        checks::options(t0, options)?;
        checks::system(&system, y0)?;
        let newton = Newton::new(system.pattern(), system.symmetric(), options.linear_solver);
        let integrals = vec![0.0; system.quadrature_count()];
        let blank = || std::array::from_fn(|_| vec![0.0; y0.len()]);
        let stages = Stages {
            begin: y0.to_vec(),
            y: blank(),
            rate: blank(),
            integrands: std::array::from_fn(|_| integrals.clone()),
            integrals: integrals.clone(),
            follows: false,
            work: vec![0.0; y0.len()],
        };
        Ok(Self {
            newton: newton.map_err(|cause| linear_trouble(t0, cause))?,
            clock: Clock::new(t0),
            state: y0.to_vec(),
            tolerance: options.tolerance,
            allowance: options.integrals,
            max_steps: u64::try_from(options.max_steps).unwrap_or(u64::MAX),
            longest: options.max_step_size.unwrap_or(f64::INFINITY),
            hoped: options.initial_step,
            stages,
            short: 0,
            worst: 0,
            length: None,
            integrals,
            directions: vec![0; system.root_count()],
            counts: Statistics::default(),
            system,
        })
    }

    /// Ends the integration and hands the system back.
    pub fn into_system(self) -> S {
        self.system
    }

    /// Finds a step that the error allows; returns its length.
    fn find_step(&mut self) -> Result<f64, IntegrateError> {
        let way = self.clock.stop - self.clock.now;
        let first = || if way.is_finite() { FIRST * way } else { 1.0 };
        let mut h = self.hoped.unwrap_or_else(first).min(self.longest);
        let hoped = h;
        if h >= way || (way - h) < 1e-6 * h {
            h = way;
        }
        self.begin_stages()?;
        let mut refused = false;
        loop {
            if self.clock.now + h <= self.clock.now {
                let (time, index) = (self.clock.shown, self.worst);
                return Err(IntegrateError::Stalled { time, step: h, index });
            }
            let error = match self.attempt(h) {
                Ok(error) => error,
                Err(Failed::Ended(error)) => return Err(error),
                Err(Failed::Shorter) => {
                    self.fall_short()?;
                    (h, refused) = (SHORTER * h, true);
                    continue;
                }
            };
            let change = (HOPED * error.powf(-0.25)).clamp(CHANGE.0, CHANGE.1);
            self.short = 0;
            if error <= 1.0 {
                // a stop or a longest step that cuts a step short does not limit the next one
                let next = if refused { h * change.min(1.0) } else { h * change };
                self.hoped = Some(if h < hoped && !refused { next.max(hoped) } else { next });
                return Ok(h);
            }
            self.counts.error_test_failures += 1;
            (h, refused) = (h * change.min(HOPED), true);
        }
    }

    /// Counts a failed step. The third one in a row gives up symmetric values of
    /// the Jacobian, which leave out a part of it.
    fn fall_short(&mut self) -> Result<(), IntegrateError> {
        self.counts.newton_failures += 1;
        self.newton.stale = true;
        self.short += 1;
        if self.short < ATTEMPTS || !self.system.symmetric() || self.system.jacobian_is_constant() {
            return Ok(());
        }
        let time = self.clock.shown;
        self.system.leave_symmetry();
        self.counts.switched_to_lu = Some(time);
        let newton = Newton::new(self.system.pattern(), false, LinearSolver::Auto);
        self.newton = newton.map_err(|cause| linear_trouble(time, cause))?;
        Ok(())
    }
}
