//! One try of a step.

use super::newton::{Progress, size_of};
use super::tableau::{A, C, ERROR, GAMMA, STAGES, inside};
use super::{Esdirk, Failed};
use crate::calls::{flow_at, linear_trouble, refused};
use crate::{Callback, FactorError, IntegrateError, OdeSystem, Retry, kernels};

/// The share of the tolerance that the error of a step may have; CVODE takes a third as well.
const SHARE: f64 = 1.0 / 3.0;

/// The share of the tolerance that the error of Newton's method may have.
const LEFT: f64 = 1e-6;

/// Rounding errors of a state that Newton's method cannot go below.
const ROUNDINGS: f64 = 8.0;

/// Two earlier stages whose times are near that of each.
const NEAR: [(usize, usize); STAGES] = [(0, 0), (0, 0), (0, 1), (2, 1), (1, 3), (3, 4)];

/// The stage whose weight in a step is zero: its integrands are needed inside a step only.
pub(super) const UNWEIGHTED: usize = 1;

impl<S: OdeSystem> Esdirk<S> {
    /// Takes the present state as the first stage.
    pub(super) fn begin_stages(&mut self) -> Result<(), IntegrateError> {
        let Self { stages, counts, system, clock, .. } = self;
        stages.begin.clone_from(&self.state);
        stages.integrals.clone_from(&self.integrals);
        stages.y[0].clone_from(&self.state);
        self.newton.fresh = false;
        if stages.follows {
            stages.rate.swap(0, STAGES - 1);
            stages.integrands.swap(0, STAGES - 1);
            return Ok(());
        }
        let (first, time) = (&mut stages.rate[0], clock.shown);
        flow_at(system, counts, (time, &self.state), first)?;
        kernels::zip_in_place(first, system.mass(), |flow, mass| flow / mass);
        self.read_integrands(0, time)
    }

    /// Tries a step of this length; returns its error over the one allowed. The error is not damped
    /// by the matrix of the stages: a stiff state that follows its input is right at the end of any
    /// step, but not inside a long one.
    pub(super) fn attempt(&mut self, h: f64) -> Result<f64, Failed> {
        self.prepare(h)?;
        for stage in 1..STAGES {
            self.solve_stage(stage, h)?;
        }
        let at_end = self.sum(&ERROR, h);
        self.worst = largest(&at_end);
        let at_end = size_of(&at_end) / (SHARE * self.tolerance);
        let inside = size_of(&self.sum(&inside(), h)) / self.tolerance;
        Ok(at_end.max(inside).max(self.error_of_integrals(h)))
    }

