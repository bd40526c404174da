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
    let outside = ranges::warnings(netlist, solution.out_of_range(), true);
    told(netlist, beyond.as_ref(), [outside, open(netlist, solution)].concat())
}

/// Results that change faster than steps are looked at.
fn open(netlist: &Netlist, solution: &Solution) -> Vec<Diagnostic> {
    let network = &netlist.network;
    let limits = solution.limits().iter().filter(|seen| seen.open > 0.0).map(|seen| {
        let limit = &network.limits()[seen.limit.index()];
        let (by, unit) = (significant(seen.open, 2), limit.ty.dimension.si_unit());
        let message = format!(
            "`{}` changes faster than a run looks: the margin of limit `{}` may be off by {by} {unit}",
            limit.text, limit.name
        );
        Diagnostic::warning("run::unresolved", message)
            .at(netlist.source_map.name(Item::Limit(seen.limit)), "")
    });
    let columns = solution.windows().iter().flat_map(|window| {
        window.columns.iter().filter(|column| column.is_open()).map(|column| {
            let by = significant(100.0 * column.open, 2);
            let message = format!(
                "`{}` changes faster than a run looks: its mean over `{}` may be off by {by} %",
                column.name, window.name
            );
            Diagnostic::warning("run::unresolved", message)
        })
    });
    let help = "write what jumps over the time as a signal or with `if(t < ..)`: these times are \
                met exactly";
    limits.chain(columns).map(|warning| warning.help(help)).collect()
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
