//! Results of the smoother at every moment.

use lptn_network::NodeId;
use lptn_units::statistics::NORMAL_95;

use crate::infer::determined;
use crate::infer::error::InferError;
use crate::infer::inferred::{Band, Inferred, InferredCourse, InferredSensor, Known};
use crate::infer::jumps;
use crate::infer::model::{Model, coordinates};
use crate::infer::open::mixture;
use crate::infer::reference::{InferObserver, Reference};
use crate::infer::rounds::{Settled, settle};
use crate::infer::strength::Strength;
use crate::infer::surprise;
use crate::infer::task::{Drift, InferTask, Uncertain};
use crate::kalman::Augmented;

/// Infers time histories from a record.
///
/// If the smoothness of the only time history is not given, bands contain 95 % of a mixture. The
/// mixture covers all strengths, weighted by the likelihood of the record (with a density that is
/// even in the logarithm of each intensity). Unknown moments of jumps add variance, one jump after
/// the other.
///
/// # Errors
/// [`InferError`]
pub fn infer(task: &InferTask, observer: &InferObserver<'_>) -> Result<Inferred, InferError> {
    let settled = settle(task, observer)?;
    let mut found = told(task, &settled);
    let Settled { model, strength, begins, .. } = &settled;
    let sizes =
        (0..task.estimated.len()).map(|j| size(task.estimated[j].positive, &found.courses[j]));
    let sizes: Vec<f64> = sizes.collect();
    let rivals = determined::courses((model, begins), strength, &sizes);
    found.courses.iter_mut().zip(rivals).for_each(|(course, rivals)| course.rivals = rivals);
    Ok(found)
}

/// Size of the coordinate of a time history: a factor of e if it is the logarithm.
fn size(positive: bool, course: &InferredCourse) -> f64 {
    let largest = course.band.iter().map(|band| band.value.abs()).fold(0.0, f64::max);
    if positive { 1.0 } else { largest }
}

/// Results of the last round, except whether time histories are determined.
fn told(task: &InferTask, settled: &Settled) -> Inferred {
    let Settled { model, strength, reference, moments, .. } = settled;
    let (smoother, surprises) = model.smoothed(strength);
    let asked = Asked::new(task, settled);
    let mixed = asked.mixed();
    let states = &model.states;
    let final_state = smoother.filter().state();
    let alone = |place: usize, scale: f64| {
        let (value, deviation) = final_state.of(&[(place, 1.0)]);
        Known { value: scale * value, deviation: scale * deviation }
    };
    let sensor = |(r, read): (usize, &crate::infer::states::Reads)| {
        let moved = alone(states.read(r), 1.0);
        let now = Known { value: reference.reads[r] + moved.value, ..moved };
        let before = Known { value: read.known.0, deviation: read.known.1 };
        InferredSensor { sensor: read.sensor, gain: read.gain, before, now }
    };
    let parameter = |(k, own): (usize, &Uncertain)| {
        let moved = alone(states.parameter(k), 1.0);
        let value = own.moved(reference.parameters[k], moved.value);
        Known { value, deviation: own.unit(value) * moved.deviation }
    };
    let still = still(task, (reference, model), strength);
    let courses = (0..task.estimated.len()).map(|j| asked.course(j, &mixed, still[j])).collect();
    Inferred {
        times: moments.times.clone(),
        before: moments.before,
        courses,
        nodes: asked.nodes(&mixed),
        sensors: states.reads.iter().enumerate().map(sensor).collect(),
        parameters: task.uncertain.iter().enumerate().map(parameter).collect(),
        columns: surprise::columns(model, strength, &surprises),
        log_likelihood: smoother.filter().log_likelihood(),
        jumps: jumps::told(model, strength),
        rounds: settled.rounds,
    }
}

/// Each time history if it does not change and the others are as likely as possible, with the
/// log-likelihood then.
fn still(
    task: &InferTask,
    (reference, model): (&Reference, &Model),
    strength: &Strength,
) -> Vec<(Known, f64)> {
    let last = coordinates(task, reference, model.nodes.len() - 1);
    let one = |(j, estimated): (usize, &crate::infer::Estimated)| {
        let (smoother, _) = model.smoothed(&constant((task, model), strength, j));
        let (state, likely) = (smoother.filter().state(), smoother.filter().log_likelihood());
        let (moved, deviation) = state.of(&[(model.states.course(j), 1.0)]);
        let there = last[j] + moved;
        let known = match estimated.positive {
            true => Known { value: there.exp(), deviation: deviation * there.exp() },
            false => Known { value: there, deviation },
        };
        (known, likely)
    };
    task.estimated.iter().enumerate().map(one).collect()
}

