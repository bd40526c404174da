//! Reasons why an analysis has no result.

use lptn_integrate::{FactorError, IntegrateError};
use lptn_network::{Field, InputError, Item, NodeId, list_of, list_of_names};
use lptn_units::{Class, format_six as six_digits};

use crate::ledger::LedgerError;
use crate::settings_error::SettingsError;
use crate::solution::Solution;
use crate::stop_reason::{COLD, RUNS_AWAY, StopReason, cold, runaway, scales};
use crate::unsolved::Unsolved;

lptn_units::errors! {
/// Reason why there is no steady state.
#[derive(Clone, Debug)]
pub enum SteadyError {
    /// Some nodes reach no boundary and are heated or cooled without end: one set of connected ones
    /// after the other, and the heat in W that they keep receiving.
    NoBoundary { nodes: Vec<NodeId>, names: Vec<String>, heat: f64 } = "steady::no_boundary",
        format!(
            "no path leads to a boundary from {}, and {} W cannot leave: there is no steady state",
            list_of_names(names),
            six_digits(*heat)
        ),
        help "add a path to a boundary, or run the network over time: `lptn run`";
    /// A state changes whatever the temperatures are: its name, its rate in SI units per second,
    /// and the unit.
    Drifts { name: String, rate: f64, unit: String } = "steady::drifts",
        format!(
            "no steady state: state `{name}` changes without end, by {} {}/s",
            six_digits(*rate), if unit == "1" { "" } else { unit }
        ),
        help "run the network over time, `lptn run`; or let the rate become zero, for example by \
            `min` or `max` of the state",
        class Class::No;
    /// A source or boundary has no value.
    Input => InputError;
    /// The balances of a nonlinear network were not solved.
    Unsolved => Unsolved as Class::of_numbers;
    /// The conductances span more than doubles can represent.
    Factorization(error: FactorError) = "steady::singular",
        format!("the conductances cannot be factorised: {error}"), source error, help MERGE,
        class Class::Numbers;
    /// More heat is taken out than there is: a linear network goes below 0 K, a real one does not.
    /// The first such node and its temperature in K.
    BelowAbsoluteZero { name: String, temperature: f64 } = "solve::below_absolute_zero",
        cold(name, *temperature),
        help COLD, class Class::Numbers;
    /// From its start the network becomes hotter without end: the node, the source whose heat grows
    /// with its temperature, and the temperature in K from which on the paths cannot carry it off.
    /// `rests`: the temperature of the node in K in a steady state that is not reached, if one is
    /// known.
    Runaway { node: String, source: String, from: f64, rests: Option<f64> } = "steady::runaway",
        match rests {
            None => format!("no steady state: {}", runaway(node, source, *from)),
            Some(at) => format!(
                "from its start the network reaches no steady state: {}; a steady state with \
                 `{node}` at {} exists but is not reached from the start",
                runaway(node, source, *from),
                scales(*at)
            ),
        },
        help RUNS_AWAY, class Class::Numbers;
    /// Whatever the positions of controls and comparisons, in their steady state something has to
    /// switch: its names, and how many positions were tried.
    Cycles { names: Vec<String>, tried: usize } = "steady::cycles",
        format!(
            "no steady state: in each of the {tried} control combinations tried, a control or \
             comparison has to switch, among them {}",
            list_of(names, "things")
        ),
        help "run the network over time, `lptn run`: it shows the number of switches, and the \
            means",
        class Class::No;
    /// The solution does not balance: heat in and heat out differ by `residual` of the heat turned
    /// over.
    Unbalanced { residual: f64 } = "steady::unbalanced",
        format!("heat in and heat out differ by {residual:.1e} of the heat exchanged"),
        help MERGE, class Class::Numbers;
}
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
}

lptn_units::errors! {
/// Reason why a transient could not be started or finished.
#[derive(Debug)]
pub enum TransientError {
    /// The settings of the run contradict themselves.
    Settings => SettingsError;
    /// A source or boundary has no value at the start.
    Input => InputError;
    /// The balances of massless nodes could not be set up.
    Start => Unsolved as Class::of_numbers;
    /// The integrator could not be set up or read.
    Integrator(error: IntegrateError) = "run::integrator",
        format!("the integrator failed: {error}"), source error,
        class Class::Numbers;
    /// The run broke off at this time in s; the results up to then are complete.
    Stopped { time: f64, reason: StopReason, partial: Box<Solution> } = reason.code(),
        format!("stopped at {} s: {reason}", six_digits(*time)), source reason, help reason.help(),
        class match reason {
            StopReason::NothingSwitches => Class::Input,
            _ => Class::Numbers,
        };
    /// The run reached its stop, but its energy balance does not close; the run is complete.
    Open { open: LedgerError, solution: Box<Solution> } = open.code(), open, source open,
        help open.help(), class Class::Numbers;
}
}

impl TransientError {
    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) | Self::Stopped { reason: StopReason::Input(error), .. } => {
                Some(error)
            }
            Self::Start(unsolved)
            | Self::Stopped { reason: StopReason::Unsolved(unsolved), .. } => unsolved.input(),
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
            return Some(unsolved.node());
        };
        match reason {
            StopReason::Unsolved(unsolved) => Some(unsolved.node()),
            StopReason::BelowAbsoluteZero { name, .. } => Some(name),
            StopReason::Runaway { node, .. } => Some(node),
            StopReason::Integrator { node, .. } => node.as_deref(),
            _ => None,
        }
    }
}

const MERGE: &str = "replace the largest conductances by merging the nodes they join";
