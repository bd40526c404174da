//! `lptn fit network --write`: the values go into the netlist.

use std::path::Path;

use lptn_answer::failure::Failure;
use lptn_answer::fit::network::{FitNetworkAnswer, FitOfNetwork};
use lptn_answer::input::Input;
use lptn_answer::words::spaced;
use lptn_network::ParameterId;

use crate::console::Console;
use crate::written::{can_be_written, put, with_numbers};

/// Refuses a parameter that could not be written, before anything is computed.
pub(super) fn possible(input: &Input, fit: &FitOfNetwork) -> Result<(), Failure> {
    let codes = ["fit::write", "fit::write_shared"];
    fit.varied().try_for_each(|parameter| can_be_written(input, parameter, codes))
}

pub(super) fn write(
    answer: &FitNetworkAnswer,
    file: &Path,
    console: &Console,
) -> Result<(), Failure> {
    let found = answer.numbers();
    let numbers: Vec<(ParameterId, String)> =
        found.iter().map(|(_, id, number)| (*id, number.clone())).collect();
    put(file, &with_numbers(answer.input(), &numbers)?)?;
    for (i, _, number) in &found {
        let (name, unit) = (&answer.names[*i], spaced(&answer.units[*i].text));
        console.note(&format!("wrote  {}: {name} = {number}{unit}", file.display()));
    }
    Ok(())
}
