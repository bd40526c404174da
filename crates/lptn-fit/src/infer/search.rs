//! How smooth the courses are, and how large the noise of a column, where neither is said: as the
//! record is most likely.

use crate::infer::model::Model;
use crate::infer::strength::Strength;
use crate::infer::task::InferTask;
use crate::simplex;

/// Powers of e, three apart, by which walks of courses and of slopes are made stronger or weaker to
/// begin with: from a guess, where jumps explain more than before, and from what is nearly right.
const TRIED: [i32; 10] = [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4];
const WEAKER: [i32; 4] = [-4, -2, -1, 0];
const NEAR: [i32; 1] = [0];

/// So far apart are the first corners of the search, in logarithms.
const APART: f64 = 1.0;

/// What may be left open.
pub(crate) struct Open<'a> {
    /// Places of the intensities.
    walks: Vec<usize>,
    noises: Vec<usize>,
    pub(crate) model: &'a Model,
}

/// Places of the intensities that are not said.
pub(crate) fn open_walks(task: &InferTask<'_>) -> Vec<usize> {
    let open = task.sought.iter().enumerate().filter(|(_, sought)| sought.intensity.is_none());
    open.flat_map(|(j, _)| [2 * j, 2 * j + 1]).collect()
}

impl Strength {
    /// What is said, and first guesses of what is not. Where it is said how much a course changes,
    /// its slope is none.
    pub(crate) fn guess(task: &InferTask<'_>, model: &Model) -> Self {
        let length = model.length();
        let walk = |(sought, size): (&crate::infer::Sought, &f64)| match sought.intensity {
            Some(intensity) => [intensity, 0.0],
            None => [size * size / length, size * size / length.powi(3)],
        };
        let columns = task.run.columns.iter();
        let noise = columns.map(|c| c.sigma.unwrap_or_else(|| scatter(&c.values)));
        let intensities = task.sought.iter().zip(&model.sizes).flat_map(walk).collect();
        Self { intensities, sigmas: noise.collect(), jumps: Vec::new() }
    }

    /// The same, where walks that stood still are given another chance.
    pub(crate) fn revived(mut self, task: &InferTask<'_>, model: &Model) -> Self {
        let guess = Self::guess(task, model).intensities;
        let stood = self.intensities.iter_mut().zip(guess).filter(|(q, _)| **q <= 0.0);
        stood.for_each(|(q, guess)| *q = guess);
        self
    }
}

impl<'a> Open<'a> {
    pub(crate) fn of(task: &InferTask<'_>, model: &'a Model) -> Self {
        let noises = task.run.columns.iter().enumerate().filter(|(_, c)| c.sigma.is_none());
        Self { walks: open_walks(task), noises: noises.map(|(i, _)| i).collect(), model }
    }

    /// The most likely from `start` on, or of many near it where that is a guess.
    pub(crate) fn first(&self, start: &Strength, guessed: bool) -> Strength {
        self.searched(start, if guessed { &TRIED } else { &NEAR })
    }

    fn at(&self, start: &Strength, logarithms: &[f64]) -> Strength {
        let mut all = start.clone();
        let (walks, noises) = logarithms.split_at(self.walks.len());
        self.walks.iter().zip(walks).for_each(|(j, x)| all.intensities[*j] *= x.exp());
        self.noises.iter().zip(noises).for_each(|(i, x)| all.sigmas[*i] *= x.exp());
        all
    }

    /// The most likely near `start`, where walks may have become weaker.
    pub(crate) fn again(&self, start: &Strength) -> Strength {
        self.searched(start, &WEAKER)
    }

    fn searched(&self, start: &Strength, tried: &[i32]) -> Strength {
        let still = vec![0.0; self.walks.len() + self.noises.len()];
        if still.is_empty() {
            return start.clone();
        }
        let lack = |logarithms: &[f64]| -self.model.log_likelihood(&self.at(start, logarithms));
        let with = |(course, slope): (i32, i32)| {
            let mut logarithms = still.clone();
            let walks = logarithms[..self.walks.len()].chunks_exact_mut(2);
            walks.for_each(|pair| {
                pair.copy_from_slice(&[3.0 * f64::from(course), 3.0 * f64::from(slope)]);
            });
            (lack(&logarithms), logarithms)
        };
        let mut begin = still.clone();
        if tried.len() > 1 && !self.walks.is_empty() {
            let all = tried.iter().flat_map(|course| tried.iter().map(|slope| (*course, *slope)));
            let best = all.map(with).min_by(|a, b| a.0.total_cmp(&b.0));
            begin = best.map_or(still, |(_, logarithms)| logarithms);
        }
        self.at(start, &simplex::minimum(lack, &begin, APART))
    }

    /// Walks stand still where the record is as likely so.
    pub(crate) fn without_walks(&self, mut found: Strength) -> Strength {
        let mut most = self.model.log_likelihood(&found);
        for &place in &self.walks {
            let mut still = found.clone();
            still.intensities[place] = 0.0;
            let likely = self.model.log_likelihood(&still);
            if likely >= most - 1e-3 {
                (found, most) = (still, likely.max(most));
            }
        }
        found
    }
}

/// The noise of values from how they scatter about their neighbours: the root of the mean of the
/// squares of second differences, each the sum of three noises with the factors 1, -2 and 1.
fn scatter(values: &[f64]) -> f64 {
    let read: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
    let bends = read.windows(3).map(|v| (v[0] - 2.0 * v[1] + v[2]).powi(2));
    let mean = bends.sum::<f64>() / read.len().saturating_sub(2).max(1) as f64;
    (mean / 6.0).sqrt().max(1e-6)
}
