//! The run near which everything is linear.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{Network, NodeId, SignalId};
use lptn_solve::{Proceed, Progress, RecordedNodes, Solution};

use crate::infer::error::InferError;
use crate::infer::task::{InferTask, Start};
use crate::network::{NetworkFitError, follow, line, refined};

/// Is called after every step of a run, and may interrupt it.
pub type InferObserver<'a> = dyn Fn(Progress) -> Proceed + 'a;

/// Tolerance in K of the run of a linear network, and of others.
const TOLERANCES: [f64; 2] = [1e-10, 1e-8];

/// The times that count: the start, if it is known, and the rows of the record.
#[derive(Clone, Debug)]
pub(crate) struct Moments {
    /// Times in s, ascending.
    pub(crate) times: Vec<f64>,
    /// Number of moments before the first row of the record.
    pub(crate) before: usize,
}

impl Moments {
    pub(crate) fn of(task: &InferTask) -> Result<Self, InferError> {
        let (start, mut times) = (task.run.settings.start(), task.run.times.clone());
        let span = (times.first().copied(), times.last().copied());
        if let (Some(first), Some(last)) = span
            && first < start
        {
            let (record, span) = (task.run.name.clone(), (first, last));
            return Err(NetworkFitError::Times { record, span, start }.into());
        }
        let behind = times.first().is_some_and(|first| *first > start);
        let before = usize::from(task.start == Start::Known && behind);
        if before > 0 {
            times.insert(0, start);
        }
        match times.len() {
            0..2 => Err(InferError::Short),
            _ => Ok(Self { times, before }),
        }
    }
}

/// The reference: time histories, parameters and temperatures at the start.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    /// Values of each estimated signal in SI units at every moment, with straight lines between.
    pub(crate) courses: Vec<Vec<f64>>,
    /// Value of each uncertain parameter.
    pub(crate) parameters: Vec<f64>,
    /// Nodes that do not begin as the network says, in K.
    pub(crate) initial: Vec<(NodeId, f64)>,
    /// Value of each uncertain offset or gain of an instrument.
    pub(crate) reads: Vec<f64>,
}

/// The run of a reference.
pub(crate) struct Ran {
    /// Temperature of every node in K at every moment.
    pub(crate) nodes: Vec<Vec<f64>>,
    /// Reading of each column's instrument in K at every moment, without offset and gain.
    pub(crate) shown: Vec<Vec<f64>>,
}

/// Change of a reference that shows its effects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Changed {
    Nothing,
    /// A time history, by this amount everywhere.
    Course(usize, f64),
    /// An uncertain parameter.
    Parameter(usize, f64),
}

impl Reference {
    /// The same with time histories that are constant over two moments.
    pub(crate) fn twice(&self) -> Self {
        let courses = self.courses.iter().map(|course| vec![course[0]; 2]).collect();
        Self { courses, ..self.clone() }
    }

    /// The network whose run it is.
    pub(crate) fn network(
        &self,
        task: &InferTask,
        times: &[f64],
        changed: Changed,
    ) -> Result<Network, InferError> {
        let mut parameters = task.run.parameters.clone();
        for (k, (own, value)) in task.uncertain.iter().zip(&self.parameters).enumerate() {
            let more = if let Changed::Parameter(of, by) = changed
                && of == k
            {
                by
            } else {
                0.0
            };
            parameters.set(own.parameter, value + more);
        }
        let network = task.network.with(&parameters).map_err(ChangeError::from)?;
        let mut signals = task.inputs();
        for (j, (estimated, course)) in task.estimated.iter().zip(&self.courses).enumerate() {
            let more = if let Changed::Course(of, by) = changed
                && of == j
            {
                by
            } else {
                0.0
            };
            signals
                .push((estimated.signal, line(times, course.iter().map(|s| s + more).collect())));
        }
        Ok(network.recorded(&signals, &self.initial).map_err(ChangeError::from)?)
    }

    /// Its run.
    pub(crate) fn run(
        &self,
        task: &InferTask,
        (system, times): (&ThermalSystem, &[f64]),
        observer: &InferObserver<'_>,
    ) -> Result<Ran, InferError> {
        let lags = task.run.columns.iter().filter_map(|c| Some(task.sensors[c.sensor?].lag.value));
        let least = lags.filter(|lag| *lag > 0.0).fold(f64::INFINITY, f64::min);
        let all = if least.is_finite() { refined(times, least) } else { times.to_vec() };
        let solution = self.solution(task, (system, &all), observer)?;
        let places = places(&all, times);
        let nodes = places.iter().map(|&row| solution.row(row).to_vec()).collect();
        let shown = task.run.columns.iter().map(|column| {
            let sum = |row: usize| {
                let row = solution.row(row);
                column.nodes().iter().map(|(id, factor)| factor * row[id.index()]).sum::<f64>()
            };
            let lag = column.sensor.map_or(0.0, |sensor| task.sensors[sensor].lag.value);
            if lag > 0.0 {
                let over_zero: Vec<f64> =
                    (0..all.len()).map(|row| sum(row) - column.zero()).collect();
                let followed = follow(&all, &over_zero, lag).course;
                return places.iter().map(|&row| followed[row] + column.zero()).collect();
            }
            places.iter().map(|&row| sum(row)).collect()
        });
        Ok(Ran { nodes, shown: shown.collect() })
    }

    fn solution(
        &self,
        task: &InferTask,
        (system, times): (&ThermalSystem, &[f64]),
        observer: &InferObserver<'_>,
    ) -> Result<Solution, InferError> {
        let (start, stop) = (times[0], times[times.len() - 1]);
        let run = task.run.settings.clone().keeping(RecordedNodes::All).lasting(start, stop);
        let run = run.at(times[1..times.len() - 1].to_vec());
        let run = run.within(TOLERANCES[usize::from(!system.is_proportional())]);
        Ok(run.solve(system, &mut |step| observer(step))?.result)
    }

    /// Own value of an estimated signal at the moments.
    pub(crate) fn own(network: &Network, signal: SignalId, times: &[f64]) -> Vec<f64> {
        let mut scope = network.evaluation();
        let at = |&time: &f64| {
            scope.set_time(time, time);
            scope.signal(signal)
        };
        times.iter().map(at).collect()
    }
}

/// Indices of times among others that contain them all.
fn places(all: &[f64], times: &[f64]) -> Vec<usize> {
    let mut from = 0;
    let place = |time: &f64| {
        from += all[from..].iter().position(|other| other >= time).unwrap_or(0);
        from
    };
    times.iter().map(place).collect()
}
