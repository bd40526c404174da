//! The candidates of a comparison: every file with every variant of it, as it is read.

use std::path::{Path, PathBuf};

use lptn_netlist::Diagnostic;
use lptn_units::Unit;

use super::CompareQuestion;
use super::variants::{self, Variant, of_sets};
use crate::belief::Belief;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::overridden;

/// Every file with every variant of it.
pub(super) fn jobs(
    args: &CompareQuestion,
    listener: &dyn Listener,
) -> Result<Vec<(PathBuf, Variant)>, Failure> {
    let sets = of_sets(&args.set).ok_or_else(|| too_many("--set"))?;
    let mut jobs = Vec::new();
    for file in &args.files {
        let all = variants::with_parts(file, (&args.parts, &args.csv), (&sets, listener))?;
        let all = all.ok_or_else(|| too_many("--parts"))?;
        let all = if args.cases { variants::in_cases(file, &all) } else { all };
        jobs.extend(all.into_iter().map(|variant| (file.clone(), variant)));
    }
    Ok(jobs)
}

/// More variants than a comparison takes.
pub fn too_many(option: &str) -> Failure {
    let message = format!("`{option}` makes more than {} variants", variants::MOST);
    Failure::refused("compare::too_many", message, "give fewer values, or compare in several steps")
}

/// A candidate's file, and its netlist or the problems in it.
#[derive(Debug)]
pub struct Loaded {
    /// The file and the label of the variant.
    pub file: String,
    /// The label of the variant.
    pub label: String,
    /// The netlist with its assignments.
    pub input: Result<Input, Failure>,
    /// For each `--set`, true if this candidate has the parameter.
    has: Vec<bool>,
}

/// Reads a file with a variant of it.
pub fn load(file: &Path, variant: &Variant, belief: &Belief<'_>) -> Loaded {
    let set = &variant.set;
    let name = match variant.label.as_str() {
        "" => file.display().to_string(),
        label => format!("{} ({label})", file.display()),
    };
    let mut input = match Input::open(file, belief, (variant.case.as_deref(), &[])) {
        Ok(input) => input,
        Err(failure) => {
            let (label, has) = (variant.label.clone(), vec![false; set.len()]);
            return Loaded { file: name, label, input: Err(failure), has };
        }
    };
    let network = &input.netlist.network;
    // a text without `=` is for `set` to refuse
    let has_it = |text: &String| {
        text.split_once('=').is_none_or(|(left, _)| network.parameter(left.trim()).is_ok())
    };
    let has: Vec<bool> = set.iter().map(has_it).collect();
    let own: Vec<String> =
        set.iter().zip(&has).filter(|(_, has)| **has).map(|(text, _)| text.clone()).collect();
    let outcome = overridden::replace(&mut input.netlist, &input.set, &own);
    let input = outcome.map(|()| input).map_err(Failure::from);
    Loaded { file: name, label: variant.label.clone(), input, has }
}

/// Refuses a `--set` that no candidate can use.
/// It is accepted if it may be meant for a candidate that could not be read.
///
/// # Errors
/// An assignment that fits no candidate.
pub fn used(set: &[String], loaded: &[Loaded]) -> Result<(), Failure> {
    let all_read = loaded.iter().all(|one| one.input.is_ok());
    let idle = (0..set.len()).find(|&i| loaded.iter().all(|one| !one.has[i]));
    let (Some(i), true) = (idle, all_read) else { return Ok(()) };
    let name = set[i].split('=').next().unwrap_or_default().trim();
    let message = format!("no candidate has a parameter `{name}`");
    let mut names: Vec<&str> = loaded
        .iter()
        .filter_map(|one| one.input.as_ref().ok())
        .flat_map(|input| input.netlist.network.parameters())
        .map(|parameter| parameter.name.as_str())
        .collect();
    names.sort_unstable();
    let problem = Diagnostic::error("netlist::unknown_parameter", message);
    let near = lptn_units::suggest(name, names.into_iter());
    let problem = problem.help(near.map(|near| format!("did you mean `{near}`?")));
    Err(Failure::new(Exit::Input, problem))
}

/// Refuses a posterior that no candidate can use.
/// It is accepted if it may be meant for a candidate that could not be read.
pub(super) fn believed(args: &CompareQuestion, loaded: &[Loaded]) -> Result<(), Failure> {
    let Some(file) = &args.posterior else { return Ok(()) };
    let idle = |one: &Loaded| one.input.as_ref().is_ok_and(|i| i.netlist.posterior().is_none());
    if !loaded.iter().all(idle) {
        return Ok(());
    }
    let message = format!("no candidate has a parameter of {}", file.display());
    let help = "use the `posterior.json` of a fit that varies parameters of these netlists";
    Err(Failure::refused("posterior::nothing", message, help))
}

/// The unit for temperatures: that of the command line, or of the first candidate that was read.
pub(super) fn unit(args: &CompareQuestion, loaded: &[Loaded]) -> Result<Unit, Failure> {
    let first = loaded.iter().find_map(|one| one.input.as_ref().ok());
    match (first, args.temperature_unit.as_deref()) {
        (Some(input), text) => input::temperature_unit(text, &input.netlist),
        (None, text) => {
            let text = text.unwrap_or("degC");
            Unit::parse(text).map_err(|error| input::wrong_unit("--temperature-unit", text, &error))
        }
    }
}
