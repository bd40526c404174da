//! The state that a run leaves for another one to start from.

use lptn_netlist::{SavedState, StateControl, StateEnd};
use lptn_report::duration;
use lptn_solve::{RunStatus, Solution};

use crate::input::Input;

/// The state at the end that a run reached.
pub(super) fn of<'a>(input: &'a Input, solution: &'a Solution) -> SavedState<'a> {
    let network = solution.network();
    let nodes = network.nodes();
    let last = solution.last();
    let names = network.states().iter().map(|state| state.name.as_str());
    SavedState {
        network: &input.text.stem,
        title: solution.network().title(),
        time: last.time,
        end: match solution.end() {
            RunStatus::Reached => StateEnd::Reached,
            RunStatus::Interrupted(_) => StateEnd::Interrupted,
            RunStatus::Failed(_) => StateEnd::Failed,
        },
        temperatures: network
            .thermal_nodes()
            .map(|id| (nodes[id.index()].name.as_str(), last.temperatures[id.index()]))
            .collect(),
        states: names.zip(network.state_values(&last.temperatures)).collect(),
        melted: last
            .melted
            .iter()
            .map(|(id, share)| (nodes[id.index()].name.as_str(), *share))
            .collect(),
        controls: controls(solution),
    }
}

fn controls(solution: &Solution) -> Vec<StateControl<'_>> {
    let states = solution.network().controls().iter().zip(solution.controls());
    let held = |since: f64| since.is_finite().then(|| solution.last().time - since);
    states
        .map(|(control, at)| StateControl { name: &control.name, on: at.on, held: held(at.since) })
        .collect()
}

/// Source of the temperatures at the start, if it is not the netlist.
pub(super) fn origin(input: &Input) -> Option<String> {
    let state = input.netlist.initial()?;
    Some(format!("starts from {}, the state at {}", state.file, duration(state.time, 4)))
}
