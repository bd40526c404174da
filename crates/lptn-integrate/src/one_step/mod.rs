//! An integrator for linear systems with constant coefficients.
//!
//! BDF methods factorise a matrix whenever their step changes, some hundred times in a run, and
//! restart with tiny steps after every event. Here a step is a series whose terms all take one
//! solve with the same matrix ([`series`]). Its size is a power of four, so that some ten factors
//! serve a whole run with all its events ([`levels`]). The number of terms, and with it the order,
//! follows the tolerance, up to order 11 ([`attempt`]). The time of an event need not be the end of
//! a step: a step reaches beyond it as if the inputs went on, and the part after the event is not
//! used.
//!
//! The method replaces ARKODE. SDIRK of order 4, which ARKODE offers, takes twice as many solves at
//! 1e-4 of the range, and 2.5 times as many at 1e-6. Its stages are not needed for a linear right
//! side. One flow and one quadrature serve a step, because state, dense output and energy balance
//! are weighted sums of the same terms. Powers of four take half as many factors as powers of two,
//! for as many solves.
//!
//! A step is handed out in parts of four terms. Limits, windows and events then see curves as
//! smooth as those of CVODE.

mod attempt;
mod beyond;
mod first;
mod levels;
mod series;
mod spread;
mod stepping;

use crate::calls::{flow_at, linear_trouble, refused};
use crate::clock::Clock;
use crate::linear;
use crate::{
    Callback, FactorError, IntegrateError, OdeSystem, Options, Statistics, checks, kernels,
};
pub use beyond::SeriesStep;

use attempt::{Body, Drive, Outcome, Series};
use first::Jump;
use levels::{Levels, level_within, step_of};
use series::POLE;

/// Terms of a step for each part that is handed out: between two samples a polynomial of that
/// degree hides no more than a step of a multistep method.
const TERMS_OF_PART: usize = 4;

/// The rounding of a number times the largest expected difference of states: the effect, in units
/// of y, of the rounding of a coefficient on one that is as large.
const ROUNDED: f64 = f64::EPSILON * 1000.0;

/// Least time to the second evaluation of the flow if no stop is set, in units of t.
const LATER: f64 = 1.0;

/// Integrates `M y' = q(t) + J y` with a constant `J` and inputs `q` that are straight lines in
/// time between two starts: [`crate::Integrator::restart`] is due when one of them jumps or has a
/// kink.
///
/// There are no sensitivities and no roots: steps do not end at events. To find an event, use
/// [`crate::Integrator::interpolate`] and [`crate::Integrator::rewind`].
pub struct OneStep<S> {
    system: S,
    clock: Clock,
    state: Vec<f64>,
    tolerance: f64,
    max_steps: u64,
    longest: f64,
    levels: Levels,
    /// The level of the next step.
    level: i32,
    jacobian: Vec<f64>,
    /// Decrease of the flow of each row if all components rise by 1.
    loss: Vec<f64>,
    /// The flow at the start of the step, and its change per time at a constant state.
    flow: Vec<f64>,
    slope: Vec<f64>,
    /// True if the system may have changed since it was read.
    is_new: bool,
    /// The flow just before the last restart; its change per time is still in `slope`.
    before: Option<Jump>,
    series: Series,
    /// Start of the series; none between a start and the first step.
    begun: Option<f64>,
    /// The running integrals when the series began, and at `settled`.
    earlier: Vec<f64>,
    integrals: Vec<f64>,
    settled: f64,
    trouble: Option<IntegrateError>,
    directions: Vec<i32>,
    counts: Statistics,
}

impl<S: OdeSystem> OneStep<S> {
    /// True if a system can be integrated, apart from its inputs: linear with constant
    /// coefficients, without algebraic unknowns and sensitivities, and with no coefficient so large
    /// that its rounding changes the effect of others by more than the tolerance. `at` is a time
    /// and a state of the system.
    pub fn suits(system: &mut S, at: (f64, &[f64]), tolerance: f64) -> bool {
        system.jacobian_is_constant()
            && system.slope().is_none()
            && system.pattern().size() == system.size()
            && system.sensitivity_count() == 0
            && spread::of(system, at).is_some_and(|spread| spread * ROUNDED < tolerance)
    }

