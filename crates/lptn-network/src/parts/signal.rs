//! Signals: named time histories, as points or as an expression.

use lptn_units::{Interpolation, Table1, Type, Unit};

use crate::input_error::InputProblem;
use crate::value::Value;

/// A named value that changes with time.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// The type of its values.
    pub ty: Type,
    /// Its time history.
    pub course: Course,
    /// The unit in which it is given and shown; `None` for the SI unit. It is not used to compute.
    pub unit: Option<Unit>,
}

/// The time history of a signal.
#[derive(Clone, Debug)]
pub enum Course {
    /// Points, joined by straight lines or by a monotone cubic (pchip).
    Curve {
        /// Times in s and values in SI units.
        points: Table1,
        /// Its behaviour after the last point.
        after: AfterEnd,
    },
    /// Points; each value stays until the next: right-continuous steps.
    Steps {
        /// Times in s, strictly increasing.
        times: Vec<f64>,
        /// Values in SI units.
        values: Vec<f64>,
        /// Its behaviour after the last point.
        after: AfterEnd,
    },
    /// An expression over `t`, parameters and the signals before this one.
    Expression(Value),
}

/// The most points of one signal at which a run stops.
const MOST_POINTS: f64 = 5e6;

/// Behaviour of a signal after its last point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AfterEnd {
    /// The run fails there.
    Error,
    /// The last value stays.
    Hold,
    /// It restarts each time this period in s has passed since the first point; between the last
    /// point and the restart its last value stays.
    Repeat(f64),
}

/// Interpolation between the points of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    /// Straight lines.
    Linear,
    /// The value of the point before.
    Previous,
    /// A monotone cubic through the points.
    Pchip,
}

impl Course {
    /// First and last point in s; an expression reaches from minus to plus infinity.
    pub fn span(&self) -> (f64, f64) {
        let times = self.times();
        (
            times.first().copied().unwrap_or(f64::NEG_INFINITY),
            times.last().copied().unwrap_or(f64::INFINITY),
        )
    }

    fn times(&self) -> &[f64] {
        match self {
            Self::Curve { points, .. } => points.knots(),
            Self::Steps { times, .. } => times,
            Self::Expression(_) => &[],
        }
    }

    /// Its behaviour after the last point.
    pub fn after(&self) -> AfterEnd {
        match self {
            Self::Curve { after, .. } | Self::Steps { after, .. } => *after,
            Self::Expression(_) => AfterEnd::Error,
        }
    }

    /// True unless it repeats after a period that is shorter than its points reach.
    pub fn is_covered(&self) -> bool {
        let AfterEnd::Repeat(period) = self.after() else { return true };
        let (first, last) = self.span();
        period > 0.0 && period.is_finite() && period >= (last - first) * (1.0 - 1e-12)
    }

    /// True if it is a straight line between its points.
    pub(crate) fn is_straight(&self) -> bool {
        match self {
            Self::Curve { points, .. } => points.interpolation() == Interpolation::Linear,
            Self::Steps { .. } => true,
            Self::Expression(_) => false,
        }
    }

    /// True if it goes one way only between two of its points.
    pub(crate) fn is_monotone(&self) -> bool {
        !matches!(self, Self::Expression(_))
    }

    /// The start of the repetition that `segment` lies in, less that of the first; 0 without
    /// repetition.
    pub(crate) fn offset(&self, segment: f64) -> f64 {
        match self.after() {
            AfterEnd::Repeat(period) => self.repetition(segment, period) * period,
            AfterEnd::Error | AfterEnd::Hold => 0.0,
        }
    }

    /// Number of completed repetitions at a time. There is none before the first point.
    fn repetition(&self, time: f64, period: f64) -> f64 {
        ((time - self.span().0) / period).floor().max(0.0)
    }

    /// Adds the points that lie strictly inside `(start, stop)`. If the signal is smooth between
    /// its ends and only `bends` are requested, these are the ends.
    ///
    /// # Errors
    /// The number of points, if that is more than [`MOST_POINTS`].
    pub(crate) fn points(
        &self,
        (start, stop): (f64, f64),
        bends: bool,
        out: &mut Vec<f64>,
    ) -> Result<(), f64> {
        let (first, last) = self.span();
        let ends = [first, last];
        let times = if bends && !self.is_straight() && !self.times().is_empty() {
            &ends
        } else {
            self.times()
        };
        let (from, to, period) = match self.after() {
            AfterEnd::Repeat(p) => (self.repetition(start, p), self.repetition(stop, p), p),
            AfterEnd::Error | AfterEnd::Hold => (0.0, 0.0, 0.0),
        };
        let count = (to - from + 1.0) * times.len() as f64;
        if count.is_nan() || count > MOST_POINTS {
            return Err(count);
        }
        let mut k = from;
        while k <= to {
            let shifted = times.iter().map(|time| time + k * period);
            out.extend(shifted.filter(|time| *time > start && *time < stop));
            k += 1.0;
        }
        Ok(())
    }

    /// True if its points can be read: as many values as times, one at least, all numbers, the
    /// times rising.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Self::Steps { times, values, .. } => {
                let rises = times.windows(2).all(|pair| pair[0] < pair[1]);
                let numbers = times.iter().chain(values).all(|x| x.is_finite());
                !times.is_empty() && times.len() == values.len() && rises && numbers
            }
            Self::Curve { .. } | Self::Expression(_) => true,
        }
    }
}

/// The place of a signal that the readings of one segment share.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spot {
    /// The start of the repetition, less that of the first, in s.
    offset: f64,
    /// The piece of the last reading.
    piece: usize,
}

impl Signal {
    /// True if it is an expression and has no points.
    pub(crate) fn is_expression(&self) -> bool {
        matches!(self.course, Course::Expression(_))
    }

    /// The place of its readings in a segment.
    pub(crate) fn spot(&self, segment: f64) -> Spot {
        Spot { offset: self.course.offset(segment), piece: 0 }
    }

    /// The value at `time`, on the piece on which `segment` lies.
    pub(crate) fn at(
        &self,
        (time, segment): (f64, f64),
        spot: &mut Spot,
        slots: &[f64],
        stack: &mut Vec<f64>,
    ) -> Result<f64, InputProblem> {
        if let Course::Expression(value) = &self.course {
            return value.on(slots, stack).map_err(InputProblem::from);
        }
        let (first, last) = self.course.span();
        let (time, segment) = (time - spot.offset, segment - spot.offset);
        // a run may end at the last point: rounding must not carry it past
        let margin = 1e-9 * (last - first).max(first.abs().max(last.abs()) * 1e-3);
        if time < first - margin {
            return Err(InputProblem::BeforeSignal { time, first });
        }
        if time > last + margin && self.course.after() == AfterEnd::Error {
            return Err(InputProblem::AfterSignal { time, last });
        }
        Ok(match &self.course {
            Course::Curve { points, .. } => {
                let found = points.value_and_slope_near(time.clamp(first, last), &mut spot.piece);
                found.map_or(f64::NAN, |(value, _)| value)
            }
            Course::Steps { times, values, .. } => {
                let after = times.partition_point(|&t| t <= segment);
                values[after.saturating_sub(1)]
            }
            Course::Expression(_) => f64::NAN,
        })
    }
}
