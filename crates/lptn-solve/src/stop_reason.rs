//! Reasons why a run breaks off.

use lptn_integrate::IntegrateError;
use lptn_network::{Field, InputError, Item, ZERO_CELSIUS, list_of};
use lptn_units::format_six as six_digits;

use crate::unsolved::Unsolved;

lptn_units::errors! {
/// Reason why a run broke off.
#[derive(Debug)]
pub enum StopReason {
    /// A source or boundary has no value.
    Input => InputError;
    /// The balances of massless nodes have no solution.
    Unsolved => Unsolved;
    /// A node fell below 0 K: the first such node and its temperature in K.
    BelowAbsoluteZero { name: String, temperature: f64 } = "solve::below_absolute_zero",
        cold(name, *temperature),
        help COLD;
    /// A comparison of temperatures changes again and again between two rows: with either truth the
    /// temperatures lead to the other one. The element and field it is in, in words and as they
    /// are.
    Chatter { name: String, changes: usize, place: (Item, Field) } = "run::chatter",
        format!(
            "a comparison in `{name}` changed {changes} times between two rows: the temperatures \
             stay at its threshold"
        ),
        help "give it a dead band: a [control] with `on_above` and `off_below`, or `on_below` and \
            `off_above`, whose name is 0 or 1 in expressions; or a gradual change, `0.5 * (1 + \
            tanh((T - 80 [degC]) / 1 [K]))`";
    /// Elements switch back and forth at one moment, without progress in time: controls by name,
    /// comparisons by element and field.
    Restless { names: Vec<String> } = "run::restless",
        match names.as_slice() {
            [one] => format!("`{one}` switches back and forth at this very moment"),
            several => format!(
                "{} switch back and forth at this very moment",
                list_of(several, "things")
            ),
        },
        help "switching changes the compared value at once: let a control sense a node with a \
            capacity, or give it a `min_dwell`";
    /// More events than a run may have.
    TooManyEvents { count: usize } = "run::too_many_events",
        format!("{count} events, more than a run may have"),
        help "replace such frequent switching by its mean, or slow it down by `min_dwell`";
    /// The network switches, but has no node with a capacity.
    NothingSwitches = "run::no_capacity",
        "controls and comparisons of temperatures need a node with a capacity",
        help "give the nodes that are sensed a capacity";
    /// The capacity of a node that follows states has fallen to zero: in J/K, and the states.
    Empty { node: String, capacity: f64, states: Vec<String> } = "run::empty",
        format!(
            "the capacity of `{node}` has fallen to {} J/K: nothing is left to have a temperature",
            six_digits(*capacity)
        ),
        help format!(
            "give the state {} a `min` above zero, the rest that stays, or stop the run before",
            list_of(states, "states")
        );
    /// The heat of a source grows with the temperature of a node faster than the paths carry it
    /// off, from this temperature in K on.
    Runaway { node: String, source: String, from: f64 } = "run::runaway",
        runaway(node, source, *from),
        help RUNS_AWAY;
    /// The integrator gave up; the node with the largest error, if it is known.
    Integrator { error: IntegrateError, node: Option<String> } = "run::integrator",
        match node {
            Some(node) => format!("{error} (largest error at node `{node}`)"),
            None => error.to_string(),
        },
        source error;
}
}

pub(crate) const COLD: &str =
    "less heat can be taken out than that: check the signs and sizes of the sources";

pub(crate) const RUNS_AWAY: &str = "give it a better path to a cooler place, or less heat at the \
    start; if the heat is limited in fact, write the limit: `min(.., ..)`";

pub(crate) fn runaway(node: &str, source: &str, from: f64) -> String {
    format!(
        "`{node}` runs away: above {} the heat of `{source}` grows faster with its temperature \
         than the paths remove it",
        scales(from)
    )
}

/// A temperature in degC and in K.
pub(crate) fn scales(kelvin: f64) -> String {
    format!("{} degC ({} K)", six_digits(kelvin - ZERO_CELSIUS), six_digits(kelvin))
}

pub(crate) fn cold(name: &str, temperature: f64) -> String {
    format!("node `{name}` is below absolute zero: {} K", six_digits(temperature))
}
