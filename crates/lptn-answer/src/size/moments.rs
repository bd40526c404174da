//! Moments at which requirements are kept: in steady state, over a run, in the settled cycle.

use lptn_netlist::{Netlist, Over, SizeStudy};
use lptn_network::{Network, RunSettings};
use lptn_study::uncertainty::uncertain_anywhere;
use lptn_study::{Demand, Doubt, Moments, Watcher};

use super::kept::cases;
use crate::failure::Failure;
use crate::input::Input;
use crate::period;

/// Help if the period of a cycle is not known, and if nothing changes.
const HELPS: [&str; 2] = [
    "give the time after which all inputs repeat: `period = \"10 min\"`",
    "write `over = \"steady\"`",
];

/// Refuses a settled cycle of unknown period.
pub(super) fn check_period(input: &Input, study: &SizeStudy) -> Result<(), Failure> {
    let given = study.period(&input.netlist.network).is_ok_and(|period| period.is_some());
    if study.over == Over::Periodic && !given {
        period::of_signals(input, HELPS)?;
    }
    Ok(())
}

/// Answers a question about the demands of a study on a network.
pub(super) fn demanded<T>(
    (netlist, study): (&Netlist, &SizeStudy),
    watcher: &Watcher<'_>,
    ask: impl FnOnce(Demand<'_>) -> T,
) -> T {
    let run = |network: &Network| run_of(netlist, network)?.ok_or("there is no [run]".to_owned());
    let cycle = |network: &Network| cycle_of((netlist, study), network);
    let moments = match study.over {
        Over::Steady => Moments::Steady(netlist.run.as_ref().map_or(0.0, |run| run.start)),
        Over::Run => Moments::Run(&run),
        Over::Periodic => Moments::Periodic(&cycle),
    };
    let cases = cases(netlist, study);
    let inputs = uncertain_anywhere(&netlist.network, &netlist.overrides()).ok();
    let probability = study.probability(&netlist.network).ok().flatten();
    ask(Demand {
        network: &netlist.network,
        netlist,
        cases: &cases,
        requirements: &study.requirements,
        moments,
        doubt: probability.map(|probability| Doubt { probability, inputs: inputs.as_ref() }),
        watcher,
    })
}

/// The run with the parameters of a network.
fn run_of(netlist: &Netlist, network: &Network) -> Result<Option<RunSettings>, String> {
    netlist.run_of(network).map_err(|problems| {
        problems.first().map_or_else(String::new, |problem| problem.message.clone())
    })
}

/// The settled cycle with them.
fn cycle_of(
    (netlist, study): (&Netlist, &SizeStudy),
    network: &Network,
) -> Result<RunSettings, String> {
    let given = study.period(network).map_err(|error| error.to_string())?;
    let signals = || network.repeat_period().ok().flatten();
    let period = given.or_else(signals).ok_or("its period is not known")?;
    Ok(RunSettings::cycle(run_of(netlist, network)?.as_ref(), period))
}
