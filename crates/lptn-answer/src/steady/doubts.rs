//! Warnings to know before a steady state is believed.

use lptn_analysis::LimitResult;
use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Item, Network, NodeId, list_of, list_of_names};
use lptn_report::{duration, significant};
use lptn_solve::{Others, SteadyState};
use lptn_units::Unit;

/// Warning that inputs change with time: its effect on limits, and a verb for all times.
/// `file` is the name of the netlist as it was typed.
pub fn inputs_vary(
    (netlist, file): (&Netlist, Option<&str>),
    steady: &SteadyState,
    limits: &[LimitResult],
) -> Option<Diagnostic> {
    let network = &netlist.network;
    let quantities = network.limits().iter().flat_map(|limit| [&limit.of, &limit.value]);
    let quantities: Vec<_> =
        quantities.chain(network.reports().iter().map(|report| &report.value)).collect();
    let mut changing = network.changing_inputs();
    changing.extend(network.changing_inputs_of(&quantities));
    if changing.is_empty() {
        return None;
    }
    let mut names: Vec<String> =
        changing.iter().filter_map(|c| Some(network.name_of(c.item()?).into_owned())).collect();
    names.sort_unstable();
    names.dedup();
    let which =
        if names.is_empty() { String::new() } else { format!(", {}", list_of(&names, "inputs")) };
    let judged = if limits.iter().any(LimitResult::is_open) {
        ", and limits that depend on them are not judged"
    } else {
        ""
    };
    let at = duration(steady.time, 4);
    let instead = instead(netlist, file).map_or(String::new(), |verb| format!("; {verb}"));
    let message =
        format!("inputs change with time{which}: their values at {at} are used{judged}{instead}");
    Some(Diagnostic::warning("steady::inputs_vary", message))
}

/// The verb that solves every time.
fn instead(netlist: &Netlist, file: Option<&str>) -> Option<String> {
    let file = file.unwrap_or("FILE");
    if matches!(netlist.network.repeat_period(), Ok(Some(_))) {
        return Some(format!("`lptn steady --periodic {file}` solves the whole cycle"));
    }
    netlist.run.as_ref().map(|_| format!("`lptn run {file}` solves every time"))
}

/// Nodes that keep their energy have a steady state that depends on their start.
pub fn adiabatic(network: &Network, steady: &SteadyState) -> Option<Diagnostic> {
    let name = |id: &NodeId| network.nodes()[id.index()].name.clone();
    let names: Vec<String> = steady.adiabatic.iter().map(name).collect();
    let message = format!(
        "no path leads to a boundary from {}: the energy at the start determines their final \
         temperatures",
        list_of_names(&names)
    );
    (!names.is_empty()).then(|| Diagnostic::warning("steady::energy", message))
}

/// Warning that the start decides which steady state is reached.
/// It is given if that is known or cannot be excluded.
pub fn others(network: &Network, steady: &SteadyState, unit: &Unit) -> Option<Diagnostic> {
    let warn = |code, message: String| Some(Diagnostic::warning(code, message));
    match &steady.others {
        Others::None => None,
        Others::NotKnown => warn(
            "steady::not_followed",
            "the network may have several steady states, and it could not be followed from its \
             start to this one"
                .into(),
        ),
        Others::At(temperatures) | Others::Unstable(temperatures) => {
            let apart =
                |id: &NodeId| (temperatures[id.index()] - steady.temperatures[id.index()]).abs();
            let most = network.node_ids().max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
            let at =
                |kelvin: f64| format!("{} {}", significant(unit.from_si(kelvin), 4), unit.text);
            let (here, there) =
                (at(steady.temperatures[most.index()]), at(temperatures[most.index()]));
            let name = network.name_of(Item::Node(most));
            let stays = match &steady.others {
                Others::Unstable(_) => {
                    ", which is unstable: from beyond it the network reaches another state, or \
                     runs away"
                }
                _ => "",
            };
            warn(
                "steady::several",
                format!(
                    "several steady states: from its start the network reaches the one with \
                     `{name}` at {here}; in another it is at {there}{stays}"
                ),
            )
        }
    }
}
