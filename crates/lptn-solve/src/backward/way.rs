//! The way back through a run, stretch by stretch.

use lptn_integrate::vectors::add;
use lptn_integrate::{IntegrateError, Integrator, OneStep, Options};

use super::error::BackwardError;
use super::moment::Moment;
use super::rate::Read;
use super::system::Adjoint;
use super::{Aim, Asked};
use crate::error::TransientError;
use crate::margin::Point;
use crate::sensitive_run::step;
use crate::settings::{Proceed, Progress};
use crate::stepper::cvodes;
use crate::trajectory::Series;

/// Tolerance of the adjoint as a share of its largest value, for one of the run of 1 K. The running
/// integrals have no tolerance of their own and err by up to a hundred times this.
const SHARE: f64 = 0.01;

/// Bounds of that tolerance; below the lower one rounding decides.
const FINEST: f64 = 1e-12;
const COARSEST: f64 = 1e-6;

/// The largest scaled value of the adjoint stays between these two.
const SCALED: [f64; 2] = [1e-2, 10.0];

/// The part of the run after which an integrated result is taken to have its first size.
const FIRST: f64 = 1e-3;

/// The adjoint on its way.
pub(super) struct Way<'a> {
    pub(super) asked: &'a Asked<'a>,
    pub(super) integrator: Box<dyn Integrator<Adjoint<'a>> + 'a>,
    /// The result of one moment; `None` for an integrated one.
    pub(super) aim: Option<Aim>,
    /// Tolerance of the adjoint as a part of its largest value.
    pub(super) tolerance: f64,
    /// The adjoint of the heat contents of the states, in the unit of the result per J.
    pub(super) adjoint: Vec<f64>,
    /// Derivatives by the parameters so far.
    pub(super) found: Vec<f64>,
    /// Step of each parameter in its unit.
    pub(super) steps: Vec<f64>,
    /// Norm of the integrals of the absolute derivatives so far, without running integrals.
    pub(super) size: f64,
    /// Running integrals that were taken.
    taken: Vec<f64>,
    /// For each stretch the change of the result with the time of its end that later switches add.
    pub(super) waits: Vec<f64>,
}

impl<'a> Way<'a> {
    /// From the moment of a result or, without one, from the end of the run for an integral.
    pub(super) fn new(asked: &'a Asked<'a>, aim: Option<Aim>) -> Result<Self, BackwardError> {
        let (system, stretches) = (asked.margin.system, &asked.trajectory.stretches);
        let moment = Moment::new(system, asked.parameters)?;
        let stretch = aim.map_or(stretches.len() - 1, |aim| aim.stretch);
        let from = aim.map_or(stretches[stretch].span().1, |aim| aim.time);
        let integrated = aim.is_none().then_some(asked.margin);
        let parameters = asked.parameters.len();
        let adjoint = Adjoint::new(moment, &stretches[stretch], (integrated, parameters));
        let zero = vec![0.0; system.states().len()];
        let tolerance = (SHARE * asked.solution.tolerance).clamp(FINEST, COARSEST);
        let options = Options { tolerance, ..Options::default() };
        let integrator = stepper(adjoint, (-from, &zero), &options)?;
        Ok(Self {
            asked,
            integrator,
            aim,
            tolerance,
            adjoint: zero,
            found: vec![0.0; parameters],
            steps: asked.parameters.iter().map(|id| step(system.network(), *id)).collect(),
            size: 0.0,
            taken: vec![0.0; parameters],
            waits: vec![0.0; stretches.len()],
        })
    }

