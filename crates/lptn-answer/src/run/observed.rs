//! Runs, and the nodes that their tables show.

use lptn_analysis::{RunAnalysis, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_netlist::Diagnostic;
use lptn_network::{Network, NodeId};
use lptn_solve::{RecordedNodes, Selection, Solution, SteadyState, StopReason, TransientError};

use crate::failure::Failure;
use crate::families;
use crate::input::Input;
use crate::listener::Listener;
use crate::refused::{explain, run_failed, unanswered};
use crate::words::MOST_NODES;

/// Nodes to record for these columns. Heat flows need all of them if any node has a length:
/// its Biot number is then checked in every row.
pub fn record(network: &Network, selection: &Selection) -> RecordedNodes {
    let is_lump = |id| network.length(id).is_some();
    if selection.has_heat() && network.node_ids().any(is_lump) {
        return RecordedNodes::All;
    }
    selection.record()
}

/// Runs to the stop, to the first failure or to Ctrl-C, and shows how far it is.
pub fn observed(
    input: &Input,
    (system, run): (&ThermalSystem, &RunAnalysis),
    listener: &dyn Listener,
) -> Result<(Trusted<Solution>, Option<Diagnostic>), Failure> {
    listener.begin();
    let outcome = run.solve(system, &mut |progress| listener.progress(progress));
    let error = match outcome {
        Ok(answer) => return Ok((answer, None)),
        Err(error) => error,
    };
    match error.into_part() {
        // nothing was computed, and nothing could be: the question does not fit the network
        Ok((_, Some(error))) if switches_nothing(&error) => Err(run_failed(input, &error)),
        // the rows are shown; the verdict asks their energy balance
        Ok((part, error)) => Ok((part, error.map(|error| explain(input, &error)))),
        Err(error) => Err(unanswered(input, &error)),
    }
}

fn switches_nothing(error: &TransientError) -> bool {
    matches!(error, TransientError::Stopped { reason: StopReason::NothingSwitches, .. })
}

/// Most nodes that are watched if families make few rows of them.
const MOST_WATCHED: usize = 500;

/// The nodes that a table shows.
/// They are the selected ones in the order of the file, by default all but the cells of grids. Of
/// too many the hottest in steady state are left, hottest first, or without one the first.
pub fn shown(
    network: &Network,
    selection: Option<&Selection>,
    steady: Option<&SteadyState>,
) -> Vec<NodeId> {
    let mut nodes: Vec<NodeId> = selection.into_iter().flat_map(Selection::nodes).collect();
    if nodes.is_empty() {
        nodes = network.outer_nodes().collect();
    }
    let name = |id: &NodeId| (network.nodes()[id.index()].name.clone(), 0);
    let rows = |nodes: &[NodeId]| families::folded(nodes.to_vec(), true, name, |_| 0.0).len();
    let few = nodes.len() <= MOST_WATCHED && rows(&nodes) <= MOST_NODES;
    if nodes.len() > MOST_NODES && !few {
        if let Some(steady) = steady {
            let at = |id: &NodeId| steady.temperatures[id.index()];
            nodes.sort_by(|a, b| at(b).total_cmp(&at(a)));
        }
        nodes.truncate(MOST_NODES);
    }
    nodes
}
