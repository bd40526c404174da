//! `lptn size --write`: the value goes into the netlist, and the netlist proves it.

use std::path::Path;

use lptn_netlist::{Diagnostic, Goal, Netlist, parse_file};
use lptn_network::ParameterId;
use lptn_report::Shortest;
use lptn_study::requirement_margins;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::{Failure, reason};
use crate::files::Folder;
use crate::input::Input;
use crate::size::Answer;
use crate::size_text::rounded;
use crate::written::with_numbers;

/// Digits that are tried, the fewest first.
const DIGITS: std::ops::RangeInclusive<usize> = 6..=17;

/// Refuses before anything is computed what could not be written afterwards.
pub(crate) fn possible(input: &Input, parameter: ParameterId) -> Result<(), Failure> {
    can_be_written(input, parameter, ["size::write", "size::write_shared"])
}

/// The same with the codes of another verb.
pub(crate) fn can_be_written(
    input: &Input,
    parameter: ParameterId,
    [code, shared]: [&'static str; 2],
) -> Result<(), Failure> {
    let netlist = &input.netlist;
    let name = &netlist.network.parameters()[parameter.index()].name;
    let problem = if input.typed().is_none() {
        Diagnostic::error(code, "there is no file to write into: the netlist came from stdin")
    } else if is_protected(&input.text.name) {
        let message = format!("{} is protected against writing", input.text.name);
        Diagnostic::error(code, message).help("allow it with `chmod u+w`, or leave `--write` out")
    } else if netlist.written_number(parameter).is_some_and(|written| !netlist.is_own(&written)) {
        let problem = Diagnostic::error(code, format!("`{name}` stands in a file that is included"));
        problem.help("other netlists may include it too: change it there, or move the parameter here")
    } else if let Some(other) = netlist.written_together(parameter) {
        let message = format!("`{name}` is written once for several instances, `{other}` among them");
        let problem = Diagnostic::error(shared, message)
            .help("give each its own value, `set = { .. = [.., ..] }`, or make it a parameter of the file");
        match netlist.source_map.parameter(parameter) {
            Some(span) => problem.at(span.clone(), ""),
            None => problem,
        }
    } else if netlist.written_number(parameter).is_none() {
        let message = format!("`{name}` is not written as a number, so no other can be written in its place");
        let problem = Diagnostic::error(code, message)
            .help("give it a value of its own, for example `\"5 W/K\"`, or leave `--write` out");
        match netlist.source_map.parameter(parameter) {
            Some(span) => problem.at(span.clone(), ""),
            None => problem,
        }
    } else {
        return Ok(());
    };
    Err(Failure::at(Exit::Input, netlist.files.clone(), problem))
}

/// A file that is replaced would not be protected by its permissions.
fn is_protected(file: &str) -> bool {
    std::fs::metadata(file).is_ok_and(|metadata| metadata.permissions().readonly())
}

pub(crate) fn write(answer: &Answer<'_>, file: &Path, console: &Console) -> Result<(), Failure> {
    let Some(number) = proven(answer) else {
        let problem = Diagnostic::error("size::write", "no number of 17 digits keeps what is required");
        return Err(Failure::new(Exit::Failed, problem));
    };
    put(file, &with_numbers(answer.input, &[(answer.parameter, number.clone())])?)?;
    let unit = if answer.unit.text == "1" { String::new() } else { format!(" {}", answer.unit.text) };
    console.note(&format!("wrote  {}: {} = {number}{unit}", file.display(), answer.study.parameter));
    Ok(())
}

/// Replaces a netlist by another text.
pub(crate) fn put(file: &Path, text: &str) -> Result<(), Failure> {
    // a link stays a link: what it leads to is written
    let place = std::fs::canonicalize(file).map_err(|error| cannot_write(file, &reason(&error)))?;
    let name = place.file_name().map(|name| name.to_string_lossy().into_owned());
    let (Some(folder), Some(name)) = (place.parent(), name) else {
        return Err(cannot_write(file, "it has no name"));
    };
    let folder = Folder::prepare_for_a_moment(folder.to_owned()).map_err(as_it_was)?;
    let mut files = folder.batch();
    let written = files.write(&name, |out| out.write_all(text.as_bytes()));
    written.and_then(|()| files.commit(&[])).map_err(as_it_was)
}

/// The help of a folder is about results.
fn as_it_was(mut failure: Failure) -> Failure {
    for problem in &mut failure.diagnostics {
        problem.help = Some("the netlist is as it was: write the value into it by hand".into());
    }
    failure
}

fn cannot_write(file: &Path, why: &str) -> Failure {
    let message = format!("cannot write {}: {why}", file.display());
    Failure::new(Exit::Failed, Diagnostic::error("output::cannot_write", message))
}

/// The number with the fewest digits whose netlist, read again from its text, keeps every requirement.
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
    let study = netlist.sizes.iter().find(|study| study.name == answer.study.name)?;
    let (from, to) = study.range(&netlist.network).ok()?;
    let value = netlist.network.parameter_value(netlist.network.parameter(&study.parameter).ok()?);
    let time = netlist.run.as_ref().map_or(0.0, |run| run.start);
    let margins = requirement_margins(&netlist.network, &study.requirements, time).ok()?;
    Some(value >= from && value <= to && margins.iter().all(|margin| *margin >= 0.0))
}
