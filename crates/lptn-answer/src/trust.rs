//! Implausible results, and laws outside their ranges, in words.

use lptn_analysis::{Trust, Unresolved};
use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Functional, Item, ZERO_CELSIUS};
use lptn_report::{duration, significant};
use lptn_solve::Beyond;

use crate::ranges;

/// Doubts in the numbers of an answer; `run` means over time.
/// Implausible values, laws outside their ranges, results that change faster than steps resolve.
pub fn doubts(netlist: &Netlist, trust: &Trust, run: bool) -> Vec<Diagnostic> {
    let beyond = trust.beyond.iter().map(|beyond| implausible(netlist, beyond, run));
    let outside = ranges::warnings(netlist, &trust.out_of_range, run);
    let unresolved = trust.unresolved.iter().map(|open| unresolved(netlist, open));
    let grows = trust.grows.map(unstable);
    let streams = trust.unbalanced.iter().map(|passing| {
        lptn_netlist::unbalanced_streams(&netlist.network, &netlist.source_map, *passing)
    });
    beyond.chain(outside).chain(unresolved).chain(grows).chain(streams).collect()
}

/// The warning about a periodic state from which runs depart.
fn unstable(factor: f64) -> Diagnostic {
    let message = format!(
        "the periodic steady state is unstable: each cycle multiplies a disturbance by about {}, so \
         a run departs from it",
        significant(factor, 3)
    );
    Diagnostic::warning("periodic::unstable", message).help(
        "check for a heat that grows faster with a temperature or a state than the cooling does; \
         `lptn run` over many cycles shows the state that it reaches",
    )
}

fn unresolved(netlist: &Netlist, open: &Unresolved) -> Diagnostic {
    let warning = match open {
        Unresolved::Margin { limit: id, by } => {
            let limit = &netlist.network.limits()[id.index()];
            let (by, unit) = (significant(*by, 2), limit.ty.dimension.si_unit());
            let message = format!(
                "`{}` changes faster than a run samples: the margin of limit `{}` may be off by \
                 {by} {unit}",
                limit.text, limit.name
            );
            Diagnostic::warning("run::unresolved", message)
                .at(netlist.source_map.name(Item::Limit(*id)), "")
        }
        Unresolved::Report { report: id, by } => {
            let report = &netlist.network.reports()[id.index()];
            let life = report.over_time.as_ref().is_some_and(|o| o.functional == Functional::Life);
            let (by, unit) = match life {
                true => (significant(100.0 * by, 2), "%".to_owned()),
                false => (significant(*by, 2), report.ty.dimension.si_unit()),
            };
            let message = format!(
                "`{}` changes faster than a run samples: report `{}` may be off by {by} {unit}",
                report.text, report.name
            );
            Diagnostic::warning("run::unresolved", message)
                .at(netlist.source_map.name(Item::Report(*id)), "")
        }
        Unresolved::Mean { column, window, share } => {
            let by = significant(100.0 * share, 2);
            let message = format!(
                "`{column}` changes faster than a run samples: its mean over `{window}` may be off \
                 by {by} %"
            );
            Diagnostic::warning("run::unresolved", message)
        }
    };
    warning
        .help("write jumps over time as a signal or with `if(t < ..)`: these times are met exactly")
}

/// A warning that names the node, and the path and the source that probably did it; `run` means
/// the steady state of a run.
pub fn implausible(netlist: &Netlist, beyond: &Beyond, run: bool) -> Diagnostic {
    let network = &netlist.network;
    let name = |item: Item| network.name_of(item).into_owned();
    let when = match beyond.time {
        Some(time) => format!(" at {}", duration(time, 4)),
        None if run => " in steady state".to_owned(),
        None => String::new(),
    };
    let message = format!(
        "node `{}` reaches {} degC{when}, which is not plausible",
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
        true => warning.help("check the units of its paths and sources"),
        false => warning.help(format!("check the units of {}", suspects.join(" and "))),
    }
}