    /// Takes the system at time `t0` in the state `y0` (one value per component, units of y).
    ///
    /// # Errors
    /// Lengths that do not match, options out of range, a state or a mass that is not usable, no
    /// memory.
    pub fn new(system: S, t0: f64, y0: &[f64], options: &Options) -> Result<Self, IntegrateError> {
        checks::options(t0, options)?;
        checks::system(&system, y0)?;
        let analysed =
            linear::for_stages(system.pattern(), system.symmetric(), options.linear_solver);
        let analysed = analysed.map_err(|cause| linear_trouble(t0, cause))?;
        let integrals = vec![0.0; system.quadrature_count()];
        Ok(Self {
            clock: Clock::new(t0),
            state: y0.to_vec(),
            tolerance: options.tolerance,
            max_steps: u64::try_from(options.max_steps).unwrap_or(u64::MAX),
            longest: options.max_step_size.unwrap_or(f64::INFINITY),
            levels: Levels::new(analysed),
            level: level_within(options.initial_step.unwrap_or(f64::MAX)),
            jacobian: vec![0.0; system.pattern().len()],
            loss: Vec::new(),
            flow: vec![0.0; y0.len()],
            slope: vec![0.0; y0.len()],
            is_new: true,
            before: None,
            series: Series::default(),
            begun: None,
            earlier: integrals.clone(),
            integrals,
            settled: 0.0,
            trouble: None,
            directions: vec![0; system.root_count()],
            counts: Statistics::default(),
            system,
        })
    }

    /// Ends the integration and hands the system back.
    pub fn into_system(self) -> S {
        self.system
    }

    /// Computes the series that begins here.
    fn begin_series(&mut self) -> Result<(), IntegrateError> {
        self.settle()?;
        self.earlier.clone_from(&self.integrals);
        let time = self.clock.shown;
        flow_at(&mut self.system, &mut self.counts, (time, &self.state), &mut self.flow)?;
        if self.is_new {
            self.read_system(time)?;
            self.is_new = false;
        }
        self.hold_level();
        self.series.begin(&self.state);
        loop {
            let h = step_of(self.level);
            if self.clock.now + h <= self.clock.now {
                let index = self.series.worst();
                return Err(IntegrateError::Stalled { time, step: h, index });
            }
            if self.attempt(time)? {
                self.begun = Some(self.clock.now);
                return Ok(());
            }
        }
    }

    /// Tries a step of the present level; sets the level of the next one.
    fn attempt(&mut self, time: f64) -> Result<bool, IntegrateError> {
        let outcome = self.factorize(time)?.and_then(|()| {
            let body = Body { mass: self.system.mass(), loss: &self.loss };
            let drive = Drive { flow: &self.flow, slope: &self.slope };
            let at = (&mut self.levels, self.level);
            let outcome = self.series.attempt(at, &body, &drive, self.tolerance);
            self.counts.linear_solves += self.series.count as u64;
            outcome
        });
        if let Err(FactorError::NotPositiveDefinite { .. } | FactorError::Singular { .. }) = outcome
        {
            // in a long step a small mass is lost in the rounding
            self.counts.error_test_failures += 1;
            self.level -= 1;
            return Ok(false);
        }
        match outcome.map_err(|cause| linear_trouble(time, cause))? {
            Outcome::Accepted(forecast) => {
                self.counts.steps += 1;
                self.counts.last_order = self.series.count as u32 - 1;
                self.counts.last_step = self.series.length;
                self.level += forecast.rise();
                Ok(true)
            }
            Outcome::Rejected(forecast) => {
                self.counts.error_test_failures += 1;
                self.level -= forecast.fall();
                Ok(false)
            }
        }
    }

    /// Factorises the matrix `M - g h J` of the present level, unless that is done.
    fn factorize(&mut self, time: f64) -> Result<Result<(), FactorError>, IntegrateError> {
        if self.levels.are_ready(self.level) {
            return Ok(Ok(()));
        }
        let length = POLE * step_of(self.level);
        // the Jacobian becomes the matrix and is read again: a copy would be the longest of all
        // vectors
        let mut values = std::mem::take(&mut self.jacobian);
        kernels::map_in_place(&mut values, |j| -length * j);
        let rows = self.system.mass().iter().zip(self.system.pattern().diagonal());
        rows.for_each(|(m, &slot)| values[slot] += m);
        let made = self.levels.make(self.level, &values);
        self.jacobian = values;
        self.read_entries(time)?;
        Ok(made)
    }

