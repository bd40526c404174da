//! Streams that do not balance: what flows into a node has to flow out of it.

use lptn_data::Diagnostic;
use lptn_network::{End, Item, Network, Passing};

use crate::source_map::SourceMap;

/// A warning for each node into which streams bring another capacity rate than they take away, as
/// they stand at `time` in s. What has no value there is reported where it is used.
pub(crate) fn unbalanced(network: &Network, map: &SourceMap, time: f64) -> Vec<Diagnostic> {
    let passing = network.passing_streams(time).unwrap_or_default();
    let uneven = passing.into_iter().filter(|passing| !passing.is_balanced());
    uneven.map(|passing| warning(network, map, passing)).collect()
}

fn warning(network: &Network, map: &SourceMap, passing: Passing) -> Diagnostic {
    let Passing { node, inflow, outflow } = passing;
    let end = End::Node(node);
    let first = network.conductors().iter().zip(network.conductor_ids()).find(|(conductor, _)| {
        conductor.law.is_stream() && (conductor.from == end || conductor.to == end)
    });
    let name = network.name_of(Item::Node(node));
    let short =
        |rate: f64| lptn_units::format_number(format!("{rate:.5e}").parse().unwrap_or(rate));
    let message = format!(
        "streams bring {} W/K into node `{name}` and take {} W/K out of it",
        short(inflow),
        short(outflow)
    );
    let problem = Diagnostic::warning("network::unbalanced_streams", message);
    let problem = problem.at(first.and_then(|(_, id)| map.name(Item::Conductor(id))), "");
    let problem = problem.also(map.name(Item::Node(node)), "the node");
    problem.help(
        "what flows in flows out: an [advection] to the next node, or to a boundary where the \
         stream leaves the network",
    )
}
