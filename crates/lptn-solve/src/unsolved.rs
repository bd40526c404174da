//! Balances that could not be solved, with the node at which it failed.

use lptn_assembly::ThermalSystem;
use lptn_integrate::FactorError;
use lptn_network::{InputError, Item, list_of};
use lptn_units::format_six as six_digits;

use crate::newton_error::NewtonError;

lptn_units::errors! {
/// Reason why balances could not be solved, and the node at which it failed.
#[derive(Clone, Debug)]
pub enum Unsolved {
    /// A value of an element fails.
    Input => Box<InputError>;
    /// Nothing determines the temperature of the node: all heat flows that reach it are zero
    /// whatever it is, or an element of this name reads it and does not change with it there.
    Undetermined { node: String, reader: Option<String> } = "solve::undetermined",
        match reader {
            None => format!(
                "nothing determines the temperature of `{node}` and of the nodes it exchanges heat \
                 with: no heat that leaves them depends on it, for example because a stream is at \
                 rest"
            ),
            Some(reader) => format!(
                "nothing determines the temperature of `{node}` at the end of the search: \
                 `{reader}` reads it, but does not change with it there, like a saturated \
                 controller"
            ),
        },
        help match reader {
            None => format!(
                "let a path lead from `{node}` to a boundary at all times; with capacities `lptn \
                 run` follows it over time"
            ),
            Some(reader) => format!(
                "choose a `T0` at which `{reader}` changes with `{node}`; `lptn run` shows whether \
                 `{reader}` remains saturated"
            ),
        };
    /// Nothing determines a state: its balance does not change with it, or no rate reads it.
    UndeterminedState { state: String, balanced: bool } = "solve::undetermined_state",
        match balanced {
            true => format!("nothing determines `{state}`: its balance does not change with it"),
            false => format!(
                "nothing determines `{state}`: no rate reads it, so its value depends on the way to \
                 the steady state"
            ),
        },
        help match balanced {
            true => "a junction needs an open branch whose flow depends on its pressure, to a \
                junction with a known pressure; the `balance` of a [state] has to fall while the \
                state rises",
            false => "`lptn run` gives its value over time",
        };
    /// No value of a state was found at which its balance is zero: by how much it still moved, in
    /// its unit.
    StateNotFound { state: String, change: f64, unit: String } = "solve::state_not_found",
        format!(
            "no value of `{state}` was found at which its balance is zero: it still moved by {} \
             {unit}",
            six_digits(*change)
        ),
        help "the `balance` has to fall while the state rises: if it rises, write it with the other \
            sign, `-(..)`; else let `start` be near the solution";
    /// The numbers could not be factorised.
    Factorization(error: FactorError) = "solve::singular",
        format!("the balances cannot be factorised: {error}"),
        source error;
    /// Heat in and out are equal at the temperatures found, but the least disturbance leads away
    /// from them.
    Unstable { node: String, swings: bool } = "solve::unstable",
        format!(
            "the only steady state that was found is unstable: after the least disturbance \
             `{node}` {}",
            if *swings { "oscillates more and more" } else { "runs away" }
        ),
        help if *swings { SWINGS } else { GROWS };
    /// Heat in and out were equal at temperatures that end here: they are equal elsewhere only, and
    /// without a capacity nothing says how the node gets there.
    Fold { node: String } = "solve::fold",
        format!(
            "the balance of the massless node `{node}` has more than one solution, and the one \
             that it had so far ends here: it jumps to an unknown one"
        ),
        help format!(
            "give `{node}` a small capacity instead of `massless = true`, such as `C = \"1 \
             mJ/K\"`, and a `T0`"
        );
    /// The temperature of the fluid that leaves a pipe depends on fluid that entered earlier, which
    /// only a run knows.
    Pipe { node: String } = "solve::pipe",
        format!("the fluid that leaves the pipe `{node}` entered earlier, and only a run knows it"),
        help format!(
            "use `lptn run`, or join the two ends of `{node}` by an [advection] in place of the \
             [pipe]"
        );
    /// A state jumps at its samples, which no rate shows.
    Sampled { state: String } = "solve::sampled",
        format!("`{state}` is sampled, and changes at its samples only"),
        help "use `lptn run`, or a state with a `rate`, a controller without `sample`";
    /// Comparisons have no truth that agrees with the temperatures at one state, because each changes
    /// a temperature that is compared; their names.
    Restless { names: Vec<String> } = "run::restless",
        format!("at one state {} switch back and forth", list_of(names, "comparisons")),
        help "a comparison changes the compared value at once: give a capacity to the massless \
            node that it reads";
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

/// The name of an element that reads the temperature of an unknown without being connected to it.
fn reader(system: &ThermalSystem, unknown: usize) -> Option<String> {
    let network = system.network();
    let node = system.unknowns().get(unknown)?;
    let reads = |variables: &[u32]| variables.iter().any(|&v| v as usize == node.index());
    let source = network.source_ids().find(|&id| {
        let into = &network.sources()[id.index()].into;
        reads(network.source_variables(id)) && into.iter().all(|(other, _)| other != node)
    });
    if let Some(id) = source {
        return Some(network.name_of(Item::Source(id)).into_owned());
    }
    let conductor = network.conductor_ids().find(|&id| {
        // the first two are its ends
        let variables = network.conductor_variables(id);
        reads(variables.get(2..).unwrap_or_default())
    });
    conductor.map(|id| network.name_of(Item::Conductor(id)).into_owned())
}

/// The reason for a state whose balance has no solution, or of which none was found.
fn not_found(system: &ThermalSystem, unknown: usize, change: f64) -> Unsolved {
    let state = system.network().state_at(system.unknowns()[unknown]);
    let (name, change, unit) = state.map_or_else(Default::default, |state| {
        (state.name.clone(), state.value(change), state.ty.dimension.si_unit())
    });
    Unsolved::StateNotFound { state: name, change, unit }
}

const SWINGS: &str = "check for a controller that senses a temperature too late for its gain; \
    `lptn run` shows the amplitude";

const GROWS: &str = "check for a heat that grows faster with temperature than the cooling does";

impl Unsolved {
    pub(crate) fn new(system: &ThermalSystem, error: NewtonError) -> Self {
        let name = |unknown: usize| {
            let id = system.unknowns().get(unknown);
            id.map_or(String::new(), |id| system.network().nodes()[id.index()].name.clone())
        };
        let is_state = |unknown: usize| {
            system.unknowns().get(unknown).is_some_and(|id| !system.network().is_thermal(*id))
        };
        match error {
            NewtonError::Input(error) => Self::Input(Box::new(error)),
            NewtonError::Singular { unknown } if is_state(unknown) => {
                let state = system.network().state_at(system.unknowns()[unknown]);
                let balanced = state.is_none_or(|state| state.balanced);
                Self::UndeterminedState { state: name(unknown), balanced }
            }
            NewtonError::Singular { unknown } => {
                Self::Undetermined { node: name(unknown), reader: reader(system, unknown) }
            }
            NewtonError::Unstable { unknown, swings } => {
                Self::Unstable { node: name(unknown), swings }
            }
            NewtonError::Fold { unknown } => Self::Fold { node: name(unknown) },
            NewtonError::NotEntered { unknown } => Self::Pipe { node: name(unknown) },
            NewtonError::Factorization(error) => Self::Factorization(error),
            NewtonError::Stalled { unknown, change } if is_state(unknown) => {
                not_found(system, unknown, change)
            }
            NewtonError::Stalled { unknown, change } => {
                Self::NotFound { node: name(unknown), change }
            }
        }
    }

    /// The name of the node at which it failed; empty if that is not known.
    pub fn node(&self) -> &str {
        match self {
            Self::Input(error) => &error.name,
            Self::Factorization(_) | Self::Restless { .. } => "",
            Self::Undetermined { node, .. }
            | Self::UndeterminedState { state: node, .. }
            | Self::StateNotFound { state: node, .. }
            | Self::Sampled { state: node }
            | Self::Unstable { node, .. }
            | Self::Fold { node }
            | Self::Pipe { node }
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

#[cfg(test)]
mod tests;
