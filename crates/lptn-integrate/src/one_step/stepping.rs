//! The one-step method as an integrator.

use super::{OneStep, SeriesStep};
use crate::clock::Clock;
use crate::linear::LinearSolverKind;
use crate::{IntegrateError, Integrator, OdeSystem, Statistics, Step, checks};

impl<S: OdeSystem> Integrator<S> for OneStep<S> {
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
        if let Err(error) = self.settle() {
            self.trouble = Some(error);
        }
        &mut self.system
    }

    fn set_stop(&mut self, t: f64) {
        self.clock.set_stop(t);
    }

    fn set_longest_step(&mut self, step: f64) {
        self.longest = step;
    }

    fn step(&mut self) -> Result<Step, IntegrateError> {
        if let Some(error) = self.trouble.take() {
            return Err(error);
        }
        if let Some(step) = self.clock.step_at_stop()? {
            return Ok(step);
        }
        let Clock { now, stop, shown, .. } = self.clock;
        if self.counts.steps >= self.max_steps {
            return Err(IntegrateError::TooManySteps { time: shown, steps: self.counts.steps });
        }
        let begun = match self.begun.filter(|begun| now < begun + self.series.length) {
            Some(begun) => begun,
            None => {
                self.begin_series()?;
                now
            }
        };
        let to = self.part_end(begun).min(stop);
        let mut state = std::mem::take(&mut self.state);
        self.state_at(to, &mut state);
        self.state = state;
        let (from, shown) = self.clock.step_to(to);
        Ok(Step { from, to: shown, at_stop: to >= stop, roots: false })
    }

    fn interpolate(&mut self, t: f64, y: &mut [f64]) -> Result<(), IntegrateError> {
        checks::expect_length("y", self.state.len(), y.len())?;
        let time = self.clock.within(t)?;
        if time >= self.clock.now {
            y.copy_from_slice(&self.state);
        } else {
            self.state_at(time, y);
        }
        Ok(())
    }

    fn restart(&mut self, y: Option<&[f64]>) -> Result<(), IntegrateError> {
        self.settle()?;
        if let Some(y) = y {
            checks::expect_length("y", self.state.len(), y.len())?;
            checks::state(y)?;
            self.state.copy_from_slice(y);
        }
        self.begin_anew();
        if y.is_some() {
            self.before = None;
        }
        Ok(())
    }

    fn rewind(&mut self, t: f64) -> Result<(), IntegrateError> {
        let time = self.clock.within(t)?;
        if time < self.clock.now {
            let mut state = std::mem::take(&mut self.state);
            self.state_at(time, &mut state);
            self.state = state;
            self.clock.begin_at(time, t);
            if let Some(begun) = self.begun {
                self.settled = begun;
                self.integrals.clone_from(&self.earlier);
            }
        }
        self.settle()?;
        self.begin_anew();
        Ok(())
    }

    fn root_directions(&self) -> &[i32] {
        &self.directions
    }

    fn quadratures(&mut self) -> Result<&[f64], IntegrateError> {
        self.settle()?;
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
            linear_setups: self.levels.asked,
            factorizations: self.levels.factorizations,
            linear_iterations: self.levels.iterations(),
            fill: self.levels.fill() as u64,
            ..self.counts
        }
    }

    fn series(&self) -> Option<SeriesStep<'_>> {
        self.present_series()
    }

    fn linear_solver(&self) -> LinearSolverKind {
        self.levels.kind()
    }
}
