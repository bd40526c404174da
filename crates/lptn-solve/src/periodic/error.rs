//! Why there is no periodic state.

use std::fmt;

use lptn_network::{InputError, NodeId, NotPeriodic, list_of_names};
use lptn_units::format_number;

use crate::error::TransientError;

/// Why no periodic state was found.
#[derive(Debug)]
pub enum PeriodicError {
    /// An input is not the same one period later.
    NotPeriodic(NotPeriodic),
    /// An input has no value.
    Input(InputError),
    /// Some nodes lead to no boundary and gain or lose heat in every cycle.
    NoBalance {
        /// The nodes.
        nodes: Vec<NodeId>,
        /// Their names.
        names: Vec<String>,
        /// The heat in J that they gain in the first cycle.
        heat: f64,
    },
    /// The cycles do not come to the same state.
    NotFound {
        /// Cycles integrated.
        cycles: usize,
        /// The smallest difference in K between the start of a cycle and its end that was met.
        residual: f64,
    },
    /// What switches never does so in one cycle as in the next.
    Switches {
        /// Cycles integrated.
        cycles: usize,
    },
    /// A cycle could not be integrated.
    Cycle(TransientError),
    /// The observer asked for an end.
    Interrupted {
        /// Cycles that were integrated to their end.
        cycles: usize,
        /// The last difference in K between the start of a cycle and its end, if there was one.
        residual: Option<f64>,
    },
}

impl PeriodicError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotPeriodic(_) => "periodic::not_periodic",
            Self::Input(_) => "solve::input",
            Self::NoBalance { .. } => "periodic::no_balance",
            Self::NotFound { .. } => "periodic::not_found",
            Self::Switches { .. } => "periodic::switches",
            Self::Cycle(error) => error.code(),
            Self::Interrupted { .. } => "periodic::interrupted",
        }
    }

    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) => Some(error),
            Self::Cycle(error) => error.input(),
            _ => None,
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NotPeriodic(NotPeriodic { values: [_, None], .. }) => {
                Some("let the signal go on for ever: after_end = \"repeat\"".into())
            }
            Self::NotPeriodic(_) => {
                Some("give the period with which all inputs repeat: --period \"10 min\"".into())
            }
            Self::NoBalance { .. } => Some("add a path to a boundary, or look at `lptn run`".into()),
            Self::Switches { .. } => Some(
                "the controls have a rhythm of their own: look at `lptn run`, and at means over many cycles"
                    .into(),
            ),
            Self::NotFound { .. } => Some("look at some cycles one after the other: `lptn run`".into()),
            Self::Input(error) => error.problem.help(),
            Self::Cycle(error) => error.help(),
            Self::Interrupted { .. } => None,
        }
    }
}

impl fmt::Display for PeriodicError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPeriodic(found) => not_periodic(f, found),
            Self::Input(error) => error.fmt(f),
            Self::NoBalance { names, heat, .. } => write!(
                f,
                "no path leads to a boundary from {}, where every cycle leaves {} J: there is no periodic state",
                list_of_names(names),
                rounded(*heat)
            ),
            Self::NotFound { cycles, residual } => write!(
                f,
                "{cycles} cycles came to no state that repeats itself; the best one was off by {residual:.1e} K"
            ),
            Self::Switches { cycles } => {
                write!(
                    f,
                    "in {cycles} cycles controls and comparisons did not come to switch alike twice in a row"
                )
            }
            Self::Cycle(error) => error.fmt(f),
            Self::Interrupted { cycles, .. } => write!(f, "interrupted after {cycles} cycles"),
        }
    }
}

fn not_periodic(f: &mut fmt::Formatter<'_>, found: &NotPeriodic) -> fmt::Result {
    let unit = found.unit.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let value = |value: Option<f64>| value.map_or("nothing".into(), |x| format!("{}{unit}", rounded(x)));
    let [now, then] = found.values.map(value);
    write!(
        f,
        "`{}` does not repeat itself: it is {now} at {} s and {then} one period of {} s later",
        found.name,
        rounded(found.time),
        rounded(found.period)
    )
}

/// A number with six digits.
fn rounded(x: f64) -> String {
    let text = format!("{x:.5e}");
    format_number(text.parse().unwrap_or(x))
}

impl std::error::Error for PeriodicError {}
