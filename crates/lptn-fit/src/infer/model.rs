//! A record and a network, linear near a reference: transitions of the states and their readings.

use std::rc::Rc;

use lptn_network::NodeId;

use crate::infer::discrete::Discrete;
use crate::infer::error::InferError;
use crate::infer::linear::{Linear, Linearise, Systems, measured};
use crate::infer::prior::{Begins, Root};
use crate::infer::reference::{InferObserver, Moments, Ran, Reference};
use crate::infer::states::States;
use crate::infer::strength::{Jump, Noise, Strength};
use crate::infer::task::InferTask;
use crate::kalman::{
    Augmented, Fade, Filter, Gaussian, Innovation, Reading, Smoother, Step, Weights,
};

/// Largest number of bodies that are followed.
const MOST: usize = 100;

/// Rates that differ by less than this part of the largest are the same, and so are times.
const SAME: f64 = 1e-11;

/// Prior deviation of a time history, in sizes that would explain all readings.
const FAR: f64 = 30.0;

/// Standard deviation of a jump, in sizes of its time history.
const JUMP: f64 = 3.0;

/// Surprise of each reading of each moment, with its column.
type Surprises = Vec<Vec<(usize, Innovation)>>;

/// The model that the readings are compared with.
pub(crate) struct Model {
    pub(crate) states: States,
    /// Temperature of every node in K at every moment of the reference.
    pub(crate) reference: Vec<Vec<f64>>,
    /// Reading of each column's instrument in K at every moment, without offset and gain.
    pub(crate) shown: Vec<Vec<f64>>,
    /// Effect of the states on the temperature of every node.
    pub(crate) nodes: Vec<Vec<Vec<(usize, f64)>>>,
    /// Transition between each two moments, and the input to the states that change as the time
    /// histories of the reference rise.
    steps: Vec<(Rc<Discrete>, Rc<Vec<f64>>)>,
    /// Readings at each moment.
    readings: Vec<Vec<Read>>,
    pub(crate) prior: Gaussian,
    /// The unknowns of the prior.
    pub(crate) roots: Vec<Root>,
    /// Size of each time history in its coordinate, from all readings.
    pub(crate) sizes: Vec<f64>,
    /// The moments in s.
    pub(crate) times: Vec<f64>,
}

/// A value of a column.
#[derive(Clone, Debug)]
pub(crate) struct Read {
    pub(crate) column: usize,
    pub(crate) of: Rc<Weights>,
    /// Difference from the reading of the reference in K.
    pub(crate) beyond: f64,
}

/// One unit of the coordinate of a time history in SI units: of its logarithm or itself.
fn slope(positive: bool, value: f64) -> f64 {
    if positive { value } else { 1.0 }
}

