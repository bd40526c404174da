//! `lptn size`

mod args;
mod changing;
mod cooling;
mod figure;
mod moments;
mod page;
mod write;

pub(crate) use args::SizeArgs;

use std::sync::{Mutex, PoisonError};

use lptn_netlist::{Diagnostic, Requirement, SizeStudy};
use lptn_network::ParameterId;
use lptn_report::Format;
use lptn_study::{SizeError, SizeTask, Sizing, Verdict};
use lptn_units::{Problem as _, Unit};
use moments::demanded;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{Input, Studies, quoted};
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressLine;

pub(crate) fn size(args: &SizeArgs, console: &Console) -> Result<Exit, Failure> {
    let Some(file) = &args.file else { return cooling::cooling(args, console) };
    let input = Input::load(&Source { file: file.clone(), set: args.set.clone() })?;
    let sizes = &input.netlist.studies.sizes;
    let study = STUDIES.find(&input, (sizes, |study| &study.name), args.name.as_deref())?;
    let parameter = parameter(&input, study)?;
    let unit = input.unit_of(parameter);
    if args.write {
        write::possible(&input, parameter)?;
    }
    console.warn(&input.netlist.files, &input.netlist.warnings);
    moments::check_period(&input, study)?;
    let sizing = console.phases.timed("size", || solve(&input, study, parameter, console));
    let sizing = sizing.map_err(|error| failed(&input, study, &unit, &error))?;
    let answer = Answer { input: &input, study, parameter, unit, sizing };
    let exit = console.show(&answer, args.printed.format)?;
    if args.write && exit == Exit::Done {
        write::write(&answer, file, console)?;
        console.next(&format!("lptn run {}", quoted(&file.display().to_string())));
    } else if exit == Exit::Done && args.printed.format == Format::Table {
        let file = quoted(&file.display().to_string());
        console.next(&format!("lptn size {file} --write"));
    }
    Ok(exit)
}

const STUDIES: Studies = Studies {
    section: "size",
    codes: ["size::no_study", "size::which_study"],
    question: "what is to be sized?",
    example: "[size.fan]\nminimise = \"p\"\nvary = { p = { from = \"1 W/K\", to = \"10 W/K\" } }\n\
              require = [\"steel.T <= 80 [degC]\"]",
};

fn parameter(input: &Input, study: &SizeStudy) -> Result<ParameterId, Failure> {
    input.netlist.network.parameter(&study.parameter).map_err(|_| {
        let message = format!("there is no parameter `{}`", study.parameter);
        let problem = Diagnostic::error("netlist::unknown_parameter", message);
        input.refused(Exit::Input, problem.at(study.span.clone(), ""))
    })
}

/// It may take a while: a terminal shows how far it is, and Ctrl-C ends it.
fn solve(
    input: &Input,
    study: &SizeStudy,
    parameter: ParameterId,
    console: &Console,
) -> Result<Sizing, SizeError> {
    let range = study.range(&input.netlist.network).unwrap_or((f64::NAN, f64::NAN));
    let interrupt = Interrupt::listen();
    let line = Mutex::new(ProgressLine::new(console.quiet));
    let locked = || line.lock().unwrap_or_else(PoisonError::into_inner);
    let watcher = |progress| {
        locked().update(progress);
        interrupt.control()
    };
    let sizing = demanded((&input.netlist, study), &watcher, |demand| {
        lptn_study::size(&SizeTask { demand, parameter, range, goal: study.goal })
    });
    locked().clear();
    sizing
}

fn failed(input: &Input, study: &SizeStudy, unit: &Unit, error: &SizeError) -> Failure {
    let problem = match error {
        SizeError::Changing(changing) => changing::explained(input, study, (error, changing)),
        _ => told(error).at(study.span.clone(), ""),
    };
    // the library does not know the unit
    let message = match error {
        SizeError::Trial { values, error, .. } => {
            let at = |value: &f64| page::quantity(&study.parameter, *value, unit);
            let with: Vec<String> = values.iter().map(at).collect();
            format!("with {}: {error}", with.join(", "))
        }
        _ => problem.message,
    };
    input.refused(error.class().into(), Diagnostic { message, ..problem })
}

/// What came of sizing a parameter.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a SizeStudy,
    pub(crate) parameter: ParameterId,
    /// In which the parameter is shown.
    pub(crate) unit: Unit,
    pub(crate) sizing: Sizing,
}

impl Answer<'_> {
    /// The requirement that stops the parameter; `None` where the end of the range does.
    pub(crate) fn binding(&self) -> Option<&Requirement> {
        let closest = &self.study.requirements[self.sizing.closest];
        (self.sizing.verdict != Verdict::BestEnd).then_some(closest)
    }

    fn closest_unit(&self) -> String {
        self.study.requirements[self.sizing.closest].ty.dimension.si_unit()
    }
}
