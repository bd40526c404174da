//! Smoothness of the time histories if it is not given: the most likely one for the record.

use crate::infer::model::Model;
use crate::infer::strength::Strength;
use crate::infer::task::InferTask;
use crate::simplex;

/// Powers of e, three apart, that scale the walks of time histories and slopes to begin with: from
/// a guess, with jumps that explain more than before, and from a start that is nearly right.
const TRIED: [i32; 10] = [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4];
const WEAKER: [i32; 4] = [-4, -2, -1, 0];
const NEAR: [i32; 1] = [0];

/// Largest number of turns in which walks and noises are searched, and the least gain in
/// log-likelihood for another one.
const TURNS: usize = 4;
const LITTLE: f64 = 0.5;

/// Distance of the first corners of the search, in logarithms.
const APART: f64 = 1.0;

/// The strengths that are not given.
pub(crate) struct Open<'a> {
    /// Indices of the intensities.
    walks: Vec<usize>,
    pub(crate) task: &'a InferTask,
    pub(crate) model: &'a Model,
}

/// Indices of the intensities that are not given.
pub(crate) fn open_walks(task: &InferTask) -> Vec<usize> {
    let open =
        task.estimated.iter().enumerate().filter(|(_, estimated)| estimated.intensity.is_none());
    open.flat_map(|(j, _)| [2 * j, 2 * j + 1]).collect()
}

impl<'a> Open<'a> {
    pub(crate) fn of(task: &'a InferTask, model: &'a Model) -> Self {
        Self { walks: open_walks(task), task, model }
    }

    /// The most likely strength from `start` on, or from the best of many near it if that is a
    /// guess.
    pub(crate) fn first(&self, start: &Strength, guessed: bool) -> Strength {
        let walked = self.walked(start, if guessed { &TRIED } else { &NEAR });
        let found = self.noised(walked);
        if guessed { self.drifted(found) } else { found }
    }

    /// The most likely strength near `start`, with walks that may have become weaker.
    pub(crate) fn again(&self, start: &Strength) -> Strength {
        self.whitened(self.walked(start, &WEAKER))
    }

    /// Scales walks by factors with these logarithms.
    fn at(&self, start: &Strength, logarithms: &[f64]) -> Strength {
        let mut all = start.clone();
        self.walks.iter().zip(logarithms).for_each(|(j, x)| all.intensities[*j] *= x.exp());
        all
    }

    /// The most likely walks.
    fn walked(&self, start: &Strength, tried: &[i32]) -> Strength {
        let still = vec![0.0; self.walks.len()];
        if still.is_empty() {
            return start.clone();
        }
        let lack = |logarithms: &[f64]| -self.model.log_likelihood(&self.at(start, logarithms));
        let with = |(course, slope): (i32, i32)| {
            let mut logarithms = still.clone();
            logarithms.chunks_exact_mut(2).for_each(|pair| {
                pair.copy_from_slice(&[3.0 * f64::from(course), 3.0 * f64::from(slope)]);
            });
            (lack(&logarithms), logarithms)
        };
        let mut begin = still.clone();
        if tried.len() > 1 {
            let all = tried.iter().flat_map(|course| tried.iter().map(|slope| (*course, *slope)));
            let best = all.map(with).min_by(|a, b| a.0.total_cmp(&b.0));
            begin = best.map_or(still, |(_, logarithms)| logarithms);
        }
        self.at(start, &simplex::minimum(lack, &begin, APART))
    }

    /// Searches walks and noises in turns, from a start that is nearly right.
    pub(crate) fn in_turns(&self, mut found: Strength) -> Strength {
        let mut likely = self.model.log_likelihood(&found);
        for _ in 0..TURNS {
            found = self.noised(self.walked(&found, &NEAR));
            let now = self.model.log_likelihood(&found);
            if now < likely + LITTLE {
                break;
            }
            likely = now;
        }
        found
    }

    /// The most likely walks for a start among a few that are far apart: from none to strong, of
    /// the time history or of its slope.
    pub(crate) fn roughly(&self, start: &Strength) -> (f64, Strength) {
        if self.walks.is_empty() {
            return (self.model.log_likelihood(start), start.clone());
        }
        let steps = [-6, -3, -1, 1, 3].map(|step| 3.0 * f64::from(step));
        let weak = steps[0];
        let pairs = steps.iter().flat_map(|step| [[*step, weak], [weak, *step]]);
        let all = pairs.map(|pair| {
            let there = self.at(start, &pair.repeat(self.walks.len() / 2));
            (self.model.log_likelihood(&there), there)
        });
        let best = all.max_by(|a, b| a.0.total_cmp(&b.0));
        best.unwrap_or_else(|| (f64::NEG_INFINITY, start.clone()))
    }

    /// Stops the walks without which the record is as likely.
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
