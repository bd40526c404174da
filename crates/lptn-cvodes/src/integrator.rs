//! Stepping a system from one discontinuity to the next.

mod failure;
mod first;
mod roots;
mod running;
mod sensitivities;
mod times;

use roots::Roots;
use sensitivities::Sensitivities;
use times::Shown;

use crate::callback::Shared;
use crate::context::Context;
use crate::linear_solver::SolverHandles;
use crate::memory::{Counters, Flag, Memory, Reached};
use crate::shared::SharedBox;
use crate::start;
use crate::symmetry::{ATTEMPTS, SYMMETRIC_ATTEMPTS, Symmetry};
use crate::vector::Vector;
use lptn_integrate::{
    IntegrateError, Integrator, LinearSolverKind, OdeSystem, Options, Statistics, Step, checks,
    linear,
};

/// Steps in a row without progress after which the integration has stalled.
const STALLED: u32 = 50;

/// Integrates an [`OdeSystem`] with the variable-order BDF of CVODES.
pub struct Cvodes<S: OdeSystem> {
    // The order of the fields is the order in which SUNDIALS wants its objects freed.
    memory: Memory,
    handles: SolverHandles,
    state: Vector,
    scratch: Vector,
    quadratures: Option<Vector>,
    sensitivities: Sensitivities,
    context: Context,
    shared: SharedBox<S>,
    /// Origin of CVODES' time, which begins at 0: a step may be shorter than the spacing of doubles
    /// at a time far from 0.
    origin: f64,
    /// In CVODES' time.
    time: f64,
    /// Start of the last step; equal to `time` if there is none to interpolate in. In CVODES' time.
    from: f64,
    /// In CVODES' time.
    stop: f64,
    /// `time`, `from` and `stop` as the caller counts.
    shown: Shown,
    /// From now on no step is longer.
    longest: f64,
    max_steps: u64,
    /// Length of the first step after a start; 0 if CVODES is to guess it.
    first_step: f64,
    symmetry: Symmetry,
    roots: Roots,
    /// Totals of CVODES' counters at its last restart.
    before: Counters,
    restarts: u64,
    /// Steps in a row that did not move the time.
    still: u32,
}

impl<S: OdeSystem> Cvodes<S> {
    /// Takes the system at time `t0` in the state `y0` (one value per component, units of y).
    ///
    /// # Errors
    /// Lengths that do not match, options out of range, a state or a mass that is not usable, no
    /// memory.
    pub fn new(system: S, t0: f64, y0: &[f64], options: &Options) -> Result<Self, IntegrateError> {
        checks::options(t0, options)?;
        checks::system(&system, y0)?;
        checks::scales(&system, options)?;
        let context = Context::new()?;
        let mut state = Vector::new(&context, y0.len())?;
        state.as_mut_slice().copy_from_slice(y0);
        let scratch = Vector::new(&context, y0.len())?;
        let quadratures = match system.quadrature_count() {
            0 => None,
            count => Some(Vector::new(&context, count)?),
        };
        let sensitivities = Sensitivities::new(&context, &system)?;
        let symmetry = Symmetry::of(&system, options.linear_solver);
        let roots = Roots::new(system.root_count());
        let shared = SharedBox::new(start::shared(system, t0, options)?);
        let handles = SolverHandles::new(&context, shared.as_ptr())?;
        let memory = Memory::new(&context)?;
        let mut integrator = Self {
            memory,
            handles,
            state,
            scratch,
            quadratures,
            sensitivities,
            context,
            shared,
            origin: t0,
            time: 0.0,
            from: 0.0,
            stop: f64::INFINITY,
            shown: Shown { time: t0, from: t0, stop: f64::INFINITY },
            longest: options.max_step_size.unwrap_or(f64::INFINITY),
            max_steps: u64::try_from(options.max_steps).unwrap_or(u64::MAX),
            first_step: options.initial_step.unwrap_or(0.0),
            symmetry,
            roots,
            before: Counters::default(),
            restarts: 0,
            still: 0,
        };
        integrator.set_up(options).map_err(|flag| integrator.unexpected(flag))?;
        Ok(integrator)
    }

    fn set_up(&mut self, options: &Options) -> Result<(), Flag> {
        let pointer = self.shared.as_ptr();
        self.memory.start((self.time, &self.state), pointer)?;
        self.memory.attach_solver::<S>(&self.handles)?;
        if let Some(quadratures) = &self.quadratures {
            self.memory.start_quadratures::<S>(quadratures, options.integrals)?;
        }
        self.start_sensitivities(options)?;
        self.start_roots()?;
        if let Some(step) = options.initial_step {
            self.memory.set_initial_step(step)?;
        }
        if self.symmetry.is_held() {
            self.memory.set_attempts(SYMMETRIC_ATTEMPTS)?;
        }
        self.choose_newton(options)
    }

