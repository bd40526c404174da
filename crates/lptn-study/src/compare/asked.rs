//! The run of every candidate.

use lptn_analysis::RunAnalysis;
use lptn_network::{Network, NodeId, RunSettings};

use crate::compare::heat;

/// A run or cycle without rows and with the windows that its heats need: peaks and limits are
/// evaluated between rows.
pub(crate) fn bare(network: &Network, settings: &RunSettings) -> RunAnalysis {
    let windows = heat::window(network, (settings.start, settings.stop)).into_iter().collect();
    RunAnalysis::of(network, settings).bare().at(Vec::new()).over(windows)
}

/// The nodes of a network but for states, in its order.
pub(crate) fn all_nodes(network: &Network) -> Vec<NodeId> {
    network.thermal_nodes().collect()
}
