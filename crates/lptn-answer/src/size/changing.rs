//! Refusal to size a network whose inputs change with time, with a netlist to write instead.

use lptn_netlist::{Diagnostic, SizeStudy};
use lptn_network::{Changing, Course, Item, Network, SignalId, list_of};
use lptn_report::significant;
use lptn_study::SizeError;

use crate::input::Input;
use crate::words::spaced;

const OVER: &str = "size over all moments with `over = \"run\"`, or `over = \"periodic\"` for the \
                    periodic steady state";

/// The error with the place of everything that changes.
pub(super) fn explained(
    input: &Input,
    study: &SizeStudy,
    (error, changing): (&SizeError, &[Changing]),
) -> Diagnostic {
    let network = &input.netlist.network;
    let mut items: Vec<Item> = changing.iter().filter_map(Changing::item).collect();
    items.sort_unstable();
    items.dedup();
    let names: Vec<String> = items.iter().map(|item| network.name_of(*item).into_owned()).collect();
    let message = format!("size `{}`: {error}: {}", study.name, list_of(&names, "inputs"));
    let mut problem = Diagnostic::error(error.code(), message);
    let places = changing.iter().filter_map(|change| place(input, change));
    let mut known = Vec::new();
    for place in places {
        if known.contains(&place) {
            continue;
        }
        problem = match known.is_empty() {
            true => problem.at(place.clone(), "changes with time"),
            false => problem.also(place.clone(), "changes with time"),
        };
        known.push(place);
    }
    if known.is_empty() {
        problem = problem.at(study.span.clone(), "");
    }
    problem.help(format!("{OVER}; or {}", constant(network, changing)))
}

fn place(input: &Input, change: &Changing) -> Option<lptn_netlist::Span> {
    let map = &input.netlist.source_map;
    match (change.signal, change.input) {
        (Some(signal), _) => map.name(Item::Signal(signal)),
        (None, Some((item, field))) => map.get(item, field).or_else(|| map.name(item)),
        (None, None) => None,
    }
}

/// Help to make the inputs constant.
fn constant(network: &Network, changing: &[Changing]) -> String {
    let signal = changing.iter().find_map(|change| change.signal);
    match signal.and_then(|id| largest(network, id)) {
        Some(line) => {
            format!(
                "size for one load with a constant instead, for example its largest value below \
                [signal]: {line}"
            )
        }
        None => {
            "size for one load with a constant instead, its mean or its worst value, best as a \
            parameter that `--set` can change"
                .into()
        }
    }
}

/// The line that gives a signal of points its largest value at all times.
fn largest(network: &Network, id: SignalId) -> Option<String> {
    let signal = &network.signals()[id.index()];
    let values = match &signal.course {
        Course::Curve { points, .. } => points.values(),
        Course::Steps { values, .. } => values,
        Course::Expression(_) => return None,
    };
    let most = values.iter().copied().reduce(f64::max)?;
    let unit = spaced(&signal.ty.dimension.si_unit());
    Some(format!("`{} = \"{}{unit}\"`", signal.name, significant(most, 6)))
}
