//! Settings of a run that cannot be.

use std::fmt;

use lptn_network::NoTangents;

use crate::error::six_digits;

/// Settings that contradict themselves.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingsError {
    /// The stop is not after the start, or one of them is not finite.
    Interval {
        /// Start in s.
        start: f64,
        /// Stop in s.
        stop: f64,
    },
    /// The tolerance is not positive and finite.
    Tolerance(f64),
    /// An output time is outside the run or not after the one before it.
    OutputTime(f64),
    /// Two rows are at the same time, because a double cannot tell theirs apart.
    SameTime {
        /// The time in s.
        time: f64,
    },
    /// Something depends on the time, and so far from 0 a double cannot tell times of the run apart well enough.
    FarFromZero {
        /// Start in s.
        start: f64,
        /// Stop in s.
        stop: f64,
        /// The distance of two doubles at the larger one of them, in s.
        resolution: f64,
    },
    /// A window is not inside the run, or its end not after its beginning.
    Window {
        /// Its name.
        name: String,
        /// Its beginning in s.
        from: f64,
        /// Its end in s.
        to: f64,
    },
    /// More temperatures would be kept than fit in memory.
    TooMuch {
        /// Number of rows.
        rows: usize,
        /// Number of nodes to keep.
        nodes: usize,
    },
    /// The distance between outputs is not positive, or so small that there would be too many.
    OutputEvery(f64),
    /// The state to begin with is one of another network, or not finite.
    State,
    /// Sensitivities are asked for that do not exist or are not to be had.
    Sensitivity(NoTangents),
}

impl SettingsError {
    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::SameTime { .. } | Self::FarFromZero { .. } => Some(
                "count the time from the beginning of the run, `start = \"0 s\"`; where an expression needs \
                 the other time, write `(t + 1.7e9 [s])` in place of `t`"
                    .into(),
            ),
            _ => None,
        }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sensitivity(refusal) => {
                write!(f, "no exact sensitivities: {refusal}")
            }
            Self::Interval { start, stop } => {
                write!(f, "a run must stop after it starts, got {start} s to {stop} s")
            }
            Self::Tolerance(value) => write!(f, "the tolerance must be a positive number of K, got {value}"),
            Self::SameTime { time } => write!(
                f,
                "two rows have the same time, {time} s: numbers of this size are {} s apart",
                six_digits(time.abs().next_up() - time.abs())
            ),
            Self::FarFromZero { start, stop, resolution } => write!(
                f,
                "the run from {start} s lasts {} s, but numbers of this size are {} s apart, too coarse for what \
                 depends on the time",
                six_digits(stop - start),
                six_digits(*resolution)
            ),
            Self::Window { name, from, to } => {
                write!(f, "window `{name}` from {from} s to {to} s is not a part of the run")
            }
            Self::OutputTime(time) => {
                write!(f, "the output time {time} s is outside the run or not after the one before it")
            }
            Self::TooMuch { rows, nodes } => write!(
                f,
                "{rows} rows of {nodes} temperatures do not fit in memory: write fewer rows, or select fewer columns"
            ),
            Self::OutputEvery(every) => {
                write!(f, "outputs every {every} s are none, or more than 10 million")
            }
            Self::State => f.write_str("the state to begin with is not one of this network"),
        }
    }
}

impl std::error::Error for SettingsError {}
