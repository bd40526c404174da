//! Errors about names that expressions use in places that do not allow them.

use lptn_data::{Diagnostic, Span};
use lptn_network::Context;

use crate::names::ValueKind;
use crate::place::{Place, Wanted};
use crate::raw::RawKind;

const BOUND_HELP: &str = "a changing value belongs in `of`: a difference such as `of = \"steel.T - \
    air.T\"` has a constant bound";

/// Temperatures of the element itself.
pub(crate) const LOCAL: [&str; 5] = ["T", "T_from", "T_to", "T_mean", "dT"];

/// Error for a temperature in a place that has none of this name.
pub(crate) fn not_here(place: Place<'_>, name: &str, wanted: Wanted, at: Span) -> Diagnostic {
    let words = place.words();
    let message = format!("{words} cannot use the temperature `{name}`");
    let bound = matches!(place.key, "below" | "above");
    let help = match wanted.context {
        _ if bound => BOUND_HELP,
        Context::Link if name == "T" => {
            "a path has the temperatures `T_from`, `T_to` and `T_mean`, and the difference `dT`"
        }
        Context::Source if LOCAL.contains(&name) => {
            "a source has `T`, the temperature of its node; that of another place is `NAME.T`"
        }
        Context::Control if LOCAL.contains(&name) => {
            "name the place: a threshold may use the temperature `NAME.T` of any node or boundary"
        }
        Context::Time if place.key == "density" => {
            "the density of a solid is constant: give it at the temperature at which its volume is \
             measured"
        }
        Context::Capacity => "it may depend on `T`, the temperature of its node, or on states",
        Context::Own => {
            "it may depend on `T`, the temperature of its body or fluid, and on no other"
        }
        Context::Result => "name the node or boundary, for example `steel.T`",
        _ => {
            "`P` of a source and the values of paths may depend on temperatures; `C` of a node and \
             the properties of materials and fluids on their own `T`"
        }
    };
    Diagnostic::error("netlist::temperature_not_here", message).at(at, "").help(help)
}

/// Error for `t` or a signal in a place for a constant.
pub(crate) fn depends_on_time(place: Place<'_>, name: &str, at: Span) -> Diagnostic {
    let (what, label) = match name {
        "t" => ("the time `t`".to_owned(), "time"),
        _ => (format!("signal `{name}`"), "changes with time"),
    };
    let words = place.words();
    let parameter = words.strip_prefix("parameter `").and_then(|rest| rest.strip_suffix('`'));
    if let (Some(parameter), RawKind::String { text, .. }) = (parameter, &place.raw.kind) {
        let message = format!("{words} depends on {what}, but a parameter is constant");
        let help =
            format!("make it a signal: below [signal] write `{parameter} = \"{}\"`", text.trim());
        return Diagnostic::error("netlist::time_in_parameter", message).at(at, label).help(help);
    }
    let help = match place.key {
        "below" | "above" => BOUND_HELP,
        "C" => {
            "a capacity may follow a state: below [state] write its mass, for example `m = { rate = \
             \"0.1 kg/s\", start = \"50 kg\" }`"
        }
        _ => {
            "sources, boundaries, the values of paths and signals may depend on time; this has to \
             be constant"
        }
    };
    let message = format!("{} has to be constant, but depends on {what}", place.words());
    Diagnostic::error("network::depends_on_time", message).at(at, label).help(help)
}

/// Error for a control in a value that must be known before the run.
pub(crate) fn control_not_here(place: Place<'_>, name: &str, at: Span) -> Diagnostic {
    let words = place.words();
    let message = format!("{words} cannot use control `{name}`, which switches during the run");
    let help = match place.key {
        "below" | "above" => BOUND_HELP,
        "" if words.starts_with("signal") => {
            "a signal is a function of time; use the control together with the signal, for example \
             in a source"
        }
        "" => {
            "a parameter is constant; use the control together with the parameter, for example in \
             a source"
        }
        _ => {
            "sources, boundaries, the values of paths, thresholds of other controls and limits may \
             use controls; this has to be constant"
        }
    };
    Diagnostic::error("netlist::control_not_here", message)
        .at(at, "0 or 1, as it switches")
        .help(help)
}

/// Error for a state or a named value in a place that cannot follow the results.
pub(crate) fn value_not_here(
    place: Place<'_>,
    (kind, name): (ValueKind, &str),
    at: Span,
) -> Diagnostic {
    let message = format!("{} cannot use {} `{name}`", place.words(), kind.word());
    let help = match place.key {
        "below" | "above" => BOUND_HELP,
        _ => {
            "sources, the values of paths, thresholds of controls, rates of states, limits and \
             reports may use states and values; a constant belongs in [param], a function of \
             time in [signal]"
        }
    };
    Diagnostic::error("netlist::value_not_here", message).at(at, "").help(help)
}
