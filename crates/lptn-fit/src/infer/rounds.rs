//! Rounds from a task to the estimates, until nothing moves.

use lptn_assembly::{ChangeError, ThermalSystem};

use crate::infer::error::InferError;
use crate::infer::jumps::most_likely;
use crate::infer::model::{Model, coordinates};
use crate::infer::prior::Begins;
use crate::infer::reference::{InferObserver, Moments, Reference};
use crate::infer::strength::Strength;
use crate::infer::task::InferTask;
use crate::infer::unfollowed;
use crate::network::{Certainty, unknown_input};

/// Largest number of rounds.
const MOST: usize = 25;

/// The rounds end if no time history, parameter or instrument moves by more than this part of its
/// standard deviation.
const SETTLED: f64 = 1e-4;

/// After this number of rounds strengths stay as they are. Another search would change them within
/// its tolerance, and nothing would converge.
const SEARCHED: usize = 3;

/// Strengths are not searched again if the logarithm of the likelihood has moved by less.
const SAME: f64 = 1e-3;

/// A round whose time histories no run can follow is halved up to this number of times.
const HALVES: usize = 6;

/// State at the end of the rounds.
pub(crate) struct Settled {
    pub(crate) moments: Moments,
    pub(crate) reference: Reference,
    pub(crate) model: Model,
    pub(crate) strength: Strength,
    pub(crate) begins: Begins,
    pub(crate) rounds: usize,
}

pub(crate) fn settle(
    task: &InferTask,
    observer: &InferObserver<'_>,
) -> Result<Settled, InferError> {
    checked(task)?;
    let moments = Moments::of(task)?;
    let (own, begins) = begun(task, &moments)?;
    let at = |reference: &Reference, sizes: &[f64]| {
        Model::new(task, (&moments, &begins), (reference, &own), (sizes, observer))
    };
    let mut reference = own.clone();
    let mut model = at(&reference, &[])?;
    let sizes = model.sizes.clone();
    let mut strength = Strength::guess(task, &model);
    let mut likely = f64::NEG_INFINITY;
    for round in 1..=MOST {
        // a linear network is the same in every round
        let same = (model.log_likelihood(&strength) - likely).abs() < SAME;
        if round <= SEARCHED && !same {
            let start = (&strength.revived(task, &model), round == 1);
            strength = most_likely((task, &model), start);
            likely = model.log_likelihood(&strength);
        }
        let smoothed = smoothed(&model, &strength);
        let mut next = moved((task, &begins), (&reference, &model), &smoothed, 1.0);
        let far = distance((task, &model), (&reference, &next), &smoothed);
        if far < SETTLED {
            return Ok(Settled { moments, reference, model, strength, begins, rounds: round });
        }
        let mut there = at(&next, &sizes);
        for halves in 1..=HALVES {
            match there {
                Err(InferError::Network(_) | InferError::Run(_) | InferError::Rates(_)) => {}
                _ => break,
            }
            let share = 0.5_f64.powi(halves as i32);
            next = moved((task, &begins), (&reference, &model), &smoothed, share);
            there = at(&next, &sizes);
        }
        (model, reference) = (there.map_err(|error| unfollowed::named(task, error))?, next);
    }
    Err(InferError::NotSettled { rounds: MOST })
}

/// Mean and standard deviation of each state at a moment.
type Known = Vec<(f64, f64)>;

/// The states at every moment.
fn smoothed(model: &Model, strength: &Strength) -> Vec<Known> {
    let count = model.states.count();
    let mut all: Vec<Known> = Vec::with_capacity(model.times.len());
    model.augmented(strength).backwards(|_, estimate| {
        all.push((0..count).map(|i| estimate.of(&[(i, 1.0)])).collect());
    });
    all.reverse();
    all
}

/// Values and start of the network itself.
pub(crate) fn begun(
    task: &InferTask,
    moments: &Moments,
) -> Result<(Reference, Begins), InferError> {
    let own = own(task, moments)?;
    let network = task.network.with(&task.run.parameters).map_err(ChangeError::from)?;
    let system = ThermalSystem::assemble(&network).map_err(ChangeError::from)?;
    let begins = Begins::of(task, (&own, system.states(), &moments.times))?;
    Ok((own, begins))
}

