//! Balances that could not be solved, with the node at which it failed.

use lptn_assembly::ThermalSystem;
use lptn_integrate::FactorError;
use lptn_network::InputError;
use lptn_units::format_six as six_digits;

use crate::newton::NewtonError;

lptn_units::errors! {
/// Why balances could not be solved, and the node at which it failed.
#[derive(Clone, Debug)]
pub enum Unsolved {
    /// A value of an element fails.
    Input => Box<InputError>;
    /// Nothing determines the temperature of the node: all heat flows that reach it are zero
    /// whatever it is.
    Undetermined { node: String } = "solve::undetermined",
        format!(
            "nothing determines the temperature of `{node}` and of the nodes it exchanges heat \
             with: no heat that leaves them depends on it, as where a stream stands still"
        ),
        help format!(
            "let a path lead from `{node}` to a boundary at all times; with capacities `lptn run` \
             follows it meanwhile"
        );
    /// The numbers could not be factorised.
    Factorization(error: FactorError) = "solve::singular",
        format!("the balances cannot be factorised: {error}"),
        source error;
    /// Heat in and out are equal at the temperatures found, but the least disturbance leads away
    /// from them.
    Unstable { node: String } = "solve::unstable",
        format!("the only steady state that was found is unstable: from the least disturbance on \
            `{node}` runs away"),
        help GROWS;
    /// Heat in and out were equal at temperatures that end here: they are equal elsewhere only, and
    /// without a capacity nothing says how the node gets there.
    Fold { node: String } = "solve::fold",
        format!(
            "the balance of the massless node `{node}` has more than one solution, and the one \
             that it had so far ends here: it jumps, and where to is not known"
        ),
        help format!(
            "give `{node}` a small capacity in place of `massless = true`, such as `C = \"1 \
             mJ/K\"`, and a `T0`"
        );
    /// No temperatures were found at which heat in and heat out are equal: by how much the node
    /// still moved, in K.
    NotFound { node: String, change: f64 } = "solve::not_found",
        format!(
            "no temperatures were found at which heat in and out are equal: `{node}` still moved \
             by {} K",
            six_digits(*change)
        ),
        help GROWS;
}
}

const GROWS: &str = "check for a heat that grows faster with temperature than the cooling does";

impl Unsolved {
    pub(crate) fn new(system: &ThermalSystem, error: NewtonError) -> Self {
        let name = |unknown: usize| {
            let id = system.unknowns().get(unknown);
            id.map_or(String::new(), |id| system.network().nodes()[id.index()].name.clone())
        };
        match error {
            NewtonError::Input(error) => Self::Input(Box::new(error)),
            NewtonError::Singular { unknown } => Self::Undetermined { node: name(unknown) },
            NewtonError::Unstable { unknown } => Self::Unstable { node: name(unknown) },
            NewtonError::Fold { unknown } => Self::Fold { node: name(unknown) },
            NewtonError::Factorization(error) => Self::Factorization(error),
            NewtonError::Stalled { unknown, change } => {
                Self::NotFound { node: name(unknown), change }
            }
        }
    }

    /// The name of the node at which it failed; empty where that is not known.
    pub fn node(&self) -> &str {
        match self {
            Self::Input(error) => &error.name,
            Self::Factorization(_) => "",
            Self::Undetermined { node }
            | Self::Unstable { node }
            | Self::Fold { node }
            | Self::NotFound { node, .. } => node,
        }
    }

    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) => Some(error),
            _ => None,
        }
    }
}
