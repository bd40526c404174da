//! `lptn size --write`: the value goes into the netlist, and the netlist proves it.

use std::path::Path;

use lptn_netlist::{Diagnostic, Goal, Netlist, parse_file};
use lptn_network::ParameterId;
use lptn_report::Shortest;
use lptn_solve::Proceed;
use lptn_study::judge;

use super::Answer;
use super::moments::demanded;
use super::page::rounded;
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::words::spaced;
use crate::written::{can_be_written, put, with_numbers};

/// Digits that are tried, the fewest first.
const DIGITS: std::ops::RangeInclusive<usize> = 6..=17;

/// Refuses before anything is computed what could not be written afterwards.
pub(crate) fn possible(input: &Input, parameter: ParameterId) -> Result<(), Failure> {
    can_be_written(input, parameter, ["size::write", "size::write_shared"])
}

pub(crate) fn write(answer: &Answer<'_>, file: &Path, console: &Console) -> Result<(), Failure> {
    let Some(number) = proven(answer) else {
        let problem =
            Diagnostic::error("size::write", "no number of 17 digits keeps what is required");
        return Err(Failure::new(Exit::Failed, problem));
    };
    put(file, &with_numbers(answer.input, &[(answer.parameter, number.clone())])?)?;
    let unit = spaced(&answer.unit.text);
    console.note(&format!(
        "wrote  {}: {} = {number}{unit}",
        file.display(),
        answer.study.parameter
    ));
    Ok(())
}

/// The number with the fewest digits whose netlist, read again from its text, keeps every
/// requirement.
fn proven(answer: &Answer<'_>) -> Option<String> {
    let netlist = &answer.input.netlist;
    let written = netlist.written_number(answer.parameter)?;
    let value = answer.unit.from_si(answer.sizing.trial.value);
    let up = answer.study.goal == Goal::Minimise;
    DIGITS.into_iter().find_map(|digits| {
        let number = Shortest::new().text(rounded(value, digits, up)).to_owned();
        let text = netlist.text_with_number(&written, &number);
        let again = parse_file(Path::new(&answer.input.text.name), text.as_bytes()).ok()?;
        keeps(answer, &again)?.then_some(number)
    })
}

/// Whether a netlist stays inside the range of its study and keeps everything.
fn keeps(answer: &Answer<'_>, netlist: &Netlist) -> Option<bool> {
    let study = netlist.studies.sizes.iter().find(|study| study.name == answer.study.name)?;
    let (from, to) = study.range(&netlist.network).ok()?;
    let value = netlist.network.parameter_value(netlist.network.parameter(&study.parameter).ok()?);
    let watcher = |_| Proceed::Continue;
    let judged = demanded((netlist, study), &watcher, judge).ok()?;
    Some(value >= from && value <= to && judged.keeps())
}
