//! An input that has no value during a run.

use std::fmt;

use lptn_units::{EvalError, Problem, format_number, format_six as six_digits};

use crate::id::{Field, Item};
use crate::typed::ZERO_CELSIUS;

/// A source or boundary whose value could not be evaluated during a run.
#[derive(Clone, Debug)]
pub struct InputError {
    /// The source or boundary.
    pub item: Item,
    /// Its field.
    pub field: Field,
    /// Its name.
    pub name: String,
    /// The problem.
    pub problem: InputProblem,
}

lptn_units::errors! {
/// Why an input has no value. A sentence follows the name of its field.
#[derive(Clone, Debug)]
pub enum InputProblem {
    /// The expression gave an infinite number or none.
    NotFinite(value: f64) = INPUT, format!("is {value}");
    /// A result that the law of an element does not have there, and why.
    NoResult { name: String, why: &'static str } = INPUT,
        format!("is not known: there is no `{name}` {why}");
    /// A temperature below 0 K.
    BelowAbsoluteZero(value: f64) = INPUT, format!("is below absolute zero: {value} K");
    /// The expression could not be evaluated.
    Evaluation(error: Box<EvalError>) = INPUT, format!("cannot be evaluated: {error}"),
        source error.as_ref(), help Problem::help(error);
    /// A conductance below 0 W/K.
    NegativeConductance(value: f64) = INPUT,
        format!("makes a negative conductance: {} W/K", format_number(*value)),
        help "keep it positive: `max(x, 0 [W/K])` with its own unit";
    /// A signal was read before its first point; times in s.
    BeforeSignal { time: f64, first: f64 } = INPUT,
        format!("is not known at {time} s: its first point is at {first} s"),
        help format!("begin the signal earlier, or the run at `start = \"{first} s\"`");
    /// A signal was read after its last point; times in s.
    AfterSignal { time: f64, last: f64 } = INPUT,
        format!("is not known at {time} s: its last point is at {last} s"),
        help "write `after_end = \"hold\"` or `after_end = \"repeat\"` in the signal, or stop the \
            run there";
    /// A signal with so short a period that a run would have to stop at this many points.
    TooManyPoints(count: f64) = INPUT,
        format!("repeats the signal at {count:.0} points, at each of which the run would stop"),
        help "give the signal a longer period, or use its mean instead";
    /// An emissivity or view factor outside 0 to 1.
    NotAFraction(value: f64) = INPUT, format!("is not between 0 and 1: {value}"),
        help "keep it between 0 and 1: `min(max(x, 0), 1)`";
    /// An angle that no such part has, in degrees.
    Angle(value: f64) = INPUT, format!("is an angle of {value} deg, which no such part has");
    /// A capacity that is not positive, in J/K.
    NoCapacity(value: f64) = INPUT, format!("is not positive: {value} J/K"),
        help "keep the states positive that it reads: give them a `min` above zero";
    /// A quantity that cannot be negative, in SI units.
    Negative(value: f64) = INPUT, format!("is negative: {value} (SI units)"),
        help "keep it positive: `max(x, 0)` with its unit";
    /// A property that a path takes the mean of, at a temperature in K at which it has no value.
    NoMean { temperature: f64 } = INPUT,
        format!(
            "has no mean over the temperatures of the path: near {} degC it changes too quickly, \
             or is not known",
            six_digits(temperature - ZERO_CELSIUS)
        ),
        help "write it as a table, or as an expression that is smooth there";
    /// A volume flow of a fluid whose density is not known.
    NoDensity = INPUT, "has no density, which a volume flow needs",
        help "add `density` to the fluid, or give a mass flow";
    /// A fluid outside the temperatures in K for which its specific heat is known and positive.
    OutsideFluid { temperature: f64, range: (f64, f64) } = INPUT,
        format!(
            "is needed at {temperature} K, but is known from {} to {} K only",
            range.0, range.1
        ),
        help FURTHER;
    /// The threshold in K at which a control switches on lies beyond that at which it switches off.
    ThresholdsCrossed { on: f64, off: f64 } = INPUT,
        format!(
            "crosses over the threshold for off: on at {} degC, off at {} degC",
            six_digits(on - ZERO_CELSIUS),
            six_digits(off - ZERO_CELSIUS)
        ),
        help "keep a dead band between the two, wide enough for the equipment";
    /// A node outside the temperatures in K for which its capacity is known and positive.
    OutsideCapacity { range: (f64, f64) } = INPUT,
        format!(
            "is not known at a temperature of the run: it is known and positive from {} to {} K \
             only",
            range.0, range.1
        ),
        help FURTHER;
}
}

const INPUT: &str = "solve::input";

const FURTHER: &str = "let the table or expression reach further, or keep the end values of a \
    table with `outside = \"hold\"`";

impl From<EvalError> for InputProblem {
    fn from(error: EvalError) -> Self {
        Self::Evaluation(Box::new(error))
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` of `{}` {}", self.field.key(), self.name, self.problem)
    }
}

impl std::error::Error for InputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.problem.source()
    }
}

impl Problem for InputError {
    fn code(&self) -> &'static str {
        self.problem.code()
    }

    fn help(&self) -> Option<String> {
        self.problem.help()
    }
}
