//! The prior at the start, before anything is read.
//!
//! The first rows are known to about 1e-9 of a standard deviation, because the prior is 30 times
//! wider than needed to explain the record. A wider prior would cost digits where the smoother
//! removes it; a narrower one would influence the result.

use lptn_network::NodeId;

use crate::infer::error::InferError;
use crate::infer::reference::{Changed, Reference};
use crate::infer::states::{States, UNKNOWN_KELVIN};
use crate::infer::task::{InferTask, Start, Uncertain};
use crate::kalman::Gaussian;

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
    ) -> Gaussian {
        let count = states.count();
        let mut mean = vec![0.0; count];
        let mut roots: Vec<Vec<f64>> = Vec::new();
        let mut root = |entries: &[(usize, f64)]| {
            let mut root = vec![0.0; count];
            entries.iter().for_each(|(place, spread)| root[*place] = *spread);
            roots.push(root);
        };
        for (i, unknown) in self.unknown.iter().enumerate() {
            if *unknown {
                root(&[(i, UNKNOWN_KELVIN)]);
            }
            mean[i] = self.own[i] - start[i];
        }
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
            root(&entries);
        }
        for k in 0..uncertain {
            let (known, now) = (own.parameters[k], reference.parameters[k]);
            mean[states.parameter(k)] = task.uncertain[k].beyond(known, now);
        }
        for (j, (course, spread)) in courses.iter().zip(spreads).enumerate() {
            root(&[(states.course(j), *spread)]);
            mean[states.course(j)] = *course;
        }
        for (r, read) in states.reads.iter().enumerate() {
            root(&[(states.read(r), read.known.1)]);
            mean[states.read(r)] = read.known.0 - reference.reads[r];
        }
        for all in roots.iter_mut().chain([&mut mean]) {
            for ((column, _), of) in states.slow.iter().zip(shown) {
                let rest = of.iter().map(|(place, weight)| weight * all[*place]).sum();
                states.shown(*column).into_iter().for_each(|place| all[place] = rest);
            }
        }
        let mut covariance = vec![0.0; count * count];
        for root in &roots {
            for (row, a) in covariance.chunks_exact_mut(count).zip(root) {
                row.iter_mut().zip(root).for_each(|(p, b)| *p += a * b);
            }
        }
        Gaussian { mean, covariance }
    }
}

fn identity(count: usize) -> Vec<f64> {
    (0..count * count).map(|at| if at / count == at % count { 1.0 } else { 0.0 }).collect()
}
