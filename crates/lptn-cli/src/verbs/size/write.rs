//! `lptn size --write`: the value goes into the netlist, and the netlist proves it.

use std::path::Path;

use lptn_netlist::{Diagnostic, Goal, Netlist, SizeStudy, parse_file};
use lptn_network::ParameterId;
use lptn_report::Shortest;
use lptn_solve::Proceed;
use lptn_study::judge;

use super::Answer;
use super::moments::demanded;
use super::page::rounded;
use crate::console::Console;
use crate::written::{can_be_written, put, with_numbers};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::words::{count, spaced};

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
    console.note(&format!("wrote  {}: {} = {number}{unit}", file.display(), answer.name));
    Ok(())
}

/// Writes several values, with as few digits as keep everything, and the exact ones of parts.
pub(super) fn write_all(
    (input, study): (&Input, &SizeStudy),
    values: &[(ParameterId, f64)],
    (file, console): (&Path, &Console),
) -> Result<(), Failure> {
    let numbers = |digits: usize| -> Vec<(ParameterId, String)> {
        let number = |&(id, value): &(ParameterId, f64)| {
            let shown = input.unit_of(id).from_si(value);
            let text = format!("{shown:.*e}", digits - 1);
            let number = text.parse().unwrap_or(shown);
            (id, Shortest::new().text(number).to_owned())
        };
        values.iter().map(number).collect()
    };
    let proven = DIGITS.into_iter().find_map(|digits| {
        let text = with_numbers(input, &numbers(digits)).ok()?;
        let again = parse_file(Path::new(&input.text.name), text.as_bytes()).ok()?;
        keeps(&study.name, &again)?.then_some(text)
    });
    let Some(text) = proven else {
        let problem =
            Diagnostic::error("size::write", "no numbers of 17 digits keep what is required");
        return Err(Failure::new(Exit::Failed, problem));
    };
    put(file, &text)?;
    console.note(&format!("wrote  {}: {}", file.display(), count(values.len(), "parameter")));
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
        keeps(&answer.study.name, &again)?.then_some(number)
    })
}

/// Whether a netlist stays inside the ranges of a study and keeps everything.
fn keeps(name: &str, netlist: &Netlist) -> Option<bool> {
    let study = netlist.studies.sizes.iter().find(|study| study.name == name)?;
    let within = |&(id, (from, to)): &(ParameterId, (f64, f64))| {
        (from..=to).contains(&netlist.network.parameter_value(id))
    };
    let inside = study.ranges(&netlist.network).ok()?.iter().all(within);
    let watcher = |_| Proceed::Continue;
    let judged = demanded((netlist, study), &watcher, judge).ok()?;
    Some(inside && judged.keeps())
}
