//! Jumps of time histories. A bench that sets one load after another has a time history that is
//! constant and jumps. It is then known far better than as a walk.
//!
//! A jump is a walk between two moments, as strong as the time history is large. It is accepted if
//! it makes the record more likely by more than chance would anywhere in it.
//!
//! A strong walk between two rows has the mean and the variance of a jump at any time between them.
//! Filter, smoother and rounds therefore need no notion of jumps. The jump is three times as large
//! as the time history. A smaller prior would tie the moment of a large jump, and its height, to
//! the middle between its rows.
//!
//! One jump alone may not pay if a walk has absorbed all of them. Four are therefore tried in vain
//! before the search ends. An unneeded jump only widens the band near it.

use crate::infer::inferred::{InferredJump, Known};
use crate::infer::model::Model;
use crate::infer::search::Open;
use crate::infer::strength::{Jump, Strength};
use crate::infer::task::InferTask;

/// Cost of a jump in units of the log-likelihood, in addition to that of its place, which may be
/// any. Chance alone pays it in at most 5 of 100 records (inequality of A. Markov).
const PRICE: f64 = 3.0;

/// Number of jumps in a row that are tried without gain, since one alone may not pay if two do: in
/// the first round, and in others.
const PATIENCE: [usize; 2] = [4, 1];

/// If no walk hides jumps, a jump is tried that gains this part of its price.
const NEARLY: f64 = 0.5;

/// Largest number of jumps.
const MOST: usize = 60;

/// The most likely strengths with the jumps that pay. The search begins at `start`, or at the best
/// of many points near it if it is a guess.
pub(crate) fn most_likely(
    (task, model): (&InferTask, &Model),
    (start, guessed): (&Strength, bool),
) -> Strength {
    let open = Open::of(task, model);
    let found = open.first(start, guessed);
    let courses: Vec<usize> =
        (0..task.estimated.len()).filter(|j| task.estimated[*j].jumps).collect();
    if courses.is_empty() {
        return open.without_walks(found);
    }
    let places = courses.len() * (model.times.len() - 1);
    let patience = PATIENCE[usize::from(!guessed)];
    let search = Search { open: &open, courses, price: PRICE + (places as f64).ln(), patience };
    let found = search.placed(search.needed(search.taken_in(found)));
    let found =
        if found.jumps.is_empty() { found } else { open.needed_drifts(open.in_turns(found)) };
    open.without_walks(found)
}

struct Search<'a> {
    open: &'a Open<'a>,
    courses: Vec<usize>,
    price: f64,
    patience: usize,
}

impl Search<'_> {
    fn worth(&self, strength: &Strength) -> f64 {
        self.open.model.log_likelihood(strength) - self.price * strength.jumps.len() as f64
    }

    /// Adds one jump after the other, as long as they pay.
    fn taken_in(&self, found: Strength) -> Strength {
        let mut best = (self.worth(&found), found.clone());
        let hidden = self.hides(&found);
        let (mut now, mut in_vain) = (found, 0);
        while in_vain < self.patience && now.jumps.len() < MOST {
            let Some((gain, jump)) = self.most_telling(&now) else { break };
            if gain < self.price * NEARLY && !hidden {
                break;
            }
            now = self.open.again(&now.with(jump));
            let worth = self.worth(&now);
            in_vain += 1;
            if worth > best.0 {
                (best, in_vain) = ((worth, now.clone()), 0);
            }
        }
        best.1
    }

    /// True if walks may have absorbed jumps: they make the record more likely.
    fn hides(&self, found: &Strength) -> bool {
        let model = self.open.model;
        model.log_likelihood(found) > model.log_likelihood(&found.still()) + 1.0
    }

    /// The jump that makes the record most likely if all else stays, with its gain in
    /// log-likelihood first (A. S. Willsky, H. L. Jones, IEEE Trans. Autom. Control 21 (1976) 108).
    fn most_telling(&self, strength: &Strength) -> Option<(f64, Jump)> {
        let model = self.open.model;
        let mut best: Option<(f64, Jump)> = None;
        model.smoothed(strength).0.backwards(|to, told| {
            for &course in &self.courses {
                let jump = Jump { to, course };
                if to == 0 || strength.jumps.contains(&jump) {
                    continue;
                }
                let (pull, hold) = told.later.of_shock(&model.shock(jump));
                let gain = 0.5 * (pull * pull / (1.0 + hold) - hold.ln_1p());
                if best.is_none_or(|(most, _)| gain > most) {
                    best = Some((gain, jump));
                }
            }
        });
        best
    }

    /// Removes jumps that do not pay in addition to the others.
    fn needed(&self, mut found: Strength) -> Strength {
        while !found.jumps.is_empty() {
            let without = found.jumps.iter().map(|jump| {
                let less = found.without(*jump);
                (self.worth(&less), less)
            });
            let Some((_, less)) = without.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            let less = self.open.again(&less);
            if self.worth(&less) < self.worth(&found) {
                break;
            }
            found = less;
        }
        found
    }

    /// Moves each jump to its most likely place, given the others.
    fn placed(&self, mut found: Strength) -> Strength {
        let model = self.open.model;
        let mut most = model.log_likelihood(&found);
        for i in 0..found.jumps.len() {
            for forward in [false, true] {
                while let Some(moved) = beside(model, &found, i, forward) {
                    let likely = model.log_likelihood(&moved);
                    if likely <= most {
                        break;
                    }
                    (found, most) = (moved, likely);
                }
            }
        }
        found
    }
}

