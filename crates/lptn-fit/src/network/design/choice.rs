//! Choice of sensors and runs: those that reach all targets at the least cost.

use crate::network::design::information::Information;
use crate::network::design::sets::BestSet;
use crate::network::design::space::{Leg, Score, Space};

/// Largest number of runs of one design.
pub const MOST_LEGS: usize = 8;

/// A design.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Choice {
    pub(super) places: Vec<usize>,
    pub(super) legs: Vec<Leg>,
    pub(super) score: Score,
    cost: f64,
    seconds: f64,
}

impl Choice {
    fn new(space: &Space<'_>, (places, legs): (&[usize], Vec<Leg>), score: Score) -> Self {
        let runs: f64 = legs.iter().map(|leg| space.cost_of(*leg)).sum();
        let seconds = legs.iter().map(|leg| space.task.lasts(space.samples(*leg))).sum();
        let cost = space.cost_of_places(places) + runs;
        Self { places: places.to_vec(), legs, score, cost, seconds }
    }

    /// Designs that reach all targets come first: the cheaper, the one with fewer sensors, the
    /// shorter. Among the others, the one that leads further comes first.
    fn is_before(&self, other: &Self) -> bool {
        let price = |choice: &Self| (choice.cost, choice.places.len() as f64, choice.seconds);
        match (self.score.is_reached(), other.score.is_reached()) {
            (true, true) => price(self) < price(other),
            (false, false) => self.score < other.score,
            (reached, _) => reached,
        }
    }
}

/// The best design of one run, as short as possible, with any of the sets. If none reaches all
/// targets, several runs with the best sets, each time the most informative run.
pub(super) fn choose(
    space: &Space<'_>,
    (best, sets): (&[BestSet], &[Vec<usize>]),
) -> Option<Choice> {
    let first = |choices: Vec<Choice>| {
        choices.into_iter().reduce(|a, b| if b.is_before(&a) { b } else { a })
    };
    let single = first(sets.iter().flat_map(|places| single(space, places)).collect());
    single.or_else(|| first(best.iter().filter_map(|set| several(space, &set.places)).collect()))
}

/// Designs of one run, or of none if all targets are reached already.
fn single(space: &Space<'_>, places: &[usize]) -> Vec<Choice> {
    let base = space.base(places);
    let score = space.score(&base);
    if score.is_reached() {
        return vec![Choice::new(space, (places, Vec::new()), score)];
    }
    let left = space.task.budget - space.cost_of_places(places);
    let one = |run: usize| {
        let leg = space.shortest(places, (&base, space.longest(run, left)?))?;
        Some(Choice::new(space, (places, vec![leg]), reached(space, places, (&base, leg)).1))
    };
    (0..space.runs.len()).filter_map(one).collect()
}

fn reached(
    space: &Space<'_>,
    places: &[usize],
    (base, leg): (&Information, Leg),
) -> (Information, Score) {
    let mut all = base.clone();
    all.add(&space.tells(places, leg));
    let score = space.score(&all);
    (all, score)
}

/// One run after the other until all targets are reached, then each as short as possible. Ends if a
/// further run does not lead further, or the budget is used up.
fn several(space: &Space<'_>, places: &[usize]) -> Option<Choice> {
    let mut base = space.base(places);
    let mut left = space.task.budget - space.cost_of_places(places);
    let mut score = space.score(&base);
    let mut legs = Vec::new();
    while legs.len() < MOST_LEGS && !score.is_reached() {
        let Some((leg, next)) = space.best_run(places, (&base, left)) else { break };
        if !legs.is_empty() && next.is_about(score) {
            break;
        }
        (base, score) = reached(space, places, (&base, leg));
        left -= space.cost_of(leg);
        legs.push(leg);
    }
    if score.is_reached() {
        return shortened(space, places, &legs);
    }
    (!legs.is_empty()).then(|| Choice::new(space, (places, legs), score))
}

/// The cheapest of three ways to shorten runs that reach all: the last before the first, the first
/// before the last, and all by the same part before each by itself.
fn shortened(space: &Space<'_>, places: &[usize], legs: &[Leg]) -> Option<Choice> {
    let forth: Vec<usize> = (0..legs.len()).collect();
    let back: Vec<usize> = forth.iter().rev().copied().collect();
    let even = evenly(space, places, legs);
    let ways = [(legs, &back), (legs, &forth), (even.as_slice(), &back)];
    let all = ways.into_iter().map(|(legs, order)| {
        let legs = one_by_one(space, places, (legs, order));
        let score = space.score(&together(space, places, &legs));
        Choice::new(space, (places, legs), score)
    });
    all.reduce(|a, b| if b.is_before(&a) { b } else { a })
}

fn together(space: &Space<'_>, places: &[usize], legs: &[Leg]) -> Information {
    let mut all = space.base(places);
    legs.iter().for_each(|leg| all.add(&space.tells(places, *leg)));
    all
}

/// Runs that are all cut to the least part of themselves that reaches all targets.
fn evenly(space: &Space<'_>, places: &[usize], legs: &[Leg]) -> Vec<Leg> {
    const PARTS: usize = 50;
    let cut = |part: usize| -> Vec<Leg> {
        let one = |leg: &Leg| {
            let wanted = space.samples(*leg) * part / PARTS;
            let lengths = &space.runs[leg.run].lengths[..=leg.length];
            let length = lengths.partition_point(|samples| *samples < wanted);
            Leg { length: length.min(leg.length), ..*leg }
        };
        legs.iter().map(one).collect()
    };
    let is_enough = |part: &usize| space.score(&together(space, places, &cut(*part))).is_reached();
    (1..PARTS).find(is_enough).map_or_else(|| legs.to_vec(), cut)
}

/// Each run as short as possible next to the others, in this order; one that is not needed is left
/// out.
fn one_by_one(space: &Space<'_>, places: &[usize], (legs, order): (&[Leg], &[usize])) -> Vec<Leg> {
    let mut now: Vec<Option<Leg>> = legs.iter().copied().map(Some).collect();
    for &i in order {
        let Some(leg) = now[i].take() else { continue };
        let others: Vec<Leg> = now.iter().flatten().copied().collect();
        let base = together(space, places, &others);
        if !space.score(&base).is_reached() {
            now[i] = Some(space.shortest(places, (&base, leg)).unwrap_or(leg));
        }
    }
    now.into_iter().flatten().collect()
}
