//! Start values of the search for strengths that are not given.

use crate::infer::model::Model;
use crate::infer::strength::{Noise, Strength};
use crate::infer::task::{Drift, InferTask};

impl Strength {
    /// The given strengths, and first guesses of the others. If the change of a time history is
    /// given, the intensity of its slope is 0.
    pub(crate) fn guess(task: &InferTask, model: &Model) -> Self {
        let length = model.length();
        let walk = |(estimated, size): (&crate::infer::Estimated, &f64)| match estimated.intensity {
            Some(intensity) => [intensity, 0.0],
            None => [size * size / length, size * size / length.powi(3)],
        };
        let intensities = task.estimated.iter().zip(&model.sizes).flat_map(walk).collect();
        Self { intensities, noises: noises(task), jumps: Vec::new() }
    }

    /// The same, with guesses for walks of zero strength.
    pub(crate) fn revived(mut self, task: &InferTask, model: &Model) -> Self {
        let guess = Self::guess(task, model).intensities;
        let stood = self.intensities.iter_mut().zip(guess).filter(|(q, _)| **q <= 0.0);
        stood.for_each(|(q, guess)| *q = guess);
        self
    }
}

/// The given noises, and first guesses of the others.
fn noises(task: &InferTask) -> Vec<Noise> {
    let one = |i: usize| match task.drift {
        Drift::Known { deviation, time } => {
            let all = Scatter::of(task, i);
            let white = task.run.columns[i].sigma.unwrap_or_else(|| all.noise(0.0, 1.0));
            Noise { white, drift: deviation, time }
        }
        Drift::Open => with(task, i, (0.0, 1.0)),
    };
    (0..task.run.columns.len()).map(one).collect()
}

/// The noise of a column if this share of its variance decays over this time in s.
pub(crate) fn with(task: &InferTask, column: usize, (part, time): (f64, f64)) -> Noise {
    let said = task.run.columns[column].sigma;
    Noise::split(said.unwrap_or_else(|| Scatter::of(task, column).noise(part, time)), part, time)
}

/// Scatter of values about their neighbours.
struct Scatter {
    /// Mean of the squares of second differences.
    bends: f64,
    /// Mean distance of two values in s.
    every: f64,
}

impl Scatter {
    fn of(task: &InferTask, column: usize) -> Self {
        let all = task.run.times.iter().zip(&task.run.columns[column].values);
        let read: Vec<(f64, f64)> =
            all.filter(|(_, value)| !value.is_nan()).map(|(t, value)| (*t, *value)).collect();
        let bends = read.windows(3).map(|v| (v[0].1 - 2.0 * v[1].1 + v[2].1).powi(2));
        let bends = bends.sum::<f64>() / read.len().saturating_sub(2).max(1) as f64;
        let length = read.last().map_or(0.0, |last| last.0 - read[0].0);
        Self { bends, every: length / read.len().saturating_sub(1).max(1) as f64 }
    }

    /// Standard deviation of one value: a second difference is the sum of three noises with the
    /// factors 1, -2 and 1.
    fn noise(&self, part: f64, time: f64) -> f64 {
        let alike = f64::exp(-self.every / time);
        let factor = 6.0 + part * (2.0 * alike * alike - 8.0 * alike);
        (self.bends / factor).sqrt().max(1e-6)
    }
}
