//! Why a network could not be reduced, or a record not be fitted.

use std::fmt;

use lptn_integrate::FactorError;
use lptn_network::{InputError, UnknownName, list_of_names};
use lptn_solve::TransientError;

/// Why a network has no equivalent at a port.
#[derive(Debug)]
pub enum ReduceError {
    /// No node has the name of the port.
    UnknownPort(UnknownName),
    /// The port is a boundary: its temperature is given, whatever heat goes in.
    BoundaryPort {
        /// Its name.
        name: String,
    },
    /// No path leads from the port and the nodes joined to it to a boundary: heat put in there is never given away.
    NoGround {
        /// Their names.
        names: Vec<String>,
    },
    /// The network is not linear with constant coefficients.
    NotLinear {
        /// The name of the first item that makes it so.
        name: String,
    },
    /// Sources or boundaries switch by themselves, which one node without the places that are felt cannot follow.
    Switches {
        /// The name of the first control.
        name: String,
    },
    /// A source or boundary has no value.
    Input(InputError),
    /// The conductances span more than the numbers can hold.
    Factorization(FactorError),
    /// The modes at the port could not be computed.
    Modes,
    /// A run of the network or of its equivalent failed.
    Run(TransientError),
    /// The equivalent network could not be built; the text says why.
    Equivalent(String),
    /// The window of the least-squares definition is no positive time, or too short to see the port warm.
    Window(f64),
}

impl ReduceError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownPort(_) => "reduce::unknown_port",
            Self::BoundaryPort { .. } => "reduce::boundary_port",
            Self::NoGround { .. } => "reduce::no_ground",
            Self::NotLinear { .. } => "reduce::not_linear",
            Self::Switches { .. } => "reduce::switches",
            Self::Input(_) => "solve::input",
            Self::Factorization(_) => "reduce::singular",
            Self::Modes => "reduce::modes",
            Self::Run(error) => error.code(),
            Self::Equivalent(_) => "reduce::equivalent",
            Self::Window(_) => "reduce::window",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::UnknownPort(unknown) => {
                unknown.suggestion.as_ref().map(|name| format!("did you mean `{name}`?"))
            }
            Self::BoundaryPort { .. } => {
                Some("choose a node: a boundary keeps its temperature whatever heat it gets".into())
            }
            Self::NoGround { .. } => Some(
                "add a path to a boundary: without one, a constant heat never leads to a rise that stays"
                    .into(),
            ),
            Self::Factorization(_) => {
                Some("replace the largest conductances by merging the nodes they join".into())
            }
            Self::NotLinear { name } => Some(format!(
                "put a constant conductance, capacity or heat in place of `{name}`, as it is in steady state: `lptn steady`"
            )),
            Self::Switches { name } => {
                Some(format!("write 0 or 1 in place of `{name}`, and reduce what is then there"))
            }
            Self::Window(_) => Some("write for example --window \"25 min\"".into()),
            _ => None,
        }
    }
}

impl fmt::Display for ReduceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownPort(unknown) => write!(f, "no node is named `{}`", unknown.name),
            Self::BoundaryPort { name } => write!(f, "`{name}` is a boundary and cannot be a port"),
            Self::NoGround { names } => {
                write!(f, "no path leads to a boundary from {}", list_of_names(names))
            }
            Self::NotLinear { name } => write!(
                f,
                "`{name}` is more than a constant: only linear networks have one equivalent resistance"
            ),
            Self::Switches { name } => {
                write!(f, "`{name}` switches during a run, which an equivalent of one node cannot follow")
            }
            Self::Input(error) => error.fmt(f),
            Self::Factorization(error) => write!(f, "the conductances cannot be factorised: {error}"),
            Self::Modes => f.write_str("the time constants at the port cannot be computed"),
            Self::Run(error) => error.fmt(f),
            Self::Equivalent(why) => write!(f, "the equivalent network cannot be built: {why}"),
            Self::Window(window) => {
                write!(f, "the window must be a time in which the port warms, got {window} s")
            }
        }
    }
}

impl std::error::Error for ReduceError {}

impl From<FactorError> for ReduceError {
    fn from(error: FactorError) -> Self {
        Self::Factorization(error)
    }
}

impl From<TransientError> for ReduceError {
    fn from(error: TransientError) -> Self {
        Self::Run(error)
    }
}

/// Why a record has no exponential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FitError {
    /// Fewer than four points, or lists of different length: three numbers are fitted.
    TooFew {
        /// Number of points.
        points: usize,
    },
    /// The times do not ascend, or a value is not finite.
    NotARecord,
    /// The temperature does not change.
    Flat,
    /// The best exponential is a straight line or a jump: the record does not say what its time constant is.
    NoCurvature {
        /// The time constant at which the search ended, in s.
        tau: f64,
    },
}

impl FitError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooFew { .. } => "fit::too_few_points",
            Self::NotARecord => "fit::not_a_record",
            Self::Flat => "fit::flat",
            Self::NoCurvature { .. } => "fit::no_curvature",
        }
    }
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { points } => {
                write!(f, "an exponential has three numbers to fit, and the record has {points} points")
            }
            Self::NotARecord => f.write_str("the times of the record do not ascend, or a value is no number"),
            Self::Flat => f.write_str("the temperature of the record does not change"),
            Self::NoCurvature { tau } => {
                write!(f, "the record shows no time constant: the search ended at {tau:.1e} s")
            }
        }
    }
}

impl std::error::Error for FitError {}