    fn choose_newton(&self, options: &Options) -> Result<(), Flag> {
        if self.system().jacobian_is_constant() {
            self.memory.always_match_gamma()?;
        } else if linear::is_dense(options.linear_solver, self.system().pattern().size()) {
            self.memory.always_set_up()?;
        }
        self.memory.set_newton_coefficient(start::newton_coefficient(self.system(), options))
    }

    /// Ends the integration and hands the system back.
    pub fn into_system(self) -> S {
        let Self { memory, handles, shared, .. } = self;
        drop((memory, handles));
        shared.into_inner().system
    }

    /// One step of CVODES.
    fn advance(&mut self) -> Result<Reached, Flag> {
        self.shared.get_mut().failure = None;
        self.leave_rest()?;
        // Version 6 cannot forget a stop time; the largest double serves as none. It is set for
        // every step because CVODES forgets it when it is reached and keeps it at a restart.
        let stop = self.held_stop().min(f64::MAX);
        let towards =
            if self.stop.is_finite() { self.stop } else { self.time + self.time.abs().max(1.0) };
        self.memory.set_stop(stop)?;
        self.memory.set_max_step(if self.longest.is_finite() { self.longest } else { 0.0 })?;
        let reached = self.take_step(towards);
        if self.roots.are_none() { reached } else { self.look_for_roots(towards, reached) }
    }

    /// Goes on from the last good state with LU; returns false if that is not possible.
    fn leave_symmetry(&mut self) -> bool {
        let choice = self.symmetry.leave();
        let Ok(factors) = linear::new(self.system().pattern(), false, choice) else { return false };
        self.shared.get_mut().leave_symmetry(factors);
        self.symmetry.set_switched(self.shown.time);
        self.read_running().is_ok()
            && self.begin_anew().and_then(|()| self.memory.set_attempts(ATTEMPTS)).is_ok()
    }

    /// Fails after `STALLED` steps that are lost in the rounding of the time: CVODES would go on.
    fn watch_progress(&mut self, moved: bool) -> Result<(), IntegrateError> {
        if moved {
            self.still = 0;
            self.shared.get_mut().overcome = None;
            return Ok(());
        }
        self.still += 1;
        if self.still < STALLED {
            return Ok(());
        }
        self.still = 0;
        let (time, step) = (self.shown.time, self.memory.counters().current_step);
        match self.shared.get_mut().overcome.take() {
            Some(failure) => Err(failure.into_error()),
            None => Err(IntegrateError::Stalled { time, step, index: self.worst() }),
        }
    }

    fn step_at_stop(&self) -> Result<Step, IntegrateError> {
        let Shown { time, stop, .. } = self.shown;
        if stop < time {
            return Err(IntegrateError::StopBehind { time, stop });
        }
        if stop.is_nan() {
            return Err(IntegrateError::InvalidOption { option: "stop", value: stop });
        }
        Ok(Step { from: time, to: stop, at_stop: true, roots: false })
    }

    fn restart_here(&mut self) -> Result<(), IntegrateError> {
        self.restarts += 1;
        self.shared.get_mut().jacobian_is_current = false;
        self.begin_anew().map_err(|flag| self.unexpected(flag))
    }

    /// Restarts CVODES from the present state with the running integrals and the sensitivities read
    /// last.
    fn begin_anew(&mut self) -> Result<(), Flag> {
        let now = self.memory.counters();
        self.before = sum(&self.before, &now);
        self.from = self.time;
        self.shown.from = self.shown.time;
        self.memory_at(self.time)
    }
}

impl<S: OdeSystem> Integrator<S> for Cvodes<S> {
    fn time(&self) -> f64 {
        self.shown.time
    }

    fn state(&self) -> &[f64] {
        self.state.as_slice()
    }

    fn system(&self) -> &S {
        &self.shared.get().system
    }

    fn system_mut(&mut self) -> &mut S {
        &mut self.shared.get_mut().system
    }

    fn set_stop(&mut self, t: f64) {
        self.stop = t - self.origin;
        self.shown.stop = t;
    }

    fn set_longest_step(&mut self, step: f64) {
        self.longest = step;
    }

    fn step(&mut self) -> Result<Step, IntegrateError> {
        let from = self.time;
        if self.stop <= from || self.stop.is_nan() || self.starts_at_stop() {
            return self.step_at_stop();
        }
        let so_far = self.statistics();
        if so_far.steps >= self.max_steps {
            return Err(IntegrateError::TooManySteps {
                time: self.shown.time,
                steps: so_far.steps,
            });
        }
        if self.symmetry.stalls(&so_far) {
            self.leave_symmetry();
        }
        let mut outcome = self.advance();
        if let Err(flag) = &outcome
            && self.symmetry.is_to_blame(flag)
            && self.leave_symmetry()
        {
            outcome = self.advance();
        }
        let to = self.time;
        self.shown.from = self.shown.time;
        self.show();
        match outcome {
            Ok(_) => {
                self.from = from;
                self.watch_progress(to > from)?;
                let Shown { from, time, .. } = self.shown;
                Ok(Step { from, to: time, at_stop: to >= self.stop, roots: self.roots.met() })
            }
            Err(flag) => {
                self.from = to;
                self.shown.from = self.shown.time;
                Err(self.explain(flag))
            }
        }
    }

