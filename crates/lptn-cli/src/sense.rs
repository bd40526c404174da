//! Results that nothing real has, and laws where they are not known, in words.

use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Item, ZERO_CELSIUS};
use lptn_report::{duration, significant};
use lptn_solve::{Beyond, OutOfRange, Solution, SteadyState};

use crate::ranges;

/// What makes no sense of a steady state.
pub(crate) fn of_steady(
    netlist: &Netlist,
    steady: &SteadyState,
    outside: &[OutOfRange],
) -> Vec<Diagnostic> {
    let beyond = Beyond::of_steady(&netlist.network, steady);
    told(netlist, beyond.as_ref(), ranges::warnings(netlist, outside, false))
}

/// What makes no sense of a run.
pub(crate) fn of_run(netlist: &Netlist, solution: &Solution) -> Vec<Diagnostic> {
    let beyond = Beyond::of_run(solution);
    told(netlist, beyond.as_ref(), ranges::warnings(netlist, solution.out_of_range(), true))
}

/// What is beyond sense, then laws outside their ranges.
pub(crate) fn told(
    netlist: &Netlist,
    beyond: Option<&Beyond>,
    outside: Vec<Diagnostic>,
) -> Vec<Diagnostic> {
    beyond.map(|beyond| warning(netlist, beyond)).into_iter().chain(outside).collect()
}

/// A warning that names the node, and the path and the source that probably did it.
fn warning(netlist: &Netlist, beyond: &Beyond) -> Diagnostic {
    let network = &netlist.network;
    let name = |item: Item| network.name_of(item).into_owned();
    let when = beyond.time.map_or_else(String::new, |time| format!(" at {}", duration(time, 4)));
    let message = format!(
        "node `{}` comes to {} degC{when}, which makes no sense",
        name(Item::Node(beyond.node)),
        significant(beyond.temperature - ZERO_CELSIUS, 4)
    );
    let mut warning = Diagnostic::warning("run::beyond_sense", message);
    let place = |item: Item| netlist.source_map.name(item);
    if let Some(span) = place(Item::Node(beyond.node)) {
        warning = warning.at(span, "");
    }
    let mut suspects = Vec::new();
    if let Some((id, difference)) = beyond.path {
        let item = Item::Conductor(id);
        suspects.push(format!("`{}`", name(item)));
        if let Some(span) = place(item) {
            warning =
                warning.also(span, format!("{} K between its ends", significant(difference, 4)));
        }
    }
    if let Some((id, heat)) = beyond.source {
        let item = Item::Source(id);
        suspects.push(format!("`{}`", name(item)));
        if let Some(span) = place(item) {
            warning = warning.also(span, format!("gives {} W", significant(heat, 4)));
        }
    }
    match suspects.is_empty() {
        true => warning.help("check the units of what joins and heats it"),
        false => warning.help(format!("check the units of {}", suspects.join(" and "))),
    }
}
