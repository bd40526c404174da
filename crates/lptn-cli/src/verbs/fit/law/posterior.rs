//! `lptn fit law --posterior FILE`: the coefficients of a law, for studies.

use std::path::Path;

use lptn_fit::law::{LawFit, LawStudy, LossLaw};
use lptn_netlist::Diagnostic;

use super::args::LawArgs;
use crate::console::Console;
use crate::files;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

/// Refuses before anything is computed what could not be written afterwards.
pub(crate) fn possible(args: &LawArgs, points: &Path) -> Result<(), Failure> {
    if args.posterior.is_none() {
        return Ok(());
    }
    if points.is_dir() {
        let message = "the powers of a folder of records share the error of one capacity, which no \
            coefficient knows of: there is no posterior of a law";
        let help = "fit the network to the records, `lptn fit network`: its posterior knows of all";
        return Err(refused(message, help));
    }
    match args.law.as_slice() {
        [_] => Ok(()),
        _ => Err(refused(
            "--posterior writes the coefficients of one law",
            "write one, --law 'alpha * omega^(5/3)', with the names that the parameters have in the \
             netlist",
        )),
    }
}

/// Writes the file where one is asked for; the law of the command line is the only one that is
/// written out.
pub(crate) fn write(
    args: &LawArgs,
    (points, study): (&Path, &LawStudy),
    console: &Console,
) -> Result<(), Failure> {
    let Some(file) = &args.posterior else { return Ok(()) };
    let own = |law: &&LawFit| matches!(law.law, LossLaw::Written(_));
    let Some(law) = study.candidates.iter().find(own) else { return Ok(()) };
    let stem = points.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let posterior = law.posterior(&stem.unwrap_or_default(), &law.law.to_string());
    let Some(posterior) = posterior else {
        let why = "no posterior is written: nothing tells the errors of the coefficients";
        // what stands there would be taken for that of this law
        match files::take_away(file)? {
            true => console.message(&format!("{why}; {} is taken away", file.display())),
            false => console.message(why),
        }
        return Ok(());
    };
    crate::verbs::fit::posterior::write(&posterior, file, console)
}

fn refused(message: &str, help: &str) -> Failure {
    Failure::new(Exit::Input, Diagnostic::error("fit::law_posterior", message).help(help))
}
