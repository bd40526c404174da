//! Functionals: numbers that follow from the time history of a quantity.
//!
//! This is the one declaration for limits, requirements, reports and sweeps, with the one formula
//! from the statistics of a time history to the number.

use lptn_units::Type;

use crate::value::Value;

/// A functional of a quantity over a run or a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Functional {
    /// The quantity in steady state, or one that depends on parameters alone.
    Value,
    /// Its last value.
    Last,
    /// Its largest value.
    Max,
    /// Its least value.
    Min,
    /// Its mean over time.
    Mean,
    /// Its integral over time.
    Integral,
    /// Time for which it is above a level.
    TimeOver,
    /// Time for which it is below a level.
    TimeUnder,
    /// Life of an insulation or a lubricant at this temperature, by the law of Arrhenius.
    Life,
}

impl Functional {
    /// The functionals with arguments, each with an example.
    pub const CALLED: [(&str, Self, &str); 8] = [
        ("last", Self::Last, "last(ring.T)"),
        ("max", Self::Max, "max(ring.T)"),
        ("min", Self::Min, "min(ring.T)"),
        ("mean", Self::Mean, "mean(ring.T)"),
        ("integral", Self::Integral, "integral(loss.P)"),
        ("time_over", Self::TimeOver, "time_over(ring.T, 110 [degC])"),
        ("time_under", Self::TimeUnder, "time_under(ring.T, 20 [degC])"),
        ("life", Self::Life, "life(ring.T, 20000 [h], 105 [degC], 1 [eV])"),
    ];

    /// Number of its arguments.
    pub fn arity(self) -> usize {
        match self {
            Self::TimeOver | Self::TimeUnder => 2,
            Self::Life => 4,
            _ => 1,
        }
    }

    /// The one of this name with its example; `max(a, b)` is a function of two values, not a
    /// functional of a run.
    pub fn find(name: &str, arguments: usize) -> Option<(Self, &'static str)> {
        let found = Self::CALLED.into_iter().find(|(known, ..)| *known == name);
        let of_values = matches!(name, "max" | "min" | "mean") && arguments > 1;
        found.filter(|_| !of_values).map(|(_, functional, example)| (functional, example))
    }

    /// Its value from the statistics over a run or cycle; `life` is that at the reference in s.
    pub fn of(self, seen: &History, life: Option<f64>) -> f64 {
        match self {
            Self::Value | Self::Last => seen.last,
            Self::Max => seen.max,
            Self::Min => seen.min,
            Self::Mean => seen.mean,
            Self::Integral => seen.mean * seen.length,
            Self::TimeOver | Self::TimeUnder => seen.positive,
            Self::Life => life.unwrap_or(f64::NAN) / seen.mean,
        }
    }

    /// The error of its value, of a life as a share of it, if the mean may be off by a share `open` because the quantity changes
    /// faster than steps resolve.
    pub fn error(self, seen: &History, open: f64) -> f64 {
        let size = seen.min.abs().max(seen.max.abs());
        match self {
            Self::Value | Self::Last => 0.0,
            Self::Max | Self::Min if open > 0.0 => seen.max - seen.min,
            Self::Max | Self::Min => 0.0,
            Self::Mean => open * size,
            Self::Integral => open * size * seen.length,
            Self::TimeOver | Self::TimeUnder => open * seen.length,
            Self::Life => open,
        }
    }

    /// True if it has a value in a steady state: a constant quantity has the same mean over any
    /// time, but its integral grows without end.
    pub fn is_lasting(self) -> bool {
        !matches!(self, Self::Integral | Self::TimeOver | Self::TimeUnder)
    }
}

/// Statistics of a quantity over a run or cycle, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History {
    /// The value at the end.
    pub last: f64,
    /// The least value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// The mean over time.
    pub mean: f64,
    /// Total time in s for which it was above zero.
    pub positive: f64,
    /// Length of the run or cycle in s.
    pub length: f64,
}

impl History {
    /// The time history of a constant quantity. It has no length.
    pub fn constant(value: f64) -> Self {
        let (positive, length) = (f64::NAN, f64::NAN);
        Self { last: value, min: value, max: value, mean: value, positive, length }
    }
}

/// A number over time: a functional of a quantity of the results.
#[derive(Clone, Debug)]
pub struct OverTime {
    /// The functional.
    pub functional: Functional,
    /// The type of the quantity that is followed.
    pub of_ty: Type,
    /// The life at the reference, in s.
    pub life: Option<Value>,
}