/// The same with a jump one moment earlier or later, unless another is there.
fn beside(model: &Model, strength: &Strength, i: usize, forward: bool) -> Option<Strength> {
    let Jump { to, course } = strength.jumps[i];
    let to = if forward { to + 1 } else { to - 1 };
    let jump = Jump { to, course };
    let free = to > 0 && to < model.times.len() && !strength.jumps.contains(&jump);
    let mut moved = strength.clone();
    moved.jumps[i] = jump;
    free.then_some(moved)
}

/// Times and heights of the jumps. The walk to the same moment counts as part of a jump.
pub(crate) fn told(model: &Model, strength: &Strength) -> Vec<InferredJump> {
    let most = model.log_likelihood(strength);
    let one = |(i, jump): (usize, &Jump)| {
        let mut places = elsewhere(model, strength, i);
        places.push((strength.clone(), 1.0));
        places.sort_by(|a, b| b.1.total_cmp(&a.1));
        let between = between(&places, i);
        InferredJump {
            course: jump.course,
            between: (model.times[between.0 - 1], model.times[between.1]),
            by: by(model, &places, i),
            gain: most - model.log_likelihood(&strength.without(*jump)),
        }
    };
    strength.jumps.iter().enumerate().map(one).collect()
}

/// Change of the time history, over all likely places of the jump.
fn by(model: &Model, places: &[(Strength, f64)], i: usize) -> Known {
    let whole: f64 = places.iter().map(|(_, share)| share).sum();
    let (mut mean, mut square) = (0.0, 0.0);
    for (strength, share) in places {
        let Jump { to, course } = strength.jumps[i];
        let (course, size) = (model.states.course(course), model.states.moving());
        let noise = model.comes_in(to, strength);
        let shock = &noise[course * size..][..size];
        model.smoothed(strength).0.backwards(|k, told| {
            if k == to {
                let (pull, hold) = told.later.of_shock(shock);
                mean += share / whole * pull;
                square += share / whole * (pull * pull + shock[course] - hold);
            }
        });
    }
    Known { value: mean, deviation: (square - mean * mean).max(0.0).sqrt() }
}

/// The first and last moments to which a jump leads, without the least likely 5 %.
fn between(places: &[(Strength, f64)], i: usize) -> (usize, usize) {
    let enough = 0.95 * places.iter().map(|(_, share)| share).sum::<f64>();
    let (mut sum, mut ends) = (0.0, (usize::MAX, 0));
    for (strength, share) in places {
        if sum < enough {
            let to = strength.jumps[i].to;
            ends = (ends.0.min(to), ends.1.max(to));
        }
        sum += share;
    }
    ends
}

/// Other places of a jump, with their likelihood relative to that of the present place.
pub(crate) fn elsewhere(model: &Model, strength: &Strength, i: usize) -> Vec<(Strength, f64)> {
    /// Places that are less likely do not count.
    const LEAST_SHARE: f64 = 1e-3;
    let most = model.log_likelihood(strength);
    let mut all = Vec::new();
    for forward in [false, true] {
        let mut now = strength.clone();
        while let Some(moved) = beside(model, &now, i, forward) {
            let share = (model.log_likelihood(&moved) - most).exp();
            if share.is_nan() || share < LEAST_SHARE {
                break;
            }
            all.push((moved.clone(), share));
            now = moved;
        }
    }
    all
}
