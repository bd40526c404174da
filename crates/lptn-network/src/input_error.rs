//! An input that has no value during a run.

use std::fmt;

use lptn_units::{EvalError, format_number};

use crate::id::{Field, Item};

/// A source or boundary whose value could not be had during a run.
#[derive(Clone, Debug)]
pub struct InputError {
    /// The source or boundary.
    pub item: Item,
    /// Its field.
    pub field: Field,
    /// Its name.
    pub name: String,
    /// What went wrong.
    pub problem: InputProblem,
}

/// Why an input has no value.
#[derive(Clone, Debug)]
pub enum InputProblem {
    /// The expression gave an infinite number or none.
    NotFinite(f64),
    /// A temperature below 0 K.
    BelowAbsoluteZero(f64),
    /// The expression could not be evaluated.
    Evaluation(Box<EvalError>),
    /// A conductance below 0 W/K.
    NegativeConductance(f64),
    /// A signal was read before its first point.
    BeforeSignal {
        /// The time in s.
        time: f64,
        /// The first point in s.
        first: f64,
    },
    /// A signal was read after its last point.
    AfterSignal {
        /// The time in s.
        time: f64,
        /// The last point in s.
        last: f64,
    },
    /// A signal that is repeated so often that a run would have to stop at this many points.
    TooManyPoints(f64),
    /// An emissivity or view factor outside 0 to 1.
    NotAFraction(f64),
    /// A quantity that cannot be negative, in SI units.
    Negative(f64),
    /// A volume flow of a fluid whose density is not known.
    NoDensity,
    /// A fluid outside the temperatures for which its specific heat is known and positive.
    OutsideFluid {
        /// The temperature in K.
        temperature: f64,
        /// The temperatures it is known for, in K.
        range: (f64, f64),
    },
    /// The threshold at which a control switches on lies beyond that at which it switches off.
    ThresholdsCrossed {
        /// On, in K.
        on: f64,
        /// Off, in K.
        off: f64,
    },
    /// A node outside the temperatures for which its capacity is known and positive.
    OutsideCapacity {
        /// The temperatures it is known for, in K.
        range: (f64, f64),
    },
}

impl From<EvalError> for InputProblem {
    fn from(error: EvalError) -> Self {
        Self::Evaluation(Box::new(error))
    }
}

impl InputProblem {
    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Evaluation(error) => error.help().map(str::to_owned),
            Self::AfterSignal { .. } => Some(
                "write `after_end = \"hold\"` or `after_end = \"repeat\"` in the signal, or stop the run there"
                    .into(),
            ),
            Self::BeforeSignal { first, .. } => {
                Some(format!("begin the signal earlier, or the run at `start = \"{first} s\"`"))
            }
            Self::NegativeConductance(_) => Some("keep it positive: `max(x, 0 [W/K])` with its own unit".into()),
            Self::TooManyPoints(_) => {
                Some("give the signal a longer period, or put its mean in its place".into())
            }
            Self::NotAFraction(_) => Some("keep it between 0 and 1: `min(max(x, 0), 1)`".into()),
            Self::Negative(_) => Some("keep it positive: `max(x, 0)` with its unit".into()),
            Self::OutsideCapacity { .. } | Self::OutsideFluid { .. } => Some(
                "let the table or expression reach further, or keep the end values of a table with \
                 `outside = \"hold\"`"
                    .into(),
            ),
            Self::ThresholdsCrossed { .. } => {
                Some("keep a dead band between the two, wide enough for the equipment".into())
            }
            Self::NoDensity => Some("add `density` to the fluid, or give a mass flow".into()),
            _ => None,
        }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` of `{}` ", self.field.key(), self.name)?;
        match &self.problem {
            InputProblem::NotFinite(value) => write!(f, "is {value}"),
            InputProblem::BelowAbsoluteZero(value) => write!(f, "is below absolute zero: {value} K"),
            InputProblem::Evaluation(error) => write!(f, "cannot be evaluated: {error}"),
            InputProblem::NegativeConductance(value) => {
                write!(f, "makes a negative conductance: {} W/K", format_number(*value))
            }
            InputProblem::TooManyPoints(count) => {
                write!(f, "repeats the signal so often that the run would stop at {count:.0} points")
            }
            InputProblem::NotAFraction(value) => write!(f, "is not between 0 and 1: {value}"),
            InputProblem::Negative(value) => write!(f, "is negative: {value} (SI units)"),
            InputProblem::BeforeSignal { time, first } => {
                write!(f, "is not known at {time} s: its first point is at {first} s")
            }
            InputProblem::AfterSignal { time, last } => {
                write!(f, "is not known at {time} s: its last point is at {last} s")
            }
            InputProblem::ThresholdsCrossed { on, off } => {
                let celsius = |t: &f64| six_digits(t - crate::typed::ZERO_CELSIUS);
                let (on, off) = (celsius(on), celsius(off));
                write!(f, "crosses over the threshold for off: on at {on} degC, off at {off} degC")
            }
            InputProblem::NoDensity => f.write_str("has no density, which a volume flow needs"),
            InputProblem::OutsideFluid { temperature, range: (from, to) } => {
                write!(f, "is asked for at {temperature} K, but is known from {from} to {to} K only")
            }
            InputProblem::OutsideCapacity { range: (from, to) } => {
                write!(
                    f,
                    "is not known where the temperature goes: it is known and positive from {from} to {to} K only"
                )
            }
        }
    }
}

/// A number without the digits that tell a reader nothing.
fn six_digits(x: f64) -> String {
    format!("{x:.5e}").parse().map_or_else(|_| x.to_string(), format_number)
}

impl std::error::Error for InputError {}
