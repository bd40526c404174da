//! How smooth the courses are, and how large the noise of a column, where neither is said: as the
//! record is most likely.

use crate::infer::model::Model;
use crate::infer::task::InferTask;
use crate::simplex;

/// The strengths of walks and noises.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Strength {
    /// For each course the variance of its walk per s, in the units of its coordinate squared, and
    /// that of the walk of its slope.
    pub(crate) intensities: Vec<f64>,
    /// Standard deviation of the noise of each column in K.
    pub(crate) sigmas: Vec<f64>,
}

/// Powers of e, three apart, by which walks of courses and of slopes are made stronger or weaker to
/// begin with.
const TRIED: std::ops::RangeInclusive<i32> = -5..=4;

/// So far apart are the first corners of the search, in logarithms.
const APART: f64 = 1.0;

/// What may be left open.
struct Open<'a> {
    /// Places of the intensities.
    walks: Vec<usize>,
    noises: Vec<usize>,
    start: Strength,
    model: &'a Model,
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
        Self { intensities, sigmas: noise.collect() }
    }

    /// With the greatest likelihood, from `start` on, or from the best of many near it where that is
    /// a guess.
    pub(crate) fn most_likely(
        (task, model): (&InferTask<'_>, &Model),
        (start, guessed): (Self, bool),
    ) -> Self {
        let noises = task.run.columns.iter().enumerate().filter(|(_, c)| c.sigma.is_none());
        let (walks, noises): (_, Vec<usize>) = (open_walks(task), noises.map(|(i, _)| i).collect());
        if walks.is_empty() && noises.is_empty() {
            return start;
        }
        let open = Open { walks, noises, start, model };
        open.without_walks(open.searched(guessed))
    }

    pub(crate) fn log_likelihood(&self, model: &Model) -> f64 {
        model.log_likelihood(&self.intensities, &self.sigmas)
    }

    /// The same, where walks that stood still are given another chance.
    pub(crate) fn revived(mut self, task: &InferTask<'_>, model: &Model) -> Self {
        let guess = Self::guess(task, model).intensities;
        let stood = self.intensities.iter_mut().zip(guess).filter(|(q, _)| **q <= 0.0);
        stood.for_each(|(q, guess)| *q = guess);
        self
    }

    /// The same with walks that stand still.
    pub(crate) fn still(&self) -> Self {
        Self { intensities: vec![0.0; self.intensities.len()], sigmas: self.sigmas.clone() }
    }
}

impl Open<'_> {
    fn at(&self, logarithms: &[f64]) -> Strength {
        let mut all = self.start.clone();
        let (walks, noises) = logarithms.split_at(self.walks.len());
        self.walks.iter().zip(walks).for_each(|(j, x)| all.intensities[*j] *= x.exp());
        self.noises.iter().zip(noises).for_each(|(i, x)| all.sigmas[*i] *= x.exp());
        all
    }

    fn searched(&self, guessed: bool) -> Strength {
        let lack = |logarithms: &[f64]| -self.at(logarithms).log_likelihood(self.model);
        let mut start = vec![0.0; self.walks.len() + self.noises.len()];
        if guessed && !self.walks.is_empty() {
            let with = |(course, slope): (i32, i32)| {
                let mut logarithms = start.clone();
                let walks = logarithms[..self.walks.len()].chunks_exact_mut(2);
                walks.for_each(|pair| {
                    pair.copy_from_slice(&[3.0 * f64::from(course), 3.0 * f64::from(slope)]);
                });
                (lack(&logarithms), logarithms)
            };
            let all = TRIED.flat_map(|course| TRIED.map(move |slope| (course, slope)));
            let best = all.map(with).min_by(|a, b| a.0.total_cmp(&b.0));
            start = best.map_or(start.clone(), |(_, logarithms)| logarithms);
        }
        self.at(&simplex::minimum(lack, &start, APART))
    }

    /// Walks stand still where the record is as likely so.
    fn without_walks(&self, mut found: Strength) -> Strength {
        let mut most = found.log_likelihood(self.model);
        for &place in &self.walks {
            let mut still = found.clone();
            still.intensities[place] = 0.0;
            let likely = still.log_likelihood(self.model);
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
