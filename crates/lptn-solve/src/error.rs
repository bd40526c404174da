//! Why an analysis has no answer.

use std::fmt;

use lptn_integrate::{FactorError, IntegrateError};
use lptn_network::{Field, InputError, Item, NodeId, list_of, list_of_names};
use lptn_units::format_number;

use crate::settings_error::SettingsError;
use crate::solution::Solution;
use crate::unsolved::Unsolved;

/// Why there is no steady state.
#[derive(Clone, Debug)]
pub enum SteadyError {
    /// Some nodes reach no boundary and are heated or cooled for ever.
    NoBoundary {
        /// The nodes, one set of connected ones after the other.
        nodes: Vec<NodeId>,
        /// Their names.
        names: Vec<String>,
        /// The heat in W that they keep receiving.
        heat: f64,
    },
    /// A source or boundary has no value.
    Input(InputError),
    /// The balances of a nonlinear network were not solved.
    Unsolved(Unsolved),
    /// The conductances span more than the numbers can hold.
    Factorization(FactorError),
    /// More heat is taken out than there is: a linear network goes below 0 K, a real one does not.
    BelowAbsoluteZero {
        /// The first such node.
        name: String,
        /// Its temperature in K.
        temperature: f64,
    },
    /// Whatever the positions of controls and comparisons, in their steady state something has to switch.
    Cycles {
        /// What has to switch, by name.
        names: Vec<String>,
        /// How many positions were tried.
        tried: usize,
    },
    /// The solution does not balance: heat in and heat out differ by `residual` of the heat turned over.
    Unbalanced {
        /// Relative residual.
        residual: f64,
    },
}

impl SteadyError {
    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) => Some(error),
            Self::Unsolved(unsolved) => unsolved.input(),
            _ => None,
        }
    }

    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoBoundary { .. } => "steady::no_boundary",
            Self::Input(_) => "solve::input",
            Self::Unsolved(unsolved) => unsolved.code(),
            Self::Factorization(_) => "steady::singular",
            Self::BelowAbsoluteZero { .. } => "solve::below_absolute_zero",
            Self::Cycles { .. } => "steady::cycles",
            Self::Unbalanced { .. } => "steady::unbalanced",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NoBoundary { .. } => {
                Some("add a path to a boundary, or run the network over time: `lptn run`".into())
            }
            Self::Factorization(_) | Self::Unbalanced { .. } => {
                Some("replace the largest conductances by merging the nodes they join".into())
            }
            Self::Cycles { .. } => Some(
                "run the network over time, `lptn run`: it shows how often it switches, and the means".into(),
            ),
            Self::BelowAbsoluteZero { .. } => Some(COLD.into()),
            Self::Input(error) => error.problem.help(),
            Self::Unsolved(unsolved) => unsolved.help(),
        }
    }
}

impl fmt::Display for SteadyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoBoundary { names, heat, .. } => write!(
                f,
                "no path leads to a boundary from {}, where {} W stay for ever: there is no steady state",
                list_of_names(names),
                six_digits(*heat)
            ),
            Self::Input(error) => error.fmt(f),
            Self::Unsolved(unsolved) => unsolved.fmt(f),
            Self::Factorization(error) => write!(f, "the conductances cannot be factorised: {error}"),
            Self::BelowAbsoluteZero { name, temperature } => cold(f, name, *temperature),
            Self::Cycles { names, tried } => write!(
                f,
                "no steady state, it cycles: in each of the {tried} positions that were tried something has to switch, \
                 among it {}",
                list_of(names, "things")
            ),
            Self::Unbalanced { residual } => {
                write!(f, "heat in and heat out differ by {residual:.1e} of the heat turned over")
            }
        }
    }
}

impl std::error::Error for SteadyError {}

/// Why a transient could not be started or finished.
#[derive(Debug)]
pub enum TransientError {
    /// The settings of the run contradict themselves.
    Settings(SettingsError),
    /// A source or boundary has no value at the start.
    Input(InputError),
    /// The balances of massless nodes could not be set up.
    Start(Unsolved),
    /// The integrator could not be set up or read.
    Integrator(IntegrateError),
    /// The run broke off; what was computed before is whole.
    Stopped {
        /// The time reached in s.
        time: f64,
        /// The reason.
        reason: StopReason,
        /// Everything up to then.
        partial: Box<Solution>,
    },
}

/// What broke a run off.
#[derive(Debug)]
pub enum StopReason {
    /// A source or boundary has no value.
    Input(InputError),
    /// The balances of massless nodes have no solution.
    Unsolved(Unsolved),
    /// A node fell below 0 K.
    BelowAbsoluteZero {
        /// The first such node.
        name: String,
        /// Its temperature in K.
        temperature: f64,
    },
    /// A comparison of temperatures changes again and again between two rows: with either truth the temperatures go to
    /// where it is the other one.
    Chatter {
        /// The element and field it stands in.
        name: String,
        /// How often it changed.
        changes: usize,
        /// The element and the field.
        place: (Item, Field),
    },
    /// What switches back and forth at one moment, without time going on.
    Restless {
        /// The controls by name, comparisons by element and field.
        names: Vec<String>,
    },
    /// More events than a run may have.
    TooManyEvents {
        /// How many.
        count: usize,
    },
    /// The network switches, but has no node with a capacity.
    NothingSwitches,
    /// The integrator gave up.
    Integrator {
        /// Its reason.
        error: IntegrateError,
        /// The node with the largest error, where that is known.
        node: Option<String>,
    },
}