/// The most likely walks and jumps of the other time histories if one is constant. The noises are
/// those of `strength`.
fn constant((task, model): (&InferTask, &Model), strength: &Strength, j: usize) -> Strength {
    let mut held = task.clone();
    (held.estimated[j].intensity, held.estimated[j].jumps) = (Some(0.0), false);
    let columns = held.run.columns.iter_mut().zip(&strength.noises);
    columns.for_each(|(column, noise)| column.sigma = Some(noise.white));
    held.drift = Drift::Known { deviation: 0.0, time: 1.0 };
    let start = strength.constant(j).revived(&held, model);
    jumps::most_likely((&held, model), (&start, true))
}

/// Requested values of the states at every moment.
struct Asked<'a> {
    task: &'a InferTask,
    settled: &'a Settled,
    /// The nodes that are reported.
    shown: Vec<NodeId>,
}

impl<'a> Asked<'a> {
    fn new(task: &'a InferTask, settled: &'a Settled) -> Self {
        Self { task, settled, shown: task.network.node_ids().collect() }
    }

    /// Number of values for each moment.
    fn of_moment(&self) -> usize {
        self.task.estimated.len() + self.shown.len()
    }

    /// Means and deviations of all requested values: for each moment coordinates and temperatures,
    /// then the integral of each time history.
    fn of(&self, augmented: &Augmented) -> Vec<(f64, f64)> {
        let (model, states) = (&self.settled.model, &self.settled.model.states);
        let (size, count) = (self.of_moment(), self.settled.moments.times.len());
        let mut all = vec![(0.0, 0.0); size * count + states.estimated];
        augmented.backwards(|k, told| {
            let moment = &mut all[k * size..][..size];
            let coordinates = coordinates(self.task, &self.settled.reference, k);
            for (j, own) in coordinates.iter().enumerate() {
                let (moved, deviation) = told.of(&[(states.course(j), 1.0)]);
                moment[j] = (own + moved, deviation);
            }
            for (known, id) in moment[states.estimated..].iter_mut().zip(&self.shown) {
                let (moved, deviation) = told.of(model.weights(k, id.index()));
                *known = (model.reference[k][id.index()] + moved, deviation);
            }
            if k + 1 == count {
                let areas = (0..states.estimated).map(|j| told.of(&[(states.area(j), 1.0)]));
                all[size * count..].iter_mut().zip(areas).for_each(|(known, area)| *known = area);
            }
        });
        all
    }

    fn mixed(&self) -> Vec<(f64, f64)> {
        let Settled { model, strength, .. } = self.settled;
        mixture((self.task, model, strength), |augmented| self.of(augmented))
    }

    fn course(&self, j: usize, mixed: &[(f64, f64)], still: (Known, f64)) -> InferredCourse {
        let (count, positive) = (self.settled.moments.times.len(), self.task.estimated[j].positive);
        let coordinate = |k: usize| mixed[k * self.of_moment() + j];
        let band = |k: usize| {
            let (value, deviation) = coordinate(k);
            let half = NORMAL_95 * deviation;
            let back = |x: f64| if positive { x.exp() } else { x };
            Band { value: back(value), ends: (back(value - half), back(value + half)) }
        };
        let length = self.settled.model.length();
        let mean = || {
            let (area, deviation) = mixed[count * self.of_moment() + j];
            let (times, own) = (&self.settled.moments.times, &self.settled.reference.courses[j]);
            let own = times.windows(2).zip(own.windows(2));
            let own: f64 = own.map(|(t, s)| 0.5 * (s[0] + s[1]) * (t[1] - t[0])).sum();
            Known { value: (own + area) / length, deviation: deviation / length }
        };
        InferredCourse {
            band: (0..count).map(band).collect(),
            rivals: None,
            mean: (!positive).then(mean),
            before: self.before(j),
            intensity: self.settled.strength.intensities[2 * j],
            slope_intensity: self.settled.strength.intensities[2 * j + 1],
            still,
        }
    }

    fn before(&self, j: usize) -> Known {
        let model = &self.settled.model;
        let place = model.states.course(j);
        let (moved, deviation) = model.prior.of(&[(place, 1.0)]);
        let own = coordinates(self.task, &self.settled.reference, 0)[j];
        Known { value: own + moved, deviation }
    }

    fn nodes(&self, mixed: &[(f64, f64)]) -> Vec<(NodeId, Vec<Known>)> {
        let (size, count) = (self.of_moment(), self.settled.moments.times.len());
        let first = self.task.estimated.len();
        let one = |(i, id): (usize, &NodeId)| {
            let known = |k: usize| {
                let (value, deviation) = mixed[k * size + first + i];
                Known { value, deviation }
            };
            (*id, (0..count).map(known).collect())
        };
        self.shown.iter().enumerate().map(one).collect()
    }
}
