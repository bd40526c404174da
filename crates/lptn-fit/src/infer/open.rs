//! Estimates if the record leaves open how smooth a time history is.
//!
//! The strength of a random walk has no single value. At the most likely strength, a constant power
//! would seem known to be constant. Bands are those of a mixture over both strengths, with even
//! steps of their logarithms. The mixture ranges from a strength without effect to one whose
//! likelihood is negligible. Several time histories are mixed one after the other.

use crate::infer::jumps::elsewhere;
use crate::infer::model::Model;
use crate::infer::search::open_walks;
use crate::infer::strength::Strength;
use crate::infer::task::InferTask;
use crate::kalman::Augmented;

/// Number of intensities that are evaluated for each walk.
const POINTS: usize = 8;

/// Strengths do not count if the log-likelihood has fallen by more than this.
const FALLEN: f64 = 7.0;

/// Shares below this do not count.
const LEAST_SHARE: f64 = 1e-3;

/// Limits of the intensities: up to the expected one over this part, down by its square.
const LEAST_PART: f64 = 1e-8;

/// Factor of each step.
const FACTOR: f64 = 2.0;

/// A walk is negligible if it changes the logarithm of the likelihood by less.
const NOT_FELT: f64 = 0.05;

/// The possible strengths of one time history, with their shares; those of the others are at their
/// most likely values. `course` and `slope` are the places of its walk and of that of its slope.
fn possible(
    (task, model, most): (&InferTask, &Model, &Strength),
    [course, slope]: [usize; 2],
) -> Vec<(Strength, f64)> {
    let axis = Axis { model, most, guess: Strength::guess(task, model) };
    let greatest = model.log_likelihood(most);
    let slopes = axis.values(slope);
    let points = axis.values(course).into_iter().flat_map(|a| slopes.iter().map(move |b| (a, *b)));
    let point = |(a, b): (f64, f64)| {
        let mut there = most.clone();
        (there.intensities[course], there.intensities[slope]) = (a, b);
        let share = (model.log_likelihood(&there) - greatest).exp();
        (there, if share.is_finite() { share } else { 0.0 })
    };
    let points: Vec<(Strength, f64)> = points.map(point).collect();
    let sum: f64 = points.iter().map(|(_, share)| share).sum();
    let counts = points.into_iter().map(|(strength, share)| (strength, share / sum));
    let counts: Vec<(Strength, f64)> = counts.filter(|(_, share)| *share > LEAST_SHARE).collect();
    if counts.is_empty() { vec![(most.clone(), 1.0)] } else { counts }
}

/// One intensity, with the others at their most likely values.
struct Axis<'a> {
    model: &'a Model,
    most: &'a Strength,
    guess: Strength,
}

impl Axis<'_> {
    /// Intensities at even distances of their logarithm. They range from one that is negligible or
    /// too weak to one that is too strong.
    fn values(&self, place: usize) -> Vec<f64> {
        let likely = |intensity: f64| {
            let mut there = self.most.clone();
            there.intensities[place] = intensity;
            self.model.log_likelihood(&there)
        };
        let (own, guess) = (self.most.intensities[place], self.guess.intensities[place]);
        let (still, greatest) = (likely(0.0), likely(own));
        let counts = |intensity: f64| likely(intensity) > greatest - FALLEN;
        let most = guess.max(own) / LEAST_PART;
        let mut end = if own > 0.0 { own } else { LEAST_PART * guess };
        while end < most && counts(end) {
            end *= FACTOR;
        }
        let least = end * LEAST_PART * LEAST_PART;
        let felt = |intensity: f64| (likely(intensity) - still).abs() > NOT_FELT;
        let mut begin = if own > 0.0 { own } else { end / FACTOR };
        while begin > least && counts(begin) && felt(begin) {
            begin /= FACTOR;
        }
        let length = (end / begin).ln();
        let value = |i: usize| begin * (length * (i as f64 + 0.5) / POINTS as f64).exp();
        (0..POINTS).map(value).collect()
    }
}

/// Means and standard deviations of the values that `asked` returns.
///
/// The strengths of one time history are mixed as a whole. Each of several widens the values of the
/// most likely strengths, and so does each jump that may be elsewhere.
pub(crate) fn mixture(
    (task, model, most): (&InferTask, &Model, &Strength),
    asked: impl Fn(&Augmented) -> Vec<(f64, f64)>,
) -> Vec<(f64, f64)> {
    let of = |strength: &Strength| asked(&model.augmented(strength));
    let mixed = |all: &[(Strength, f64)]| {
        let mut mixed = Mixed::default();
        all.iter().for_each(|(strength, share)| mixed.add(&of(strength), *share));
        mixed.done().collect::<Vec<_>>()
    };
    let open = open_walks(task);
    let each = open.chunks_exact(2).map(|pair| possible((task, model, most), [pair[0], pair[1]]));
    let mut wider: Vec<Vec<(Strength, f64)>> = each.collect();
    let first = if wider.len() == 1 { wider.pop() } else { None };
    for i in 0..most.jumps.len() {
        let others = elsewhere(model, most, i);
        if !others.is_empty() {
            wider.push([vec![(most.clone(), 1.0)], others].concat());
        }
    }
    let own = if wider.is_empty() && first.is_some() { Vec::new() } else { of(most) };
    let mut known = first.map_or_else(|| own.clone(), |all| mixed(&all));
    for all in wider {
        for ((known, own), (mean, deviation)) in known.iter_mut().zip(&own).zip(mixed(&all)) {
            let more = deviation * deviation - own.1 * own.1;
            *known = (known.0 + mean - own.0, (known.1 * known.1 + more).max(0.0).sqrt());
        }
    }
    known
}

/// Sums of Gaussians with their shares. Means are summed as distances from those of the first, which
/// keeps their digits.
#[derive(Default)]
struct Mixed {
    base: Vec<f64>,
    sums: Vec<(f64, f64)>,
    whole: f64,
}

impl Mixed {
    fn add(&mut self, found: &[(f64, f64)], share: f64) {
        if self.base.is_empty() {
            self.base = found.iter().map(|(mean, _)| *mean).collect();
            self.sums = vec![(0.0, 0.0); found.len()];
        }
        self.whole += share;
        for ((sum, (mean, deviation)), base) in self.sums.iter_mut().zip(found).zip(&self.base) {
            let moved = mean - base;
            sum.0 += share * moved;
            sum.1 += share * (deviation * deviation + moved * moved);
        }
    }

    /// The mean and standard deviation of each.
    fn done(&self) -> impl Iterator<Item = (f64, f64)> {
        self.sums.iter().zip(&self.base).map(|((first, second), base)| {
            let moved = first / self.whole;
            (base + moved, (second / self.whole - moved * moved).max(0.0).sqrt())
        })
    }
}