impl Model {
    /// `sizes` are those of the first round, before anything was explained.
    pub(crate) fn new(
        task: &InferTask,
        (moments, begins): (&Moments, &Begins),
        (reference, own): (&Reference, &Reference),
        (sizes, observer): (&[f64], &InferObserver<'_>),
    ) -> Result<Self, InferError> {
        let times = &moments.times;
        let systems = Systems::new(task, (reference, times))?;
        let states = States::of(task, systems.own.states().len());
        if states.bodies > MOST {
            return Err(InferError::Large { nodes: states.bodies, most: MOST });
        }
        let Ran { nodes, shown } = reference.run(task, (&systems.own, times), observer)?;
        let mut look = Linearise::new(task, &states, &systems)?;
        let mut all: Vec<Linear> = Vec::with_capacity(times.len());
        for (k, (&time, there)) in times.iter().zip(&nodes).enumerate() {
            let bodies = look.carried(there)?;
            let courses = task.estimated.iter().zip(&reference.courses);
            let slopes = courses.map(|(estimated, course)| slope(estimated.positive, course[k]));
            let uncertain = task.uncertain.iter().zip(&reference.parameters);
            let deviations = uncertain.map(|(own, value)| own.unit(*value));
            let slopes: Vec<f64> = slopes.chain(deviations).collect();
            all.push(look.at((time, &bodies), &slopes)?);
        }
        let steps = steps((task, &states), (times, reference), &all);
        let readings = readings((task, moments), (&states, reference), (&all, &shown));
        let mut model = Self {
            shown,
            reference: nodes,
            nodes: all.iter().map(|linear| linear.nodes.clone()).collect(),
            steps,
            readings,
            prior: Gaussian { mean: Vec::new(), covariance: Vec::new() },
            roots: Vec::new(),
            sizes: Vec::new(),
            times: times.clone(),
            states,
        };
        model.sizes = match sizes {
            [] => model.found_sizes(task)?,
            known => known.to_vec(),
        };
        let far: Vec<f64> = model.sizes.iter().map(|size| FAR * size).collect();
        let from = coordinates(task, own, 0).into_iter().zip(coordinates(task, reference, 0));
        let courses: Vec<f64> = from.map(|(own, reference)| own - reference).collect();
        let exposed: Vec<_> = model
            .states
            .slow
            .iter()
            .map(|(column, _)| measured(task, *column, &model.nodes[0]))
            .map(|of| of.into_iter().filter(|(i, _)| *i < model.states.bodies).collect())
            .collect();
        let start = start(&begins.bodies, &model.reference[0]);
        let at = (reference, own, start.as_slice());
        let prior = begins.prior((task, &model.states), at, (&courses, &far), &exposed);
        (model.prior, model.roots) = prior;
        Ok(model)
    }

    /// Effect of the states on the temperature of a node at a moment.
    pub(crate) fn weights(&self, k: usize, node: usize) -> &Weights {
        &self.nodes[k][node]
    }

    /// Advances a filter to a moment and takes its readings in.
    pub(crate) fn advance(
        &self,
        filter: &mut Filter,
        k: usize,
        strength: &Strength,
    ) -> Vec<(usize, Innovation)> {
        if k > 0 {
            filter.predict(&Walks { model: self, strength, last: None }.step(k));
        }
        let readings = self.readings[k].iter();
        let noises = &strength.noises;
        readings.map(|read| (read.column, filter.update(&read.reading(noises)))).collect()
    }

    /// Size of each constant time history that explains the farthest reading.
    fn found_sizes(&self, task: &InferTask) -> Result<Vec<f64>, InferError> {
        let all = self.readings.iter().flatten();
        let farthest = all.map(|read| read.beyond.abs()).fold(0.0, f64::max);
        let noise = task.run.columns.iter().filter_map(|column| column.sigma).fold(0.0, f64::max);
        let size = |(j, estimated): (usize, &crate::infer::Estimated)| {
            let answer = self.answer(j);
            if !(answer > 0.0 && answer.is_finite()) {
                return Err(InferError::Unfelt { signal: estimated.name.clone() });
            }
            let size = (farthest + noise).max(1e-3) / answer;
            Ok(if estimated.positive { size.min(1.0) } else { size })
        };
        task.estimated.iter().enumerate().map(size).collect()
    }

    /// The farthest reading that a time history of constantly 1 causes.
    fn answer(&self, j: usize) -> f64 {
        let mut state = vec![0.0; self.states.count()];
        state[self.states.course(j)] = 1.0;
        let mut farthest: f64 = 0.0;
        for (k, readings) in self.readings.iter().enumerate() {
            if k > 0 {
                state = self.steps[k - 1].0.transition.advanced(&[], &state);
            }
            for read in readings {
                let sum: f64 = read.of.iter().map(|(place, h)| h * state[*place]).sum();
                farthest = farthest.max(sum.abs());
            }
        }
        farthest
    }

    /// The same with one more state after all others: the steady drift of a column's instrument
    /// over the record in K, known to `spread`.
    pub(crate) fn drifting(&self, column: usize, spread: f64) -> Self {
        let count = self.states.count() + 1;
        let longer = |row: &[f64]| row.iter().copied().chain([0.0]).collect::<Vec<f64>>();
        let mut covariance: Vec<f64> =
            self.prior.covariance.chunks_exact(count - 1).flat_map(longer).collect();
        covariance.extend((1..count).map(|_| 0.0).chain([spread * spread]));
        let (first, last) = (self.times[0], self.times[self.times.len() - 1]);
        let read = |time: f64, read: &Read| {
            if read.column != column {
                return read.clone();
            }
            let drifted = (count - 1, (time - first) / (last - first));
            Read { of: read.of.iter().copied().chain([drifted]).collect(), ..read.clone() }
        };
        let readings = self.readings.iter().zip(&self.times);
        Self {
            readings: readings
                .map(|(all, time)| all.iter().map(|one| read(*time, one)).collect())
                .collect(),
            prior: Gaussian { mean: longer(&self.prior.mean), covariance },
            roots: Vec::new(),
            steps: self.steps.clone(),
            reference: Vec::new(),
            shown: Vec::new(),
            nodes: Vec::new(),
            sizes: self.sizes.clone(),
            times: self.times.clone(),
            states: self.states.clone(),
        }
    }

    /// Length of the record in s.
    pub(crate) fn length(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// The logarithm of the probability density of the readings, with these walks and noises.
    pub(crate) fn log_likelihood(&self, strength: &Strength) -> f64 {
        self.filtered(strength).log_likelihood()
    }

    /// The estimate of the last moment.
    pub(crate) fn filtered(&self, strength: &Strength) -> Filter {
        let mut filter = Filter::new(self.sloped(self.begin(&strength.noises), strength));
        let mut walks = Walks { model: self, strength, last: None };
        for (k, readings) in self.readings.iter().enumerate() {
            if k > 0 {
                filter.predict(&walks.step(k));
            }
            readings.iter().for_each(|read| {
                filter.update(&read.reading(&strength.noises));
            });
        }
        filter
    }

    /// The estimates of every moment, and the surprise of each reading.
    pub(crate) fn smoothed(&self, strength: &Strength) -> (Smoother, Surprises) {
        self.smoothed_from(self.sloped(self.begin(&strength.noises), strength), strength)
    }

    /// The estimates of every moment, with the unknowns of the prior outside the covariance.
    pub(crate) fn augmented(&self, strength: &Strength) -> Augmented {
        let Gaussian { mean, covariance } = &self.prior;
        let known = Gaussian { mean: mean.clone(), covariance: vec![0.0; covariance.len()] };
        let known = self.sloped(self.started(known, &strength.noises), strength);
        let roots = self.roots.iter().map(|root| root.of.as_slice());
        Augmented::new(self.smoothed_from(known, strength).0, roots)
    }

    fn smoothed_from(&self, prior: Gaussian, strength: &Strength) -> (Smoother, Surprises) {
        let mut smoother = Smoother::new(prior);
        let mut walks = Walks { model: self, strength, last: None };
        let mut surprises = Vec::with_capacity(self.readings.len());
        for (k, readings) in self.readings.iter().enumerate() {
            if k > 0 {
                smoother.predict(&walks.step(k));
            }
            let noises = &strength.noises;
            let take = |read: &Read| (read.column, smoother.update(&read.reading(noises)));
            surprises.push(readings.iter().map(take).collect());
        }
        (smoother, surprises)
    }

    /// Intensity of the walk to a moment that has the mean and variance of a jump at any time
    /// between.
    fn jump(&self, Jump { to, course }: Jump) -> f64 {
        (JUMP * self.sizes[course]).powi(2) / (self.times[to] - self.times[to - 1])
    }

    /// Effect of a jump by one standard deviation on the states that change.
    pub(crate) fn shock(&self, jump: Jump) -> Vec<f64> {
        let course = self.states.course(jump.course);
        let size = self.states.moving();
        let noise = &self.steps[jump.to - 1].0.noises[2 * jump.course];
        let scale = JUMP * self.sizes[jump.course] / noise[course * (size + 1)];
        noise[course * size..][..size].iter().map(|x| x * scale).collect()
    }

    /// The covariance that is added on the way to a moment.
    pub(crate) fn comes_in(&self, to: usize, strength: &Strength) -> Rc<Vec<f64>> {
        let mut intensities = strength.intensities.clone();
        for jump in strength.jumps.iter().filter(|jump| jump.to == to) {
            intensities[2 * jump.course] += self.jump(*jump);
        }
        self.steps[to - 1].0.noise(&intensities)
    }
}

/// Walks and noises of given strengths. Their covariance stays the same as long as nothing else
/// changes.
struct Walks<'a> {
    model: &'a Model,
    strength: &'a Strength,
    last: Option<(Rc<Discrete>, Step)>,
}

impl Walks<'_> {
    /// Step to a moment.
    fn step(&mut self, to: usize) -> Step {
        let (discrete, input) = &self.model.steps[to - 1];
        let mut step = match &self.last {
            Some((last, step)) if Rc::ptr_eq(last, discrete) => step.clone(),
            _ => {
                let (transition, input) = (Rc::clone(&discrete.transition), Rc::clone(input));
                let noise = discrete.noise(&self.strength.intensities);
                let step = Step { transition, input, noise, fades: self.fades(to) };
                self.last = Some((Rc::clone(discrete), step.clone()));
                step
            }
        };
        step.input = Rc::clone(input);
        if self.strength.jumps.iter().any(|jump| jump.to == to) {
            step.noise = self.model.comes_in(to, self.strength);
        }
        step
    }

