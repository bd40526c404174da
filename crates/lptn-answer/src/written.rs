//! Netlists that are written: each is read again and compared before it is used.

use std::path::Path;

use lptn_netlist::{Diagnostic, RunSettings, WrittenError, parse_file, prove};
use lptn_network::{BuildErrors, Network, ParameterId};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;

/// Without a run, the values are compared over this time in s.
const AN_HOUR: f64 = 3600.0;

/// The text of a netlist that is to be written to `place`, if reading it there gives this network.
///
/// # Errors
/// A text that reads as another network: a mistake of this program.
pub fn proven(
    text: String,
    place: &Path,
    network: &Network,
    run: Option<&RunSettings>,
) -> Result<String, Failure> {
    let span = run.map_or((0.0, AN_HOUR), |run| (run.start, run.stop));
    prove(&text, place, network, span).map(|_| text).map_err(|error| mistake(&error))
}

/// The text of the netlist with other numbers for some parameters.
/// A parameter that is not written as a number keeps its text.
///
/// # Errors
/// A netlist that is no longer read, and a text that reads as another network.
pub fn with_numbers(input: &Input, numbers: &[(ParameterId, String)]) -> Result<String, Failure> {
    let (netlist, place) = (&input.netlist, Path::new(&input.text.name));
    // values set on the command line are not in the file
    let original = parse_file(place, &input.text.bytes)?;
    let mut parameters = original.network.overrides();
    let mut written = Vec::with_capacity(numbers.len());
    for (id, number) in numbers {
        let name = &netlist.network.parameters()[id.index()].name;
        let (Some(place), Ok(value)) = (netlist.written_number(*id), number.parse()) else {
            continue;
        };
        if let Ok(id) = original.network.parameter(name) {
            parameters.set(id, place.unit.to_si(value));
        }
        written.push((place, number.clone()));
    }
    let text = netlist.text_with_numbers(&written);
    let network =
        original.network.with(&parameters).map_err(|errors| mistake(&rejected(&errors)))?;
    proven(text, place, &network, original.run.as_ref())
}

fn rejected(errors: &BuildErrors) -> WrittenError {
    WrittenError::Rejected { reason: errors.0.first().map(ToString::to_string).unwrap_or_default() }
}

fn mistake(error: &WrittenError) -> Failure {
    let problem = Diagnostic::error("output::written_netlist", error.to_string());
    let help = "nothing was written; this is a fault in lptn: please report it with the netlist";
    Failure::new(Exit::Failed, problem.help(help))
}

/// Refuses a parameter whose number could not be written.
/// `code` is that of the problem, `shared` that of a number which several instances share.
///
/// # Errors
/// A netlist from stdin, a protected or included file, and a value that is not a number.
pub fn can_be_written(
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
        let problem = Diagnostic::error(code, format!("`{name}` is in an included file"));
        problem
            .help("other netlists may include it too: change it there, or move the parameter here")
    } else if let Some(other) = netlist.written_together(parameter) {
        let message =
            format!("`{name}` is written once for several instances, `{other}` among them");
        let problem = Diagnostic::error(shared, message).help(
            "give each its own value, `set = { .. = [.., ..] }`, or make it a parameter of the \
                file",
        );
        problem.at(netlist.source_map.parameter(parameter), "")
    } else if netlist.written_number(parameter).is_none() {
        let message =
            format!("`{name}` is not written as a number, so another number cannot replace it");
        let problem = Diagnostic::error(code, message)
            .help("give it its own value, for example `\"5 W/K\"`, or leave `--write` out");
        problem.at(netlist.source_map.parameter(parameter), "")
    } else {
        return Ok(());
    };
    Err(Failure::at(Exit::Input, netlist.files.clone(), problem))
}

/// True if a file is read-only: replacing it would ignore its permissions.
fn is_protected(file: &str) -> bool {
    std::fs::metadata(file).is_ok_and(|metadata| metadata.permissions().readonly())
}
