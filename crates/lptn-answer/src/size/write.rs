//! Values in the netlist, which proves them.

use std::path::Path;

use lptn_netlist::{Diagnostic, Goal, Netlist, parse_file};
use lptn_network::ParameterId;
use lptn_report::Shortest;
use lptn_solve::Proceed;
use lptn_study::{certify, judge};

use super::Asked;
use super::moments::demanded;
use super::page::rounded;
use super::single::Sized;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::words::{count, spaced};
use crate::written::{can_be_written, with_numbers};

/// Digits that are tried, the fewest first.
const DIGITS: std::ops::RangeInclusive<usize> = 6..=17;

/// Refuses a parameter that could not be written, before anything is computed.
pub(super) fn possible(input: &Input, parameter: ParameterId) -> Result<(), Failure> {
    can_be_written(input, parameter, ["size::write", "size::write_shared"])
}

/// A netlist with values in it.
#[derive(Clone, Debug)]
pub struct Written {
    /// The text of the file.
    pub text: String,
    /// The value that was written, `G = 3.41 W/K`, or how many were.
    pub values: String,
}

/// The netlist with the value of one parameter.
pub(super) fn of_one(answer: &Sized) -> Result<Written, Failure> {
    let Some(number) = proven(answer) else { return Err(no_number("no number of", "keeps")) };
    let text = with_numbers(&answer.asked.input, &[(answer.parameter, number.clone())])?;
    let unit = spaced(&answer.unit.text);
    Ok(Written { text, values: format!("{} = {number}{unit}", answer.name) })
}

fn no_number(which: &str, keep: &str) -> Failure {
    let message = format!("{which} 17 digits {keep} the requirements");
    Failure::new(Exit::Failed, Diagnostic::error("size::write", message))
}

/// The netlist with several values in SI units, with as few digits as keep everything.
/// Values of parts are exact.
pub(super) fn of_all(
    Asked { input, study, .. }: &Asked,
    values: &[(ParameterId, f64)],
) -> Result<Written, Failure> {
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
        keeps((&study.name, false), &again)?.then_some(text)
    });
    let text = proven.ok_or_else(|| no_number("no numbers of", "keep"))?;
    Ok(Written { text, values: count(values.len(), "parameter") })
}

/// The number with the fewest digits that keeps every requirement.
/// Its netlist is read again from its text.
fn proven(answer: &Sized) -> Option<String> {
    let netlist = &answer.asked.input.netlist;
    let written = netlist.written_number(answer.parameter)?;
    let value = answer.unit.from_si(answer.sizing.trial.value);
    let up = answer.asked.study.goal == Goal::Minimise;
    let proves = answer.asked.kept.can_be_proven();
    let numbers = DIGITS.map(|digits| rounded(value, digits, up));
    answer.asked.kept.instead().into_iter().chain(numbers).find_map(|number| {
        let number = Shortest::new().text(number).to_owned();
        let text = netlist.text_with_number(&written, &number);
        let again = parse_file(Path::new(&answer.asked.input.text.name), text.as_bytes()).ok()?;
        keeps((&answer.asked.study.name, proves), &again)?.then_some(number)
    })
}

/// True if a netlist stays inside the ranges of a study and keeps everything, with proof if `proves`.
fn keeps((name, proves): (&str, bool), netlist: &Netlist) -> Option<bool> {
    let study = netlist.studies.sizes.iter().find(|study| study.name == name)?;
    let within = |&(id, (from, to)): &(ParameterId, (f64, f64))| {
        (from..=to).contains(&netlist.network.parameter_value(id))
    };
    let inside = study.ranges(&netlist.network).ok()?.iter().all(within);
    let watcher = |_| Proceed::Continue;
    let judged = match proves {
        true => demanded((netlist, study), &watcher, |demand| certify(demand, &[])),
        false => demanded((netlist, study), &watcher, judge),
    };
    let judged = judged.ok()?;
    Some(inside && judged.keeps() && (!proves || judged.is_proven()))
}