impl TransientError {
    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) | Self::Stopped { reason: StopReason::Input(error), .. } => Some(error),
            Self::Start(unsolved) | Self::Stopped { reason: StopReason::Unsolved(unsolved), .. } => {
                unsolved.input()
            }
            _ => None,
        }
    }

    /// The element and field at fault, if that is the reason.
    pub fn place(&self) -> Option<(Item, Field)> {
        match self {
            Self::Stopped { reason: StopReason::Chatter { place, .. }, .. } => Some(*place),
            _ => self.input().map(|input| (input.item, input.field)),
        }
    }

    /// The name of the node at which it failed, if that is the reason.
    pub fn node(&self) -> Option<&str> {
        let Self::Stopped { reason, .. } = self else {
            let Self::Start(unsolved) = self else { return None };
            return Some(&unsolved.node);
        };
        match reason {
            StopReason::Unsolved(unsolved) => Some(&unsolved.node),
            StopReason::BelowAbsoluteZero { name, .. } => Some(name),
            StopReason::Integrator { node, .. } => node.as_deref(),
            _ => None,
        }
    }

    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Settings(_) => "run::settings",
            Self::Stopped { reason: StopReason::BelowAbsoluteZero { .. }, .. } => {
                "solve::below_absolute_zero"
            }
            Self::Input(_) | Self::Stopped { reason: StopReason::Input(_), .. } => "solve::input",
            Self::Start(unsolved) | Self::Stopped { reason: StopReason::Unsolved(unsolved), .. } => {
                unsolved.code()
            }
            Self::Stopped { reason: StopReason::Chatter { .. }, .. } => "run::chatter",
            Self::Stopped { reason: StopReason::Restless { .. }, .. } => "run::restless",
            Self::Stopped { reason: StopReason::TooManyEvents { .. }, .. } => "run::too_many_events",
            Self::Stopped { reason: StopReason::NothingSwitches, .. } => "run::no_capacity",
            Self::Integrator(_) | Self::Stopped { .. } => "run::integrator",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Input(error) | Self::Stopped { reason: StopReason::Input(error), .. } => {
                error.problem.help()
            }
            Self::Start(unsolved) | Self::Stopped { reason: StopReason::Unsolved(unsolved), .. } => {
                unsolved.help()
            }
            Self::Stopped { reason, .. } => reason.help(),
            Self::Settings(error) => error.help(),
            Self::Integrator(_) => None,
        }
    }
}

impl fmt::Display for TransientError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Settings(error) => error.fmt(f),
            Self::Input(error) => error.fmt(f),
            Self::Start(unsolved) => unsolved.fmt(f),
            Self::Stopped { time, reason: StopReason::Unsolved(unsolved), .. } => {
                write!(f, "stopped at {} s: {unsolved}", six_digits(*time))
            }
            Self::Integrator(error) => write!(f, "the integrator failed: {error}"),
            Self::Stopped { time, reason: StopReason::Input(error), .. } => {
                write!(f, "stopped at {} s: {error}", six_digits(*time))
            }
            Self::Stopped { time, reason: StopReason::BelowAbsoluteZero { name, temperature }, .. } => {
                write!(f, "stopped at {} s: ", six_digits(*time))?;
                cold(f, name, *temperature)
            }
            Self::Stopped {
                time,
                reason:
                    reason @ (StopReason::Chatter { .. }
                    | StopReason::Restless { .. }
                    | StopReason::TooManyEvents { .. }
                    | StopReason::NothingSwitches),
                ..
            } => {
                write!(f, "stopped at {} s: {}", six_digits(*time), reason.of_events())
            }
            Self::Stopped { time, reason: StopReason::Integrator { error, node }, .. } => {
                write!(f, "stopped at {} s: {error}", six_digits(*time))?;
                node.as_ref().map_or(Ok(()), |node| write!(f, " (largest error at node `{node}`)"))
            }
        }
    }
}

impl StopReason {
    /// What to do about it, where that does not depend on a value of the network.
    fn help(&self) -> Option<String> {
        Some(match self {
            Self::BelowAbsoluteZero { .. } => COLD.into(),
            Self::Chatter { .. } => "give it a dead band: a [control] with `on_above` and `off_below`, or \
                `on_below` and `off_above`, whose name is 0 or 1 in expressions; or a gradual change, \
                `0.5 * (1 + tanh((T - 80 [degC]) / 1 [K]))`"
                .into(),
            Self::Restless { .. } => {
                "switching changes at once what is compared: let a control feel a node with a \
                capacity, or give it a `min_dwell`"
                    .into()
            }
            Self::TooManyEvents { .. } => {
                "what switches this often is better replaced by its mean, or made slower by `min_dwell`"
                    .into()
            }
            Self::NothingSwitches => "give the nodes that are felt a capacity".into(),
            _ => return None,
        })
    }

    fn of_events(&self) -> String {
        match self {
            Self::Chatter { name, changes, .. } => format!(
                "a comparison in `{name}` changed {changes} times between two rows: the temperatures stay where it \
                 neither holds nor fails"
            ),
            Self::Restless { names } if names.len() == 1 => {
                format!("`{}` switches back and forth at this very moment", names[0])
            }
            Self::Restless { names } => {
                format!("{} switch back and forth at this very moment", list_of(names, "things"))
            }
            Self::TooManyEvents { count } => format!("{count} events, more than a run may have"),
            _ => "controls and comparisons of temperatures need a node with a capacity".into(),
        }
    }
}

const COLD: &str = "less heat can be taken out than that: check the signs and sizes of the sources";

fn cold(f: &mut fmt::Formatter<'_>, name: &str, temperature: f64) -> fmt::Result {
    write!(f, "node `{name}` is below absolute zero: {} K", six_digits(temperature))
}

/// A number as a message shows it: six digits are enough to find the place.
pub(crate) fn six_digits(x: f64) -> String {
    format!("{x:.5e}").parse().map_or_else(|_| x.to_string(), format_number)
}

impl std::error::Error for TransientError {}
