//! Inputs of a run from its record: time histories of signals and temperatures at the start, as
//! instruments read them.

use lptn_network::{AfterEnd, Course, NodeId, SignalId, ZERO_CELSIUS};
use lptn_units::{Interpolation, Outside, Table1, Type};

/// A signal that follows the readings of an instrument.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedSignal {
    /// The signal.
    pub signal: SignalId,
    /// Its type.
    pub ty: Type,
    /// The times of the readings in s, ascending, and the readings in SI units; straight lines
    /// between them. Two at least.
    pub times: Vec<f64>,
    /// The readings.
    pub values: Vec<f64>,
    /// Index of the instrument among those of the task; `None` for an ideal one.
    pub sensor: Option<usize>,
}

/// A node that begins at the reading of an instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedStart {
    /// The node.
    pub node: NodeId,
    /// The reading in K.
    pub reading: f64,
    /// Time of the first value in it, in s on the clock of the run.
    pub read_at: f64,
    /// Index of the instrument among those of the task; `None` for an ideal one.
    pub sensor: Option<usize>,
}

/// Assumed values of an instrument: with an offset of 0, a gain of 1 and no lag it is ideal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    pub(crate) offset: f64,
    pub(crate) gain: f64,
    pub(crate) lag: f64,
}

impl Held {
    /// The measured quantity at this reading, counted from `zero`, without the lag.
    fn behind(self, reading: f64, zero: f64) -> f64 {
        zero + (reading - zero - self.offset) / self.gain
    }
}

impl RecordedSignal {
    /// The time history of the signal if the instrument is this one.
    pub(crate) fn course(&self, held: Held) -> Course {
        let zero = if self.ty.absolute { ZERO_CELSIUS } else { 0.0 };
        line(&self.times, self.values.iter().map(|v| held.behind(*v, zero)).collect())
    }
}

impl RecordedStart {
    /// Start of the node if the instrument is this one: it began in rest, whatever its lag.
    pub(crate) fn begins(&self, held: Held) -> (NodeId, f64) {
        (self.node, held.behind(self.reading, ZERO_CELSIUS))
    }
}

/// Straight lines between values, constant before the first and after the last.
pub(crate) fn line(times: &[f64], values: Vec<f64>) -> Course {
    let points = Table1::new(times.to_vec(), values.clone(), Interpolation::Linear, Outside::Hold);
    match points {
        Ok(points) => Course::Curve { points, after: AfterEnd::Hold },
        Err(_) => Course::Steps { times: times.to_vec(), values, after: AfterEnd::Hold },
    }
}
