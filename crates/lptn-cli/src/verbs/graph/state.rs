//! The state that is drawn: where the network settles, or a time of its run.

use lptn_solve::Snapshot;
use lptn_units::Unit;

use super::args::GraphArgs;
use crate::console::Console;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::operating_point::{at, steady};

/// The time that is asked for, else the steady state.
pub(super) fn state(
    args: &GraphArgs,
    (input, unit, console): (&Input, &Unit, &Console),
) -> Result<Snapshot, Failure> {
    let (state, doubts) = match &args.at {
        Some(text) => at(text, input, &console.listening())?,
        None => {
            let (steady, doubts) = steady(input, unit)?;
            (steady.state, doubts)
        }
    };
    console.warn(&input.netlist.files, &doubts);
    Ok(state)
}
