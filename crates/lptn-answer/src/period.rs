//! Length of a cycle.

use lptn_netlist::Diagnostic;
use lptn_network::Item;
use lptn_report::duration;
use lptn_units::Dimension;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};

/// The period that `--period` gives, or that of the repeated signals, in s.
pub fn of_cycle(input: &Input, given: Option<&str>) -> Result<f64, Failure> {
    let Some(text) = given else { return of_signals(input, HELPS) };
    let what = (Dimension::TIME, "periodic::period", "\"10 min\"");
    Ok(input::positive("--period", text, what)?.value)
}

const HELPS: [&str; 2] =
    ["give the time after which all inputs repeat: --period \"10 min\"", "leave --periodic out"];

/// The period of the repeated signals in s.
/// The texts help if it is not known, and if nothing changes.
pub fn of_signals(input: &Input, [unknown, constant]: [&'static str; 2]) -> Result<f64, Failure> {
    let network = &input.netlist.network;
    let problem = match network.repeat_period() {
        Ok(Some(period)) => return Ok(period),
        Ok(None) if network.has_time_dependent_inputs() => Diagnostic::error(
            "periodic::no_period",
            "no signal is repeated, so the period is not known",
        )
        .help(unknown),
        Ok(None) => {
            Diagnostic::error("periodic::no_period", "nothing changes with time: there is no cycle")
                .help(constant)
        }
        Err(none) => {
            let [first, second] = &none.names;
            let [a, b] = none.periods.map(|period| duration(period, 6));
            let message = format!(
                "`{second}` repeats itself every {b} and `{first}` every {a}: they have no period \
                 in common"
            );
            let problem = Diagnostic::error("periodic::no_common_period", message);
            let place = input.netlist.source_map.name(Item::Signal(none.signals[1]));
            problem.help("change one of the periods, or use `lptn run`").at(place, "")
        }
    };
    Err(input.refused(Exit::Input, problem))
}
