//! From what a netlist asks of a run to what the solver takes.

use lptn_netlist::RunSettings;
use lptn_network::{Network, Time};
use lptn_solve::{ControlState, Transient};

/// The run that the settings describe: its times, rows and tolerance, and where the controls stand at its start. What is
/// recorded and watched is left to the caller.
pub fn transient(network: &Network, run: &RunSettings) -> Transient {
    Transient {
        start: run.start,
        output: run.output.clone(),
        tolerance: run.tolerance,
        controls: controls(network, run),
        ..Transient::until(Time(run.stop))
    }
}

/// The controls of a run that starts from a state; none for another one, which begins as the network says.
fn controls(network: &Network, run: &RunSettings) -> Vec<ControlState> {
    let since = |held: &Option<f64>| held.map_or(f64::NEG_INFINITY, |held| run.start - held);
    let stands = network.initial_positions().controls.into_iter().zip(&run.held);
    stands.map(|(on, held)| ControlState { on, since: since(held) }).collect()
}