    /// Transitions of the states that no other state changes.
    fn fades(&self, to: usize) -> Rc<Vec<Fade>> {
        let (states, times) = (&self.model.states, &self.model.times);
        let drift = |column: &usize| self.strength.noises[*column].fade(times[to] - times[to - 1]);
        let reads = states.reads.iter().map(|_| Fade::NONE);
        Rc::new(reads.chain(states.drifts.iter().map(drift)).collect())
    }
}

impl Read {
    fn reading(&self, noises: &[Noise]) -> Reading {
        let white = noises[self.column].white;
        Reading { of: Rc::clone(&self.of), value: self.beyond, variance: white * white }
    }
}

/// Coordinates of all time histories at one moment.
pub(crate) fn coordinates(task: &InferTask, reference: &Reference, k: usize) -> Vec<f64> {
    let courses = task.estimated.iter().zip(&reference.courses);
    courses.map(|(s, course)| if s.positive { course[k].ln() } else { course[k] }).collect()
}

fn start(bodies: &[NodeId], nodes: &[f64]) -> Vec<f64> {
    bodies.iter().map(|id| nodes[id.index()]).collect()
}

/// Rates between each two moments are the mean of both.
fn steps(
    (task, states): (&InferTask, &States),
    (times, reference): (&[f64], &Reference),
    all: &[Linear],
) -> Vec<(Rc<Discrete>, Rc<Vec<f64>>)> {
    let walks = states.walks();
    let mut last: Option<(Vec<f64>, f64, Rc<Discrete>)> = None;
    let mut steps = Vec::with_capacity(times.len() - 1);
    for k in 1..times.len() {
        let time = times[k] - times[k - 1];
        let both = all[k - 1].rates.iter().zip(&all[k].rates);
        let rates: Vec<f64> = both.map(|(a, b)| 0.5 * (a + b)).collect();
        let discrete = match &last {
            Some((known, long, discrete)) if same((known, *long), (&rates, time), times[k]) => {
                Rc::clone(discrete)
            }
            _ => Rc::new(Discrete::new(&rates, states.moving(), time, &walks)),
        };
        let (before, now) = (coordinates(task, reference, k - 1), coordinates(task, reference, k));
        let both = now.iter().zip(before);
        let rises: Vec<f64> = both.flat_map(|(now, before)| [(before - now) / time, 0.0]).collect();
        steps.push((Rc::clone(&discrete), Rc::new(discrete.input(&rises))));
        last = Some((rates, time, discrete));
    }
    steps
}

fn same((known, long): (&[f64], f64), (rates, time): (&[f64], f64), end: f64) -> bool {
    let most = rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
    (time - long).abs() <= SAME * time + 4.0 * f64::EPSILON * end.abs()
        && known.iter().zip(rates).all(|(a, b)| (a - b).abs() <= SAME * most)
}

fn readings(
    (task, moments): (&InferTask, &Moments),
    (states, reference): (&States, &Reference),
    (all, shown): (&[Linear], &[Vec<f64>]),
) -> Vec<Vec<Read>> {
    let at = |(k, linear): (usize, &Linear)| {
        let Some(row) = k.checked_sub(moments.before) else { return Vec::new() };
        let columns = task.run.columns.iter().enumerate();
        let measured = columns.filter(|(_, column)| !column.values[row].is_nan());
        let one = |(i, column): (usize, &crate::network::MeasuredColumn)| {
            let (of, expected) = linear.reading(task, (states, &reference.reads), (i, shown[i][k]));
            let of = of.into_iter().enumerate().filter(|(_, weight)| weight.abs() > 0.0).collect();
            Read { column: i, of, beyond: column.values[row] - expected }
        };
        measured.map(one).collect()
    };
    all.iter().enumerate().map(at).collect()
}