    /// The moment of the run that the adjoint is at.
    pub(super) fn moment(&mut self) -> &mut Moment<'a> {
        &mut self.integrator.system_mut().moment
    }

    /// The run in a stretch at a time in s, and the margin there.
    pub(super) fn read(
        &mut self,
        stretch: usize,
        time: f64,
    ) -> Result<(Point, f64), BackwardError> {
        let asked = self.asked;
        let point = asked.point(self.moment(), (stretch, time))?;
        let margin = asked.margin.at(&point)?;
        Ok((point, margin))
    }

    /// The rate in 1/s of a number along a stretch, just before a time in s.
    pub(super) fn rate(&mut self, at: (usize, f64), read: Read) -> Result<f64, BackwardError> {
        let asked = self.asked;
        asked.rate(self.moment(), at, read)
    }

    /// Goes back to the start; the derivatives by the parameters.
    pub(super) fn back(mut self) -> Result<Vec<f64>, BackwardError> {
        let stretches = &self.asked.trajectory.stretches;
        let last = self.aim.map_or(stretches.len() - 1, |aim| aim.stretch);
        for stretch in (0..=last).rev() {
            let (from, to) = stretches[stretch].span();
            let aim = self.aim.filter(|aim| aim.stretch == stretch);
            let to = aim.map_or(to, |aim| aim.time);
            if to >= stretches[stretch].span().1 {
                self.turn(stretch)?;
            }
            if aim.is_some() {
                self.arrive(stretch, to)?;
            }
            self.pass(stretch, (from, to))?;
        }
        Ok(self.found)
    }

    /// Adds the derivatives of the margin at its moment.
    fn arrive(&mut self, stretch: usize, time: f64) -> Result<(), BackwardError> {
        let (margin, parameters) = (self.asked.margin, self.asked.parameters);
        let (point, _) = self.read(stretch, time)?;
        let weights = margin.by_nodes(&point, (&margin.nodes(), 0.0))?;
        let instant = self.moment().instant(&weights)?;
        add(&mut self.adjoint, 1.0, &instant.states);
        add(&mut self.found, 1.0, &instant.parameters);
        if margin.nodes_alone().is_none() {
            for (found, &parameter) in self.found.iter_mut().zip(parameters) {
                *found += margin.directly(std::slice::from_ref(&point), parameter)?;
            }
        }
        Ok(())
    }

    /// Integrates back over a part of a stretch, by steps no longer than those of the run: a running
    /// integral changes as fast as the temperatures do, and CVODES does not control its error.
    fn pass(&mut self, stretch: usize, (from, to): (f64, f64)) -> Result<(), BackwardError> {
        let is_zero = !self.adjoint.iter().any(|x| x.abs() > 0.0);
        if from >= to {
            return Ok(());
        }
        self.integrator.system_mut().enter(&self.asked.trajectory.stretches[stretch]);
        let scale = if is_zero { self.first_scale((from, to))? } else { self.scale() };
        self.restart(scale)?;
        self.integrator.set_stop(-from);
        while self.integrator.time() < -from {
            self.step(stretch)?;
            self.report()?;
            let (size, [low, high]) = (largest(self.integrator.state()), SCALED);
            if size > high || size < low && size > 0.0 && !is_zero {
                self.take()?;
                let scale = self.scale();
                self.restart(scale)?;
            }
        }
        self.take()
    }

    /// A step back, with the derivatives along it.
    fn step(&mut self, stretch: usize) -> Result<(), BackwardError> {
        let from = -self.integrator.time();
        if !self.integrator.system().constant {
            let longest = self.asked.trajectory.stretches[stretch].step(from);
            self.integrator.set_longest_step(longest);
        }
        loop {
            let stepped = self.integrator.step().map_err(|error| self.failed(error))?;
            let Some(series) = self.integrator.series() else { return Ok(()) };
            if stepped.to >= series.span.1 {
                let span = (-stepped.to, from);
                let series = Series::of(&series);
                return self.add_step(stretch, (&series, span));
            }
        }
    }

    /// Reports the time that is reached on the way back; it may be interrupted.
    fn report(&self) -> Result<(), BackwardError> {
        let [start, stop] = [0.0, self.asked.length()];
        let gone = self.integrator.time() + self.asked.end();
        match (self.asked.observer)(Progress { start, time: gone, stop }) {
            Proceed::Continue => Ok(()),
            Proceed::Interrupt => Err(BackwardError::Interrupted),
        }
    }

    fn failed(&mut self, error: IntegrateError) -> BackwardError {
        self.integrator.system_mut().failure.take().unwrap_or(error.into())
    }

    /// The scale at which the largest value is 1.
    fn scale(&self) -> f64 {
        1.0 / largest(&self.adjoint)
    }

    /// The same after a small part of the run, if it is zero now: by the largest rate at the ends and
    /// in the middle of the stretch.
    fn first_scale(&mut self, (from, to): (f64, f64)) -> Result<f64, BackwardError> {
        let part = (FIRST * self.asked.length()).min(to - from);
        let adjoint = self.integrator.system_mut();
        adjoint.rescale(1.0);
        let mut rate = 0.0_f64;
        for time in [to, 0.5 * (from + to), from] {
            rate = rate.max(adjoint.rate(time)?);
        }
        Ok(if rate > 0.0 { 1.0 / (part * rate) } else { 1.0 })
    }

    fn restart(&mut self, scale: f64) -> Result<(), BackwardError> {
        self.integrator.system_mut().rescale(scale);
        let scaled: Vec<f64> = self.adjoint.iter().map(|x| scale * x).collect();
        Ok(self.integrator.restart(Some(&scaled))?)
    }

    /// Takes the adjoint and the running integrals.
    fn take(&mut self) -> Result<(), BackwardError> {
        let scale = self.integrator.system().scale;
        self.adjoint = self.integrator.state().iter().map(|x| x / scale).collect();
        let now = self.integrator.quadratures()?.to_vec();
        let changes = now.iter().zip(&self.taken).map(|(now, before)| (now - before) / scale);
        self.found.iter_mut().zip(changes).for_each(|(found, change)| *found += change);
        self.taken = now;
        Ok(())
    }
}

/// The integrator: the one-step method for constant coefficients, which takes no running integrals.
fn stepper<'a>(
    mut adjoint: Adjoint<'a>,
    at: (f64, &[f64]),
    options: &Options,
) -> Result<Box<dyn Integrator<Adjoint<'a>> + 'a>, BackwardError> {
    if OneStep::suits(&mut adjoint, at, options.tolerance) {
        let integrator = OneStep::new(adjoint, at.0, at.1, options);
        return Ok(Box::new(integrator.map_err(TransientError::Integrator)?));
    }
    adjoint.constant = false;
    Ok(cvodes(adjoint, at, options)?)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}
