//! `lptn fit network --write`: the values go into the netlist.

use std::path::Path;

use lptn_fit::network::NetworkFitTask;
use lptn_network::ParameterId;
use lptn_report::Shortest;

use super::Answer;
use crate::console::Console;
use crate::written::{can_be_written, put, with_numbers};
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::words::spaced;

/// Digits that are written: a tenth of a standard error never is beyond them.
const DIGITS: usize = 9;

/// Refuses before anything is computed what could not be written afterwards.
pub(crate) fn possible(input: &Input, task: &NetworkFitTask<'_>) -> Result<(), Failure> {
    let codes = ["fit::write", "fit::write_shared"];
    task.parameters.iter().try_for_each(|varied| can_be_written(input, varied.parameter, codes))
}

pub(crate) fn write(answer: &Answer<'_>, file: &Path, console: &Console) -> Result<(), Failure> {
    let netlist = &answer.input.netlist;
    let numbers: Vec<(ParameterId, String)> = (0..answer.task.parameters.len())
        .filter_map(|i| {
            let parameter = answer.task.parameters[i].parameter;
            netlist.written_number(parameter)?;
            let value = answer.shown(i, answer.fit.parameters[i].value);
            let rounded = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
            Some((parameter, Shortest::new().text(rounded).to_owned()))
        })
        .collect();
    put(file, &with_numbers(answer.input, &numbers)?)?;
    for (i, (_, number)) in numbers.iter().enumerate() {
        let unit = spaced(&answer.units[i].text);
        console.note(&format!("wrote  {}: {} = {number}{unit}", file.display(), answer.name(i)));
    }
    Ok(())
}
