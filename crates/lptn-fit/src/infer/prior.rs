//! The prior at the start, before anything is read.
//!
//! It is 30 times wider than needed to explain the record. A narrower one would influence the result.
//! Estimates of rows take the unknowns apart ([`crate::kalman::Augmented`]): in the covariance, a wide
//! prior would cost the digits of the first rows.

use lptn_network::NodeId;

use crate::infer::error::InferError;
use crate::infer::reference::{Changed, Reference};
use crate::infer::states::{States, UNKNOWN_KELVIN};
use crate::infer::task::{InferTask, Start, Uncertain};
use crate::kalman::Gaussian;
use crate::network::Certainty;

/// The start of the network itself, with its uncertain parameters at their own values.
#[derive(Clone, Debug)]
pub(crate) struct Begins {
    /// Temperature of each body in K.
    own: Vec<f64>,
    /// Its change by a standard deviation of each uncertain parameter.
    by_parameter: Vec<Vec<f64>>,
    /// True if nothing is known of it.
    pub(crate) unknown: Vec<bool>,
    /// Node of each body.
    pub(crate) bodies: Vec<NodeId>,
}

/// An unknown at the start, in its prior standard deviation.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    /// Change of the states.
    pub(crate) of: Vec<f64>,
    pub(crate) before: Before,
}

/// Knowledge of an unknown before the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Before {
    /// None: it is an estimated time history.
    Estimated,
    /// None: its deviation is an assumption.
    Nothing,
    /// Its standard deviation.
    Spread,
}

impl Begins {
    pub(crate) fn of(
        task: &InferTask,
        (own, bodies, times): (&Reference, &[NodeId], &[f64]),
    ) -> Result<Self, InferError> {
        let at = |changed: Changed| -> Result<Vec<f64>, InferError> {
            let network = own.network(task, times, changed)?;
            Ok(bodies.iter().map(|&id| network.initial(id)).collect())
        };
        let change = |(k, (uncertain, value)): (usize, (&Uncertain, &f64))| {
            let by = 0.5 * uncertain.unit(*value);
            let (below, above) = (at(Changed::Parameter(k, -by))?, at(Changed::Parameter(k, by))?);
            Ok(above.iter().zip(below).map(|(above, below)| above - below).collect())
        };
        let by_parameter: Result<_, InferError> =
            task.uncertain.iter().zip(&own.parameters).enumerate().map(change).collect();
        // a difference of two temperatures does not determine where either begins
        let absolute = task.run.columns.iter().filter(|column| column.ty.absolute);
        let measured: Vec<NodeId> =
            absolute.flat_map(|column| column.nodes()).map(|(node, _)| *node).collect();
        let unknown = |id: &NodeId| match task.start {
            Start::Known => false,
            Start::Measured => measured.contains(id),
            Start::Free => true,
        };
        Ok(Self {
            own: at(Changed::Nothing)?,
            by_parameter: by_parameter?,
            unknown: bodies.iter().map(unknown).collect(),
            bodies: bodies.to_vec(),
        })
    }

    /// True if a body may begin at another temperature than that of the network's own parameters.
    pub(crate) fn may_move(&self, body: usize) -> bool {
        self.unknown[body] || self.by_parameter.iter().any(|change| change[body].abs() > 0.0)
    }

    /// Distribution of the states relative to a reference with this start. `spreads` is the
    /// deviation of each time history, `shown` the reading of a slow instrument as a sum over
    /// bodies.
    pub(crate) fn prior(
        &self,
        (task, states): (&InferTask, &States),
        (reference, own, start): (&Reference, &Reference, &[f64]),
        (courses, spreads): (&[f64], &[f64]),
        shown: &[Vec<(usize, f64)>],
    ) -> (Gaussian, Vec<Root>) {
        let count = states.count();
        let mut mean = vec![0.0; count];
        for (i, own) in self.own.iter().enumerate() {
            mean[i] = own - start[i];
        }
        for k in 0..states.uncertain {
            let (known, now) = (own.parameters[k], reference.parameters[k]);
            mean[states.parameter(k)] = task.uncertain[k].beyond(known, now);
        }
        for (j, course) in courses.iter().enumerate() {
            mean[states.course(j)] = *course;
        }
        for (r, read) in states.reads.iter().enumerate() {
            mean[states.read(r)] = read.known.0 - reference.reads[r];
        }
        let mut roots = self.roots((task, states), spreads);
        for all in roots.iter_mut().map(|root| &mut root.of).chain([&mut mean]) {
            for ((column, _), of) in states.slow.iter().zip(shown) {
                let rest = of.iter().map(|(place, weight)| weight * all[*place]).sum();
                states.shown(*column).into_iter().for_each(|place| all[place] = rest);
            }
        }
        let mut covariance = vec![0.0; count * count];
        for Root { of, .. } in &roots {
            for (row, a) in covariance.chunks_exact_mut(count).zip(of) {
                row.iter_mut().zip(of).for_each(|(p, b)| *p += a * b);
            }
        }
        (Gaussian { mean, covariance }, roots)
    }

    /// The unknowns, without their effect on slow instruments.
    fn roots(&self, (task, states): (&InferTask, &States), spreads: &[f64]) -> Vec<Root> {
        let mut roots: Vec<Root> = Vec::new();
        let mut root = |before: Before, entries: &[(usize, f64)]| {
            let mut of = vec![0.0; states.count()];
            entries.iter().for_each(|(place, spread)| of[*place] = *spread);
            roots.push(Root { of, before });
        };
        let unknown = self.unknown.iter().enumerate().filter(|(_, unknown)| **unknown);
        unknown.for_each(|(i, _)| root(Before::Nothing, &[(i, UNKNOWN_KELVIN)]));
        // correlated parameters are sums of independent ones; if that fails, all are independent
        let uncertain = states.uncertain;
        let factor = task.together.factor().unwrap_or_else(|_| identity(uncertain));
        for column in 0..uncertain {
            let share = |k: usize| factor[k * uncertain + column];
            let known = (0..states.bodies).filter(|i| !self.unknown[*i]);
            let of = |i: usize| {
                let changes = self.by_parameter.iter().enumerate();
                changes.map(|(k, change)| share(k) * change[i]).sum()
            };
            let mut entries: Vec<(usize, f64)> = known.map(|i| (i, of(i))).collect();
            entries.extend((0..uncertain).map(|k| (states.parameter(k), share(k))));
            root(Before::Spread, &entries);
        }
        for (j, spread) in spreads.iter().enumerate() {
            root(Before::Estimated, &[(states.course(j), *spread)]);
        }
        for (r, read) in states.reads.iter().enumerate() {
            let sensor = &task.sensors[read.sensor];
            let value = if read.gain { sensor.gain } else { sensor.offset };
            let free = value.certainty == Certainty::Free;
            let before = if free { Before::Nothing } else { Before::Spread };
            root(before, &[(states.read(r), read.known.1)]);
        }
        roots
    }
}

fn identity(count: usize) -> Vec<f64> {
    (0..count * count).map(|at| if at / count == at % count { 1.0 } else { 0.0 }).collect()
}