pub(crate) fn checked(task: &InferTask) -> Result<(), InferError> {
    if task.network.has_events() {
        return Err(InferError::Events);
    }
    if let Some(sensor) = unknown_input(&task.run, &task.sensors) {
        return Err(InferError::Input { sensor: sensor.name.clone() });
    }
    let used = task.run.columns.iter().filter_map(|column| column.sensor);
    let unknown = used.map(|sensor| &task.sensors[sensor]);
    match unknown.into_iter().find(|sensor| sensor.lag.certainty != Certainty::Exact) {
        Some(sensor) => Err(InferError::Lag { sensor: sensor.name.clone() }),
        None => Ok(()),
    }
}

/// The time histories and values of the network itself.
fn own(task: &InferTask, moments: &Moments) -> Result<Reference, InferError> {
    let network = task.network.with(&task.run.parameters).map_err(ChangeError::from)?;
    let network = network.recorded(&task.inputs(), &[]).map_err(ChangeError::from)?;
    let course = |estimated: &crate::infer::Estimated| {
        let course = Reference::own(&network, estimated.signal, &moments.times);
        match course.iter().find(|value| estimated.positive && value.is_nan() | (**value <= 0.0)) {
            Some(&value) => Err(InferError::NotPositive { signal: estimated.name.clone(), value }),
            None => Ok(course),
        }
    };
    let courses = task.estimated.iter().map(course).collect::<Result<_, _>>()?;
    let parameters = task.uncertain.iter();
    let parameters = parameters.map(|own| network.parameter_value(own.parameter)).collect();
    let reads = crate::infer::states::reads(task).iter().map(|read| read.known.0).collect();
    Ok(Reference { courses, parameters, initial: Vec::new(), reads })
}

/// Moves a reference by a share of the way to the smoothed states.
fn moved(
    (task, begins): (&InferTask, &Begins),
    (reference, model): (&Reference, &Model),
    smoothed: &[Known],
    share: f64,
) -> Reference {
    let states = &model.states;
    let mut next = reference.clone();
    for (k, known) in smoothed.iter().enumerate() {
        let coordinates = coordinates(task, reference, k);
        for (j, estimated) in task.estimated.iter().enumerate() {
            let there = coordinates[j] + share * known[states.course(j)].0;
            next.courses[j][k] = if estimated.positive { there.exp() } else { there };
        }
    }
    let (first, last) = (&smoothed[0], &smoothed[smoothed.len() - 1]);
    for (k, own) in task.uncertain.iter().enumerate() {
        next.parameters[k] = own.moved(next.parameters[k], share * last[states.parameter(k)].0);
    }
    for (r, read) in next.reads.iter_mut().enumerate() {
        *read += share * last[states.read(r)].0;
    }
    let bodies = begins.bodies.iter().enumerate().filter(|(i, _)| begins.may_move(*i));
    let start = |(i, id): (usize, &lptn_network::NodeId)| {
        (*id, model.reference[0][id.index()] + share * first[i].0)
    };
    next.initial = bodies.map(start).collect();
    next
}

/// Largest movement of an unknown in a round, over its standard deviation.
fn distance(
    (task, model): (&InferTask, &Model),
    (reference, next): (&Reference, &Reference),
    smoothed: &[Known],
) -> f64 {
    let states = &model.states;
    let mut far = unmoving((task, model), (reference, next), &smoothed[smoothed.len() - 1]);
    for (k, known) in smoothed.iter().enumerate() {
        let (from, to) = (coordinates(task, reference, k), coordinates(task, next, k));
        for j in 0..states.estimated {
            let deviation = known[states.course(j)].1;
            let rounding = 1e-9 * to[j].abs();
            far = far.max(((to[j] - from[j]).abs() - rounding).max(0.0) / deviation.max(1e-300));
        }
    }
    far
}

/// The same for constants: parameters, and values of instruments.
fn unmoving(
    (task, model): (&InferTask, &Model),
    (reference, next): (&Reference, &Reference),
    last: &Known,
) -> f64 {
    let states = &model.states;
    let over = |moved: f64, place: usize| moved.abs() / last[place].1.max(1e-300);
    let parameters = task.uncertain.iter().enumerate().map(|(k, own)| {
        over(own.beyond(next.parameters[k], reference.parameters[k]), states.parameter(k))
    });
    let reads =
        (0..states.reads.len()).map(|r| over(next.reads[r] - reference.reads[r], states.read(r)));
    parameters.chain(reads).fold(0.0, f64::max)
}
