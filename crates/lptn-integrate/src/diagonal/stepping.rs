//! The method as an integrator.

use super::Esdirk;
use super::attempt::UNWEIGHTED;
use super::tableau::{B, C, STAGES, weights};
use crate::linear::LinearSolverKind;
use crate::{IntegrateError, Integrator, OdeSystem, Statistics, Step, checks, kernels};

impl<S: OdeSystem> Esdirk<S> {
    /// The state at this share of the last step.
    fn state_at(&self, share: f64, y: &mut [f64]) {
        let Some(length) = self.length else { return y.copy_from_slice(&self.state) };
        y.copy_from_slice(&self.stages.begin);
        for (weight, rate) in weights(share).iter().zip(&self.stages.rate) {
            kernels::scale_and_add(1.0, y, length * weight, rate);
        }
    }

    /// The running integrals after these parts of the stages of a step.
    fn gather(&mut self, weights: &[f64; STAGES], length: f64) {
        self.integrals.clone_from(&self.stages.integrals);
        for (weight, q) in weights.iter().zip(&self.stages.integrands) {
            kernels::scale_and_add(1.0, &mut self.integrals, length * weight, q);
        }
    }

    /// The share of the last step at a time since the start.
    fn share(&self, time: f64) -> f64 {
        let length = self.length.unwrap_or(f64::INFINITY);
        (1.0 - (self.clock.now - time) / length).clamp(0.0, 1.0)
    }

    fn begin_anew(&mut self) {
        self.length = None;
        self.stages.follows = false;
        self.newton.doubt();
        self.counts.restarts += 1;
        self.clock.begin();
    }
}

impl<S: OdeSystem> Integrator<S> for Esdirk<S> {
    fn time(&self) -> f64 {
        self.clock.shown
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn system(&self) -> &S {
        &self.system
    }

    fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    fn set_stop(&mut self, t: f64) {
        self.clock.set_stop(t);
    }

    fn set_longest_step(&mut self, step: f64) {
        self.longest = step;
    }

    fn step(&mut self) -> Result<Step, IntegrateError> {
        if let Some(step) = self.clock.step_at_stop()? {
            return Ok(step);
        }
        if self.counts.steps >= self.max_steps {
            let (time, steps) = (self.clock.shown, self.counts.steps);
            return Err(IntegrateError::TooManySteps { time, steps });
        }
        let length = self.find_step()?;
        self.state.clone_from(&self.stages.y[STAGES - 1]);
        self.gather(&B, length);
        self.stages.follows = true;
        self.length = Some(length);
        let to = match self.clock.now + length {
            to if to >= self.clock.stop - 1e-6 * length => self.clock.stop,
            to => to,
        };
        self.counts.steps += 1;
        (self.counts.last_step, self.counts.last_order) = (length, 4);
        let (from, shown) = self.clock.step_to(to);
        Ok(Step { from, to: shown, at_stop: to >= self.clock.stop, roots: false })
    }

    fn interpolate(&mut self, t: f64, y: &mut [f64]) -> Result<(), IntegrateError> {
        checks::expect_length("y", self.state.len(), y.len())?;
        let time = self.clock.within(t)?;
        if time >= self.clock.now {
            y.copy_from_slice(&self.state);
        } else {
            self.state_at(self.share(time), y);
        }
        Ok(())
    }

    fn restart(&mut self, y: Option<&[f64]>) -> Result<(), IntegrateError> {
        if let Some(y) = y {
            checks::expect_length("y", self.state.len(), y.len())?;
            checks::state(y)?;
            self.state.copy_from_slice(y);
        }
        self.begin_anew();
        Ok(())
    }

    fn rewind(&mut self, t: f64) -> Result<(), IntegrateError> {
        let time = self.clock.within(t)?;
        if let Some(length) = self.length.filter(|_| time < self.clock.now) {
            let share = self.share(time);
            let begin = self.clock.now - length;
            let at = self.clock.shown_of(begin + C[UNWEIGHTED] * length);
            self.read_integrands(UNWEIGHTED, at)?;
            let mut state = std::mem::take(&mut self.state);
            self.state_at(share, &mut state);
            self.state = state;
            self.gather(&weights(share), length);
            self.clock.begin_at(time, t);
        }
        self.begin_anew();
        Ok(())
    }

    fn root_directions(&self) -> &[i32] {
        &self.directions
    }

    fn quadratures(&mut self) -> Result<&[f64], IntegrateError> {
        Ok(&self.integrals)
    }

    fn sensitivities(&mut self) -> Result<&[f64], IntegrateError> {
        Ok(&[])
    }

    fn set_sensitivities(&mut self, s: &[f64]) -> Result<(), IntegrateError> {
        checks::expect_length("sensitivities", 0, s.len())
    }

    fn interpolate_sensitivities(&mut self, t: f64, s: &mut [f64]) -> Result<(), IntegrateError> {
        checks::expect_length("sensitivities", 0, s.len())?;
        self.clock.within(t).map(|_| ())
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            linear_setups: self.newton.factorizations,
            factorizations: self.newton.factorizations,
            linear_solves: self.newton.solves,
            linear_iterations: self.newton.solver.iterations(),
            fill: self.newton.solver.fill() as u64,
            ..self.counts
        }
    }

    fn linear_solver(&self) -> LinearSolverKind {
        self.newton.solver.kind()
    }
}