    /// Reads the data of the system for the series, and chooses the first level.
    fn read_system(&mut self, time: f64) -> Result<(), IntegrateError> {
        self.read_jacobian(time)?;
        let then = match self.clock.shown_stop {
            stop if stop.is_finite() => stop,
            _ => time + time.abs().max(LATER),
        };
        let last = std::mem::take(&mut self.slope);
        self.slope = vec![0.0; self.state.len()];
        flow_at(&mut self.system, &mut self.counts, (then, &self.state), &mut self.slope)?;
        let way = then - time;
        kernels::zip_in_place(&mut self.slope, &self.flow, |then, now| (then - now) / way);
        let jump = match self.before.take() {
            Some(Jump { flow, .. }) => Jump { flow, slope: last },
            None => Jump { flow: vec![0.0; last.len()], slope: vec![0.0; last.len()] },
        };
        let diagonal = self.system.pattern().diagonal().iter().map(|&slot| self.jacobian[slot]);
        let longest = jump
            .to(&self.flow, &self.slope)
            .longest(self.system.mass().iter().copied().zip(diagonal), self.tolerance);
        self.level = self.level.min(level_within(longest));
        Ok(())
    }

    /// Reads the Jacobian; the factors are kept if it is the same.
    fn read_jacobian(&mut self, time: f64) -> Result<(), IntegrateError> {
        let before = self.jacobian.clone();
        self.counts.jacobian_evaluations += 1;
        self.read_entries(time)?;
        if let Some(index) = kernels::first_not_finite(&self.jacobian) {
            return Err(IntegrateError::NotFinite { callback: Callback::Jacobian, time, index });
        }
        if self.loss.is_empty() || before != self.jacobian {
            self.levels.clear();
            self.counts.flow_evaluations += 2;
            self.loss = spread::loss(&mut self.system, time)
                .map_err(|retry| refused(Callback::Flow, time, retry))?;
        }
        Ok(())
    }

    fn read_entries(&mut self, time: f64) -> Result<(), IntegrateError> {
        let read = self.system.jacobian(time, &self.state, &mut self.jacobian);
        read.map_err(|retry| refused(Callback::Jacobian, time, retry))
    }

    /// No step is longer than the longest, and none reaches four times as far as the stop.
    fn hold_level(&mut self) {
        let way = self.clock.stop - self.clock.now;
        if way.is_finite() {
            let within = level_within(way);
            self.level = self.level.min(within + i32::from(step_of(within) < way));
        }
        self.level = self.level.min(level_within(self.longest));
    }

    /// The share of the series at a time.
    fn share(&self, begun: f64, time: f64) -> f64 {
        ((time - begun) / self.series.length).min(1.0)
    }

    /// The end of the part that begins here.
    fn part_end(&self, begun: f64) -> f64 {
        let parts = self.series.count.div_ceil(TERMS_OF_PART);
        let end = |part: usize| match part == parts {
            true => begun + self.series.length,
            false => begun + self.series.length * (part as f64 / parts as f64),
        };
        (1..parts).map(end).find(|&end| end > self.clock.now).unwrap_or_else(|| end(parts))
    }

    fn state_at(&self, time: f64, y: &mut [f64]) {
        let Some(begun) = self.begun else { return y.copy_from_slice(&self.state) };
        let share = self.share(begun, time);
        self.series.add_up(&series::change(self.series.count, share), y);
    }

    /// Brings the running integrals to the present time, as needed before the system is changed.
    fn settle(&mut self) -> Result<(), IntegrateError> {
        let Some(begun) = self.begun.filter(|_| self.settled < self.clock.now) else {
            return Ok(());
        };
        if self.integrals.is_empty() {
            self.settled = self.clock.now;
            return Ok(());
        }
        let (now, way) = (self.clock.now, self.clock.now - begun);
        let mut mean = vec![0.0; self.state.len()];
        let share = self.share(begun, now);
        self.series.add_up(&series::mean(self.series.count, share), &mut mean);
        let time = self.clock.shown_of(begun + 0.5 * way);
        self.counts.quadrature_evaluations += 1;
        let integrands = self.system.quadrature(time, &mean, &mut self.integrals);
        integrands.map_err(|retry| refused(Callback::Quadrature, time, retry))?;
        if let Some(index) = kernels::first_not_finite(&self.integrals) {
            return Err(IntegrateError::NotFinite { callback: Callback::Quadrature, time, index });
        }
        kernels::zip_in_place(&mut self.integrals, &self.earlier, |q, sum| sum + way * q);
        self.settled = now;
        Ok(())
    }

    /// Restarts here, after `settle`.
    fn begin_anew(&mut self) {
        if let Some(begun) = self.begun.take() {
            let share = self.share(begun, self.clock.now);
            let mut flow = vec![0.0; self.state.len()];
            self.series.add_terms(&series::rate(self.series.count, share), &mut flow);
            let length = self.series.length;
            kernels::zip_in_place(&mut flow, self.system.mass(), |rate, m| rate * m / length);
            self.before = Some(Jump { flow, slope: Vec::new() });
        }
        self.counts.restarts += 1;
        self.clock.begin();
        self.is_new = true;
    }
}
