//! Indices of the states.

use crate::infer::task::{Drift, InferTask};
use crate::network::Certainty;

/// Prior deviation of unknown temperatures in K, and of unknown logarithms.
pub(crate) const UNKNOWN_KELVIN: f64 = 100.0;

/// Prior deviation of an unknown gain.
const UNKNOWN_GAIN: f64 = 1.0;

/// A value of an instrument that is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reads {
    /// Index of the instrument in the task.
    pub(crate) sensor: usize,
    /// True for its gain, false for its offset.
    pub(crate) gain: bool,
    /// Its prior value, and its standard deviation.
    pub(crate) known: (f64, f64),
}

/// Indices of all states. Those that change with time come first: temperatures, readings of slow
/// instruments, signals with slopes and integrals, and the parameters that rates depend on. Then
/// come the values of instruments and the slow noise of columns, which no other state changes.
#[derive(Clone, Debug)]
pub(crate) struct States {
    /// Number of temperatures.
    pub(crate) bodies: usize,
    /// The columns whose instrument is slow, with its time constant in s.
    pub(crate) slow: Vec<(usize, f64)>,
    /// Number of estimated time histories.
    pub(crate) estimated: usize,
    /// Number of uncertain parameters.
    pub(crate) uncertain: usize,
    /// The values of instruments.
    pub(crate) reads: Vec<Reads>,
    /// The columns whose noise may have a slow part.
    pub(crate) drifts: Vec<usize>,
}

/// Columns of fewer values do not determine how slow their noise is.
const ENOUGH: usize = 30;

impl States {
    pub(crate) fn of(task: &InferTask, bodies: usize) -> Self {
        let slow = task.run.columns.iter().enumerate().filter_map(|(i, column)| {
            let lag = task.sensors[column.sensor?].lag.value;
            (lag > 0.0).then_some((i, lag))
        });
        Self {
            bodies,
            slow: slow.collect(),
            estimated: task.estimated.len(),
            uncertain: task.uncertain.len(),
            reads: reads(task),
            drifts: drifts(task),
        }
    }

    /// Reading of the instrument of a column, if it is slow.
    pub(crate) fn shown(&self, column: usize) -> Option<usize> {
        let place = self.slow.iter().position(|(slow, _)| *slow == column)?;
        Some(self.bodies + place)
    }

    /// An estimated time history.
    pub(crate) fn course(&self, j: usize) -> usize {
        self.bodies + self.slow.len() + j
    }

    /// Its slope, without the steps of its walk.
    pub(crate) fn slope(&self, j: usize) -> usize {
        self.course(self.estimated) + j
    }

    /// The integral of its distance from the reference over time.
    pub(crate) fn area(&self, j: usize) -> usize {
        self.slope(self.estimated) + j
    }

    /// The states that walk: each time history, and its slope.
    pub(crate) fn walks(&self) -> Vec<usize> {
        (0..self.estimated).flat_map(|j| [self.course(j), self.slope(j)]).collect()
    }

    /// An uncertain parameter, or its logarithm, over its standard deviation.
    pub(crate) fn parameter(&self, k: usize) -> usize {
        self.area(self.estimated) + k
    }

    /// Number of states that change, or make others change.
    pub(crate) fn moving(&self) -> usize {
        self.parameter(self.uncertain)
    }

    /// A value of an instrument.
    pub(crate) fn read(&self, r: usize) -> usize {
        self.moving() + r
    }

    /// The slow part of the noise of a column in K, if it may have one.
    pub(crate) fn drift(&self, column: usize) -> Option<usize> {
        let place = self.drifts.iter().position(|own| *own == column)?;
        Some(self.moving() + self.reads.len() + place)
    }

    /// Number of states.
    pub(crate) fn count(&self) -> usize {
        self.moving() + self.reads.len() + self.drifts.len()
    }
}

/// The columns whose noise may have a slow part.
fn drifts(task: &InferTask) -> Vec<usize> {
    let columns = task.run.columns.iter().enumerate();
    let read = |values: &[f64]| values.iter().filter(|value| !value.is_nan()).count();
    let may = columns.filter(|(_, column)| match task.drift {
        Drift::Known { deviation, .. } => deviation > 0.0,
        Drift::Open => read(&column.values) >= ENOUGH,
    });
    may.map(|(i, _)| i).collect()
}

/// The uncertain values of the instruments that columns name.
pub(crate) fn reads(task: &InferTask) -> Vec<Reads> {
    let mut all = Vec::new();
    for (sensor, instrument) in task.sensors.iter().enumerate() {
        if task.run.columns.iter().all(|column| column.sensor != Some(sensor)) {
            continue;
        }
        for (gain, value, unknown) in
            [(false, instrument.offset, UNKNOWN_KELVIN), (true, instrument.gain, UNKNOWN_GAIN)]
        {
            let deviation = match value.certainty {
                Certainty::Exact => continue,
                Certainty::Deviation(deviation) => deviation,
                Certainty::Free => unknown,
            };
            all.push(Reads { sensor, gain, known: (value.value, deviation) });
        }
    }
    all
}
