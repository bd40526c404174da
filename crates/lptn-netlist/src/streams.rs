//! Streams that do not balance: a flow into a node has to leave it, and a flow from a cooler has to
//! arrive.

use lptn_data::Diagnostic;
use lptn_network::{End, Item, Network, Outlet, Passing};

use crate::source_map::SourceMap;

/// A warning for each node into which streams bring another capacity rate than they take away, at
/// `time` in s. A rate without a value there is reported by its use.
pub(crate) fn unbalanced(network: &Network, map: &SourceMap, time: f64) -> Vec<Diagnostic> {
    let passing = network.passing_streams(time).unwrap_or_default();
    let uneven = passing.into_iter().filter(|passing| !passing.is_balanced());
    uneven.map(|passing| unbalanced_streams(network, map, passing)).collect()
}

/// A warning for each cooler whose outlet gets another stream than the one that it cools, as
/// [`unbalanced`].
pub(crate) fn wrong_outlets(network: &Network, map: &SourceMap, time: f64) -> Vec<Diagnostic> {
    let outlets = network.outlets(time).unwrap_or_default();
    let wrong = outlets.into_iter().filter(|outlet| !outlet.is_one_stream());
    wrong.map(|outlet| wrong_outlet(network, map, outlet)).collect()
}

fn wrong_outlet(network: &Network, map: &SourceMap, outlet: Outlet) -> Diagnostic {
    let Outlet { path, rate, inflow } = outlet;
    let conductor = &network.conductors()[path.index()];
    let (section, from) = (conductor.kind.declaration().section, conductor.from);
    let from = network.name_of(from.into());
    let message = format!(
        "{section} `{}` lets a stream of {} W/K out at `{from}`, but streams bring {} W/K there",
        conductor.name(),
        short(rate),
        short(inflow)
    );
    let problem = Diagnostic::warning("network::outlet_stream", message);
    problem.at(map.name(Item::Conductor(path)), "").help(format!(
        "bring the stream that is cooled to `{from}` by an [advection] of the same flow; if `from` \
         is the inlet of the stream, leave `_from_is_outlet` out"
    ))
}

/// A rate with six digits.
fn short(rate: f64) -> String {
    lptn_units::format_number(format!("{rate:.5e}").parse().unwrap_or(rate))
}

/// The warning about a node into which streams bring another capacity rate than they take away.
pub fn unbalanced_streams(network: &Network, map: &SourceMap, passing: Passing) -> Diagnostic {
    let Passing { node, inflow, outflow, growth } = passing;
    let end = End::Node(node);
    let first = network.conductors().iter().zip(network.conductor_ids()).find(|(conductor, _)| {
        conductor.law.is_stream() && (conductor.from == end || conductor.to == end)
    });
    let name = network.name_of(Item::Node(node));
    let message = format!(
        "streams bring {} W/K into node `{name}` and take {} W/K out of it",
        short(inflow),
        short(outflow)
    );
    let grows = match growth == 0.0 {
        true => String::new(),
        false => format!("; its capacity grows by {} W/K", short(growth)),
    };
    let problem = Diagnostic::warning("network::unbalanced_streams", message + &grows);
    let problem = problem.at(first.and_then(|(_, id)| map.name(Item::Conductor(id))), "");
    let problem = problem.also(map.name(Item::Node(node)), "the node");
    problem.help(
        "add the stream that leaves: an [advection] to the next node, or to a boundary if it \
         leaves the network",
    )
}
