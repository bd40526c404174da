//! Choice of sensors: the best set for each number of them.

use lptn_solve::in_parallel;

use crate::network::design::space::{Leg, Score, Space};

/// Largest number of places for which every set is evaluated; beyond, places are added and
/// exchanged.
pub const MOST_PLACES: usize = 10;

/// The best set with a number of places, judged by the best single run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BestSet {
    pub(super) places: Vec<usize>,
    /// Its run; none if the budget has room for none.
    pub(super) leg: Option<Leg>,
    pub(super) score: Score,
}

/// Search for the sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Searched {
    /// Number of sets that were evaluated.
    pub sets: usize,
    /// True if those are all sets.
    pub all: bool,
}

/// The best set for each number of places, the smallest first, and the sets to choose from: all of
/// them if all were evaluated.
pub(super) fn best_sets(space: &Space<'_>) -> (Vec<BestSet>, Vec<Vec<usize>>, Searched) {
    let count = space.task.places.len();
    if count > MOST_PLACES {
        return exchanged(space, count);
    }
    let all: Vec<Vec<usize>> = (1..1_usize << count)
        .map(|mask| (0..count).filter(|place| mask >> place & 1 == 1).collect())
        .collect();
    let judged = in_parallel(&all, space.task.fit.threads, |places| judge(space, places));
    let mut best: Vec<Option<BestSet>> = vec![None; count];
    for set in judged {
        let size = set.places.len() - 1;
        if best[size].as_ref().is_none_or(|known| better(space, &set, known)) {
            best[size] = Some(set);
        }
    }
    let searched = Searched { sets: all.len(), all: true };
    (best.into_iter().flatten().collect(), all, searched)
}

/// If two lead equally far, the cheaper one is better.
fn better(space: &Space<'_>, one: &BestSet, other: &BestSet) -> bool {
    let cost = |set: &BestSet| space.cost_of_places(&set.places);
    one.score < other.score || (one.score == other.score && cost(one) < cost(other))
}

fn judge(space: &Space<'_>, places: &[usize]) -> BestSet {
    let left = space.task.budget - space.cost_of_places(places);
    let found = space.best_run(places, (&space.base(places), left));
    let (leg, score) = found.map_or((None, Score::WORST), |(leg, score)| (Some(leg), score));
    BestSet { places: places.to_vec(), leg, score }
}

/// Adds the place that leads furthest, then exchanges places of the set as long as that leads
/// further (V. V. Fedorov, Theory of Optimal Experiments, 1972).
fn exchanged(space: &Space<'_>, count: usize) -> (Vec<BestSet>, Vec<Vec<usize>>, Searched) {
    let (mut best, mut sets): (Vec<BestSet>, usize) = (Vec::new(), 0);
    let mut pick = |from: Vec<Vec<usize>>| {
        sets += from.len();
        let judged = in_parallel(&from, space.task.fit.threads, |places| judge(space, places));
        judged.into_iter().reduce(|a, b| if better(space, &b, &a) { b } else { a })
    };
    let mut now: Vec<usize> = Vec::new();
    for _ in 0..count {
        let free: Vec<usize> = (0..count).filter(|place| !now.contains(place)).collect();
        let Some(mut found) = pick(free.iter().map(|place| with(&now, *place)).collect()) else {
            break;
        };
        while let Some(other) = pick(exchanges(&found.places, count)) {
            if !better(space, &other, &found) {
                break;
            }
            found = other;
        }
        now.clone_from(&found.places);
        best.push(found);
    }
    let all = best.iter().map(|set| set.places.clone()).collect();
    (best, all, Searched { sets, all: false })
}

fn with(places: &[usize], more: usize) -> Vec<usize> {
    let mut all = places.to_vec();
    all.push(more);
    all.sort_unstable();
    all
}

/// Every set with one place exchanged for another.
fn exchanges(places: &[usize], count: usize) -> Vec<Vec<usize>> {
    let mut all = Vec::new();
    for out in places {
        let rest: Vec<usize> = places.iter().copied().filter(|place| place != out).collect();
        let others = (0..count).filter(|place| !places.contains(place));
        all.extend(others.map(|place| with(&rest, place)));
    }
    all
}