    /// The sum of the stages' rates with these weights, in units of y.
    fn sum(&self, weights: &[f64; STAGES], h: f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.state.len()];
        for (weight, rate) in weights.iter().zip(&self.stages.rate) {
            kernels::scale_and_add(1.0, &mut sum, h * weight, rate);
        }
        sum
    }

    fn error_of_integrals(&self, h: f64) -> f64 {
        let stages = &self.stages;
        let of = |k: usize| {
            let weighted = ERROR.iter().zip(&stages.integrands);
            let error = h * weighted.map(|(w, q)| w * q[k]).sum::<f64>();
            let allowed = self.allowance.share * stages.integrals[k].abs() + self.allowance.amount;
            error.abs() / allowed
        };
        (0..self.integrals.len()).map(of).fold(0.0, f64::max)
    }

    /// Reads the Jacobian if needed, and factorises the matrix.
    fn prepare(&mut self, h: f64) -> Result<(), Failed> {
        let time = self.clock.shown;
        if self.newton.stale && !self.newton.fresh {
            self.counts.jacobian_evaluations += 1;
            let values = &mut self.newton.jacobian;
            let read = self.system.jacobian(time, &self.state, values);
            read.map_err(|retry| Failed::of(retry, (Callback::Jacobian, time)))?;
            if let Some(index) = kernels::first_not_finite(&self.newton.jacobian) {
                let callback = Callback::Jacobian;
                return Err(Failed::Ended(IntegrateError::NotFinite { callback, time, index }));
            }
            self.newton.renew();
        }
        let made = self.newton.factorize(&self.system, GAMMA * h);
        made.map_err(|cause| self.trouble(cause))
    }

    /// Solves `M (y - base) = gamma h f(t, y)` for one stage.
    fn solve_stage(&mut self, stage: usize, h: f64) -> Result<(), Failed> {
        let g = GAMMA * h;
        let rounding = ROUNDINGS * f64::EPSILON * size_of(&self.stages.begin);
        let allowed = (LEFT * self.tolerance).max(rounding);
        let time = self.clock.shown_of(self.clock.now + C[stage] * h);
        let mut base = std::mem::take(&mut self.stages.work);
        base.clone_from(&self.stages.begin);
        for (weight, rate) in A[stage].iter().zip(&self.stages.rate) {
            kernels::scale_and_add(1.0, &mut base, h * weight, rate);
        }
        let mut y = std::mem::take(&mut self.stages.y[stage]);
        y.clone_from(&base);
        for (from, weight) in guess(stage) {
            kernels::scale_and_add(1.0, &mut y, g * weight, &self.stages.rate[from]);
        }
        let found = self.iterate((time, g), (&base, &mut y), allowed);
        kernels::zip(&y, &base, &mut self.stages.rate[stage], |y, base| (y - base) / g);
        (self.stages.y[stage], self.stages.work) = (y, base);
        found?;
        if stage != UNWEIGHTED {
            self.read_integrands(stage, time).map_err(Failed::of_callback)?;
        }
        Ok(())
    }

    fn iterate(
        &mut self,
        (time, g): (f64, f64),
        (base, y): (&[f64], &mut [f64]),
        allowed: f64,
    ) -> Result<(), Failed> {
        let mut change = vec![0.0; y.len()];
        let mut before = None;
        for iteration in 0.. {
            let flow = flow_at(&mut self.system, &mut self.counts, (time, y), &mut change);
            flow.map_err(Failed::of_callback)?;
            let given = self.system.mass().iter().zip(base).zip(&*y);
            for (change, ((mass, base), y)) in change.iter_mut().zip(given) {
                *change = mass * (base - y) + g * *change;
            }
            self.counts.newton_iterations += 1;
            self.newton.solve(&mut change).map_err(|cause| self.trouble(cause))?;
            kernels::scale_and_add(1.0, y, 1.0, &change);
            let size = size_of(&change);
            match self.newton.judge((iteration, size, before), allowed) {
                Progress::Found => break,
                Progress::On => before = Some(size),
                Progress::Lost => {
                    self.worst = largest(&change);
                    return Err(Failed::Shorter);
                }
            }
        }
        Ok(())
    }

    /// Writes the integrands of a stage at its time.
    pub(super) fn read_integrands(
        &mut self,
        stage: usize,
        time: f64,
    ) -> Result<(), IntegrateError> {
        if self.integrals.is_empty() {
            return Ok(());
        }
        self.counts.quadrature_evaluations += 1;
        let (y, q) = (&self.stages.y[stage], &mut self.stages.integrands[stage]);
        let callback = Callback::Quadrature;
        self.system.quadrature(time, y, q).map_err(|retry| refused(callback, time, retry))?;
        match kernels::first_not_finite(q) {
            Some(index) => Err(IntegrateError::NotFinite { callback, time, index }),
            None => Ok(()),
        }
    }

    /// A matrix that cannot be used: a shorter step has a better one.
    fn trouble(&self, cause: FactorError) -> Failed {
        match cause {
            FactorError::NotPositiveDefinite { .. } | FactorError::Singular { .. } => {
                Failed::Shorter
            }
            cause => Failed::Ended(linear_trouble(self.clock.shown, cause)),
        }
    }
}

/// The component that is largest.
fn largest(values: &[f64]) -> usize {
    let sizes = values.iter().map(|value| value.abs()).enumerate();
    sizes.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}

/// The rate of a stage as a sum of earlier ones: on the straight line through two of them.
fn guess(stage: usize) -> [(usize, f64); 2] {
    let (a, b) = NEAR[stage];
    let share = if a == b { 0.0 } else { (C[stage] - C[a]) / (C[b] - C[a]) };
    [(a, 1.0 - share), (b, share)]
}

impl Failed {
    fn of(retry: Retry, (callback, time): (Callback, f64)) -> Self {
        match retry {
            Retry::SmallerStep => Self::Shorter,
            Retry::Stop => Self::Ended(refused(callback, time, retry)),
        }
    }

    fn of_callback(error: IntegrateError) -> Self {
        match error {
            IntegrateError::Refused { .. } | IntegrateError::NotFinite { .. } => Self::Shorter,
            error => Self::Ended(error),
        }
    }
}
