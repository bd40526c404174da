//! The integrator's solution over some of its steps, as polynomials.

use lptn_integrate::IntegrateError;

use super::way::{Way, basis, places};

/// Samples that determine the solution of a step: CVODE has polynomials of degree 5, the
/// Runge-Kutta method of degree 4.
const SAMPLES: usize = 6;

/// Numbers of all steps that are kept.
const ROOM: usize = 1 << 20;

/// Most steps that are kept.
const MOST: usize = 64;

/// Writes the state at a time of the present step.
pub(crate) type StateAt<'a> = dyn FnMut(f64, &mut [f64]) -> Result<(), IntegrateError> + 'a;

/// Steps one after the other.
pub(super) struct Course {
    basis: [[f64; SAMPLES]; SAMPLES],
    samples: [Vec<f64>; SAMPLES],
    steps: Vec<Part>,
    count: usize,
    /// A time in s before which nothing is needed.
    begin: f64,
}

/// One step, or a part of it.
#[derive(Default)]
pub(super) struct Part {
    pub(super) from: f64,
    pub(super) to: f64,
    way: Way<SAMPLES>,
}

impl Part {
    /// Temperature of an unknown in K at a time in s.
    pub(super) fn at(&self, unknown: usize, time: f64) -> f64 {
        self.way.at(unknown, self.place(time))
    }

    fn place(&self, time: f64) -> f64 {
        (2.0 * (time - self.from) / (self.to - self.from) - 1.0).clamp(-1.0, 1.0)
    }
}

impl Course {
    pub(super) fn new(unknowns: usize) -> Self {
        let samples = std::array::from_fn(|_| vec![0.0; unknowns]);
        Self { basis: basis(), samples, steps: Vec::new(), count: 0, begin: f64::NEG_INFINITY }
    }

    pub(super) fn add(
        &mut self,
        (from, to): (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), IntegrateError> {
        for (sample, place) in self.samples.iter_mut().zip(places::<SAMPLES>()) {
            let time = from + 0.5 * (1.0 + place) * (to - from);
            state_at(time.clamp(from, to), sample)?;
        }
        if self.steps.len() == self.count {
            self.steps.push(Part::default());
        }
        let part = &mut self.steps[self.count];
        (part.from, part.to) = (from, to);
        part.way.put(&self.samples, &self.basis);
        self.count += 1;
        Ok(())
    }

    /// From the start of the first step to the end of the last one in s, as far as they are needed;
    /// `None` without steps.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        let steps = self.steps();
        Some((steps.first()?.from.max(self.begin), steps.last()?.to))
    }

    /// Forgets the steps before a time in s.
    pub(super) fn forget_before(&mut self, time: f64) {
        let over = self.steps().partition_point(|part| part.to <= time);
        self.steps[..self.count].rotate_left(over);
        self.count -= over;
        self.begin = time;
    }

    pub(super) fn is_full(&self) -> bool {
        self.count >= MOST || self.count * self.samples[0].len() * SAMPLES >= ROOM
    }

    pub(super) fn steps(&self) -> &[Part] {
        &self.steps[..self.count]
    }

    /// The step at a time in s.
    pub(super) fn step_at(&self, time: f64) -> &Part {
        let steps = self.steps();
        let place = steps.partition_point(|part| part.to < time);
        &steps[place.min(steps.len() - 1)]
    }

    /// Writes the state at a time in s.
    pub(super) fn write(&self, time: f64, state: &mut [f64]) {
        let part = self.step_at(time);
        let place = part.place(time);
        state.iter_mut().enumerate().for_each(|(i, t)| *t = part.way.at(i, place));
    }
}
