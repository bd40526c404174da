//! Check that a record determines a time history and that no other unknown hides it.

use lptn_network::NodeId;

use crate::infer::inferred::Rival;
use crate::infer::model::Model;
use crate::infer::prior::{Before, Begins, Root};
use crate::infer::states::States;
use crate::infer::strength::Strength;
use crate::kalman::{Augmented, Part};

/// An unknown state is given a wide deviation. If doubling that deviation widens a band by more
/// than this factor, the band depends on it.
const HANGS: f64 = 1.5;

/// Values with a `±` dominate a band that is this many times as wide as without them.
const HIDDEN: f64 = 2.0;

/// Unknowns are named if they move by more than this part of the one that moves most.
const SHARE: f64 = 0.1;

/// For each time history `None` if it is determined, by its band at the narrowest moment, else the
/// unknowns that it cannot be distinguished from. The band must not depend on an unknown state,
/// whose deviation is an assumption. Values with a `±` must not make it wider than the size of the
/// time history, `sizes`.
pub(crate) fn courses(
    (model, begins): (&Model, &Begins),
    strength: &Strength,
    sizes: &[f64],
) -> Vec<Option<Vec<Rival>>> {
    let augmented = model.augmented(strength);
    let by = |factor: &dyn Fn(Before) -> f64| {
        augmented.unknowns(model.roots.iter().map(|root| factor(root.before)).collect())
    };
    let wide = by(&|before| if before == Before::Spread { 1.0 } else { 2.0 });
    let exact = by(&|before| if before == Before::Estimated { 1.0 } else { 0.0 });
    let told = |((j, part), size): ((usize, Part), &f64)| {
        let of = |unknowns: &crate::kalman::Unknowns| unknowns.known(&part).1;
        let deviation = of(augmented.own());
        let hangs = of(&wide) > HANGS * deviation;
        let hidden = deviation > HIDDEN * of(&exact) && deviation > *size;
        let known = deviation.is_finite() && !hangs && !hidden;
        (!known).then(|| rivals((model, begins), &augmented.own().follow(&part), j))
    };
    narrowest(&augmented, &model.states).into_iter().enumerate().zip(sizes).map(told).collect()
}

/// Each time history at the moment at which it is known best.
fn narrowest(augmented: &Augmented, states: &States) -> Vec<Part> {
    let mut best: Vec<Option<(f64, Part)>> = vec![None; states.estimated];
    augmented.backwards(|_, estimate| {
        for (j, best) in best.iter_mut().enumerate() {
            let part = estimate.part(&[(states.course(j), 1.0)]);
            let deviation = augmented.own().known(&part).1;
            if best.as_ref().is_none_or(|(least, _)| deviation < *least) {
                *best = Some((deviation, part));
            }
        }
    });
    best.into_iter().flatten().map(|(_, part)| part).collect()
}

/// The other unknowns that move if a time history does, those that move most first. `follow` is the
/// movement of each root.
fn rivals((model, begins): (&Model, &Begins), follow: &[f64], j: usize) -> Vec<Rival> {
    let moves = |place: usize| {
        let of = |root: &Root| root.of[place];
        let whole = model.roots.iter().map(|root| of(root).powi(2)).sum::<f64>().sqrt();
        let moved: f64 = model.roots.iter().zip(follow).map(|(root, by)| of(root) * by).sum();
        moved.abs() / whole
    };
    let others =
        unknowns((model, begins)).into_iter().filter(|(_, rival)| *rival != Rival::Estimated(j));
    let mut all: Vec<(f64, Rival)> = others.map(|(place, rival)| (moves(place), rival)).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let least = SHARE * all.first().map_or(0.0, |(most, _)| *most);
    all.into_iter().filter(|(moved, _)| *moved >= least).map(|(_, rival)| rival).collect()
}

/// The states that are not known exactly, with their names.
fn unknowns((model, begins): (&Model, &Begins)) -> Vec<(usize, Rival)> {
    let states = &model.states;
    let start = |(i, node): (usize, &NodeId)| begins.unknown[i].then_some((i, Rival::Start(*node)));
    let starts = begins.bodies.iter().enumerate().filter_map(start);
    let courses = (0..states.estimated).map(|j| (states.course(j), Rival::Estimated(j)));
    let parameters = (0..states.uncertain).map(|k| (states.parameter(k), Rival::Parameter(k)));
    let reads = states.reads.iter().enumerate();
    let reads = reads
        .map(|(r, read)| (states.read(r), Rival::Sensor { sensor: read.sensor, gain: read.gain }));
    starts.chain(courses).chain(parameters).chain(reads).collect()
}