    fn interpolate(&mut self, t: f64, y: &mut [f64]) -> Result<(), IntegrateError> {
        checks::expect_length("y", self.state.as_slice().len(), y.len())?;
        let t = self.within(t)?;
        if t >= self.time {
            y.copy_from_slice(self.state.as_slice());
            return Ok(());
        }
        self.memory.interpolate(t, &mut self.scratch).map_err(|flag| self.unexpected(flag))?;
        y.copy_from_slice(self.scratch.as_slice());
        Ok(())
    }

    fn restart(&mut self, y: Option<&[f64]>) -> Result<(), IntegrateError> {
        self.read_running().map_err(|flag| self.unexpected(flag))?;
        if let Some(y) = y {
            checks::expect_length("y", self.state.as_slice().len(), y.len())?;
            checks::state(y)?;
            self.state.as_mut_slice().copy_from_slice(y);
        }
        self.restart_here()
    }

    fn rewind(&mut self, t: f64) -> Result<(), IntegrateError> {
        let back = self.within(t)?;
        let read = if back < self.time { self.read_at(back) } else { self.read_running() };
        read.map_err(|flag| self.unexpected(flag))?;
        (self.time, self.shown.time) = (back, t);
        self.restart_here()
    }

    fn root_directions(&self) -> &[i32] {
        &self.roots.directions
    }

    fn quadratures(&mut self) -> Result<&[f64], IntegrateError> {
        self.read_quadratures().map_err(|flag| self.unexpected(flag))?;
        Ok(self.quadratures.as_ref().map_or(&[], Vector::as_slice))
    }

    fn sensitivities(&mut self) -> Result<&[f64], IntegrateError> {
        self.read_sensitivities().map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.copy_to(&mut self.sensitivities.blocks);
        Ok(&self.sensitivities.blocks)
    }

    fn set_sensitivities(&mut self, s: &[f64]) -> Result<(), IntegrateError> {
        checks::expect_length("sensitivities", self.sensitivities.blocks.len(), s.len())?;
        checks::state(s)?;
        let is_new = self.memory.counters().steps == 0;
        self.read_quadratures().map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.set(s);
        if is_new {
            self.begin_anew().map_err(|flag| self.unexpected(flag))
        } else {
            self.restart_here()
        }
    }

    fn interpolate_sensitivities(&mut self, t: f64, s: &mut [f64]) -> Result<(), IntegrateError> {
        checks::expect_length("sensitivities", self.sensitivities.blocks.len(), s.len())?;
        let t = self.within(t)?;
        let read =
            if t < self.time { self.read_sensitivities_at(t) } else { self.read_sensitivities() };
        read.map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.copy_to(s);
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        let total = sum(&self.before, &self.memory.counters());
        let Shared { counts, factors, .. } = self.shared.get();
        Statistics {
            steps: total.steps,
            flow_evaluations: counts.flow,
            jacobian_evaluations: counts.jacobian,
            quadrature_evaluations: counts.quadrature,
            sensitivity_evaluations: counts.sensitivity,
            linear_setups: counts.setups,
            factorizations: counts.factorizations,
            linear_solves: counts.solves,
            linear_iterations: counts.iterations + factors.iterations(),
            fill: factors.fill() as u64,
            newton_iterations: total.newton_iterations,
            error_test_failures: total.error_test_failures,
            newton_failures: total.newton_failures,
            restarts: self.restarts,
            switched_to_lu: self.symmetry.switched(),
            last_order: total.last_order,
            last_step: total.last_step,
        }
    }

    fn linear_solver(&self) -> LinearSolverKind {
        self.shared.get().factors.kind()
    }
}

/// Totals of the counters, last values of the rest.
fn sum(before: &Counters, now: &Counters) -> Counters {
    let stepped = now.steps > 0;
    Counters {
        steps: before.steps + now.steps,
        error_test_failures: before.error_test_failures + now.error_test_failures,
        newton_iterations: before.newton_iterations + now.newton_iterations,
        newton_failures: before.newton_failures + now.newton_failures,
        last_order: if stepped { now.last_order } else { before.last_order },
        last_step: if stepped { now.last_step } else { before.last_step },
        current_step: now.current_step,
    }
}
