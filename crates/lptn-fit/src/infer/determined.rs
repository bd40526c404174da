//! Check that a record determines a time history and that no other unknown hides it.

use crate::infer::model::Model;
use crate::infer::states::States;
use crate::infer::strength::Strength;
use crate::infer::task::InferTask;
use crate::network::Certainty;

/// An unknown state is given a wide deviation. If doubling that deviation widens a band by more
/// than this factor, the band depends on it.
const HANGS: f64 = 1.5;

/// Values with a `±` dominate a band that is this many times as wide as without them.
const HIDDEN: f64 = 2.0;

/// True for each time history that is determined, by its band at the narrowest moment. The band
/// must not depend on an unknown state, whose deviation is an assumption. Values with a `±` must
/// not make it wider than the size of the time history, `sizes`.
pub(crate) fn courses(
    task: &InferTask,
    free: &[bool],
    (model, strength): (&mut Model, &Strength),
    sizes: &[f64],
) -> Vec<bool> {
    let own = deviations(model, strength);
    let wider = unknown(task, &model.states, free);
    let wide = scaled(model, strength, |place| if wider[place] { 2.0 } else { 1.0 });
    let sought: Vec<usize> = (0..sizes.len()).map(|j| model.states.course(j)).collect();
    let exact = scaled(model, strength, |place| f64::from(u8::from(sought.contains(&place))));
    let told = |(j, size): (usize, &f64)| {
        let narrowest = own[j].iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
        let Some((k, deviation)) = narrowest else { return false };
        let hangs = wide[j][k] > HANGS * deviation;
        let hidden = *deviation > HIDDEN * exact[j][k] && deviation > size;
        deviation.is_finite() && !hangs && !hidden
    };
    sizes.iter().enumerate().map(told).collect()
}

/// The states without prior knowledge; `free` marks those of the bodies.
fn unknown(task: &InferTask, states: &States, free: &[bool]) -> Vec<bool> {
    let mut all = vec![false; states.count()];
    free.iter().enumerate().for_each(|(i, free)| all[i] = *free);
    let started = free.contains(&true);
    let slow = states.slow.iter().filter_map(|(column, _)| states.shown(*column));
    slow.for_each(|place| all[place] = started);
    (0..states.sought).for_each(|j| all[states.course(j)] = true);
    for (r, read) in states.reads.iter().enumerate() {
        let sensor = &task.sensors[read.sensor];
        let value = if read.gain { sensor.gain } else { sensor.offset };
        all[states.read(r)] = value.certainty == Certainty::Free;
    }
    all
}

/// The deviations with the prior deviation of each state multiplied by a factor.
fn scaled(model: &mut Model, strength: &Strength, by: impl Fn(usize) -> f64) -> Vec<Vec<f64>> {
    let (own, count) = (model.prior.clone(), model.states.count());
    for (at, covariance) in model.prior.covariance.iter_mut().enumerate() {
        *covariance *= by(at / count) * by(at % count);
    }
    let found = deviations(model, strength);
    model.prior = own;
    found
}

/// Standard deviation of the coordinate of each time history at every moment.
fn deviations(model: &Model, strength: &Strength) -> Vec<Vec<f64>> {
    let (smoother, _) = model.smoothed(strength);
    let states = &model.states;
    let mut all = vec![vec![0.0; model.times.len()]; states.sought];
    smoother.backwards(|k, told| {
        for (j, course) in all.iter_mut().enumerate() {
            course[k] = told.of(&[(states.course(j), 1.0)]).1;
        }
    });
    all
}
