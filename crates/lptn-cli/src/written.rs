//! Netlists that are written: each is read again, and compared, before anybody gets it.

use std::path::Path;

use lptn_netlist::{Diagnostic, RunSettings, WrittenError, parse_file, prove};
use lptn_network::{BuildErrors, Network, ParameterId};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;

/// Without a run, the values are compared over this time in s.
const AN_HOUR: f64 = 3600.0;

/// A text that is going to stand at `place`, if it is read there as this network.
pub(crate) fn proven(
    text: String,
    place: &Path,
    network: &Network,
    run: Option<&RunSettings>,
) -> Result<String, Failure> {
    let span = run.map_or((0.0, AN_HOUR), |run| (run.start, run.stop));
    prove(&text, place, network, span).map(|_| text).map_err(|error| mistake(&error))
}

/// The netlist with other numbers in the places of some parameters' own, where these are written as numbers.
pub(crate) fn with_numbers(input: &Input, numbers: &[(ParameterId, String)]) -> Result<String, Failure> {
    let (netlist, place) = (&input.netlist, Path::new(&input.text.name));
    // what was set on the command line is not in the file
    let original = parse_file(place, &input.text.bytes)?;
    let mut parameters = original.network.overrides();
    let mut written = Vec::with_capacity(numbers.len());
    for (id, number) in numbers {
        let name = &netlist.network.parameters()[id.index()].name;
        let (Some(place), Ok(value)) = (netlist.written_number(*id), number.parse()) else { continue };
        if let Ok(id) = original.network.parameter(name) {
            parameters.set(id, place.unit.to_si(value));
        }
        written.push((place, number.clone()));
    }
    let text = netlist.text_with_numbers(&written);
    let network = original.network.with(&parameters).map_err(|errors| mistake(&rejected(&errors)))?;
    proven(text, place, &network, original.run.as_ref())
}

fn rejected(errors: &BuildErrors) -> WrittenError {
    WrittenError::Rejected { reason: errors.0.first().map(ToString::to_string).unwrap_or_default() }
}

fn mistake(error: &WrittenError) -> Failure {
    let problem = Diagnostic::error("output::written_netlist", error.to_string());
    let help = "nothing was written; this is a mistake of lptn: please report it with the netlist";
    Failure::new(Exit::Failed, problem.help(help))
}
