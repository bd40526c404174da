//! Balances that could not be solved, with the node at which it failed.

use std::fmt;

use lptn_assembly::ThermalSystem;
use lptn_integrate::FactorError;
use lptn_network::InputError;
use lptn_units::format_six as six_digits;

use crate::newton::NewtonError;

/// Balances that could not be solved.
#[derive(Clone, Debug)]
pub struct Unsolved {
    /// The node at which it failed.
    pub node: String,
    /// Why.
    pub reason: Box<UnsolvedReason>,
}

/// Why balances could not be solved.
#[derive(Clone, Debug)]
pub enum UnsolvedReason {
    /// A value of an element fails.
    Input(InputError),
    /// Nothing determines the temperature of the node: all heat flows that reach it are zero whatever it is.
    Undetermined,
    /// The numbers could not be factorised.
    Factorization(FactorError),
    /// Heat in and out are equal at the temperatures found, but the least disturbance leads away from them.
    Unstable,
    /// Heat in and out were equal at temperatures that end here: they are equal elsewhere only, and without a capacity
    /// nothing says how the node gets there.
    Fold,
    /// No temperatures were found at which heat in and heat out are equal.
    NotFound {
        /// By how much the node still moved, in K.
        change: f64,
    },
}

impl Unsolved {
    pub(crate) fn new(system: &ThermalSystem, error: NewtonError) -> Self {
        let name = |unknown: usize| {
            let id = system.unknowns().get(unknown);
            id.map_or(String::new(), |id| system.network().nodes()[id.index()].name.clone())
        };
        let (node, reason) = match error {
            NewtonError::Input(error) => (error.name.clone(), UnsolvedReason::Input(error)),
            NewtonError::Singular { unknown } => (name(unknown), UnsolvedReason::Undetermined),
            NewtonError::Unstable { unknown } => (name(unknown), UnsolvedReason::Unstable),
            NewtonError::Fold { unknown } => (name(unknown), UnsolvedReason::Fold),
            NewtonError::Factorization(error) => (String::new(), UnsolvedReason::Factorization(error)),
            NewtonError::Stalled { unknown, change } => (name(unknown), UnsolvedReason::NotFound { change }),
        };
        Self { node, reason: Box::new(reason) }
    }

    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match *self.reason {
            UnsolvedReason::Input(_) => "solve::input",
            UnsolvedReason::Undetermined => "solve::undetermined",
            UnsolvedReason::Factorization(_) => "solve::singular",
            UnsolvedReason::NotFound { .. } => "solve::not_found",
            UnsolvedReason::Unstable => "solve::unstable",
            UnsolvedReason::Fold => "solve::fold",
        }
    }

    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match &*self.reason {
            UnsolvedReason::Input(error) => Some(error),
            _ => None,
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match &*self.reason {
            UnsolvedReason::Input(error) => error.problem.help(),
            UnsolvedReason::Undetermined => Some(format!(
                "let a path lead from `{}` to a boundary at all times; with capacities `lptn run` follows it meanwhile",
                self.node
            )),
            UnsolvedReason::Fold => Some(format!(
                "give `{}` a small capacity in place of `massless = true`, such as `C = \"1 mJ/K\"`, and a `T0`",
                self.node
            )),
            UnsolvedReason::Factorization(_) => None,
            UnsolvedReason::NotFound { .. } | UnsolvedReason::Unstable => {
                Some("check for a heat that grows faster with temperature than the cooling does".into())
            }
        }
    }
}

impl fmt::Display for Unsolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let node = &self.node;
        match &*self.reason {
            UnsolvedReason::Input(error) => error.fmt(f),
            UnsolvedReason::Undetermined => {
                write!(
                    f,
                    "nothing determines the temperature of `{node}` and of the nodes it exchanges heat with: no heat \
                     that leaves them depends on it, as where a stream stands still"
                )
            }
            UnsolvedReason::Factorization(error) => write!(f, "the balances cannot be factorised: {error}"),
            UnsolvedReason::Unstable => write!(
                f,
                "the only steady state that was found is unstable: from the least disturbance on `{node}` runs away"
            ),
            UnsolvedReason::Fold => write!(
                f,
                "the balance of the massless node `{node}` has more than one solution, and the one that it had so far \
                 ends here: it jumps, and where to is not known"
            ),
            UnsolvedReason::NotFound { change } => write!(
                f,
                "no temperatures were found at which heat in and out are equal: `{node}` still moved by {} K",
                six_digits(*change)
            ),
        }
    }
}

impl std::error::Error for Unsolved {}
