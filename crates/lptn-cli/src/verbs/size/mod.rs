//! `lptn size`

mod args;
mod changing;
mod choice;
mod cooling;
mod figure;
mod kept;
mod moments;
mod page;
mod several;
mod write;

pub(crate) use args::SizeArgs;

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use kept::Kept;
use lptn_netlist::{Diagnostic, Requirement, SizeStudy};
use lptn_network::ParameterId;
use lptn_report::{Format, Page};
use lptn_study::{Aim, Demand, SizeError, SizeTask, Sizing, Verdict};
use lptn_units::{Problem as _, Unit};
use moments::demanded;

use crate::console::Console;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressLine;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::{Input, Studies, quoted};

pub(crate) fn size(args: &SizeArgs, console: &Console) -> Result<Exit, Failure> {
    let Some(file) = &args.file else { return cooling::cooling(args, console) };
    let source = Source { set: args.set.clone(), ..Source::of(file.clone()) };
    let input = Input::load_from(&source, &Belief::of(args.posterior.as_deref()))?;
    let sizes = &input.netlist.studies.sizes;
    let study = STUDIES.find(&input, (sizes, |study| &study.name), args.name.as_deref())?;
    if args.write {
        for name in changed(study) {
            write::possible(&input, parameter(&input, study, name)?)?;
        }
    }
    console.warn(&input.netlist.files, &input.netlist.warnings);
    moments::check_period(&input, study)?;
    let kept = Kept::of(&input.netlist, study);
    let asked = Asked { input: &input, study, kept, args, file, console };
    match study.single() {
        Some(range) => single(&asked, &range.name),
        None if study.catalogues.is_empty() => several::several(&asked),
        None => choice::choice(&asked),
    }
}

/// What is asked, and how it is to be answered.
pub(crate) struct Asked<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a SizeStudy,
    pub(crate) kept: Kept<'a>,
    pub(crate) args: &'a SizeArgs,
    pub(crate) file: &'a Path,
    pub(crate) console: &'a Console,
}

impl Asked<'_> {
    /// Answers a question about what has to be kept. It may take a while: a terminal shows how far it
    /// is, and Ctrl-C ends it.
    fn demand<T>(
        &self,
        ask: impl FnOnce(Demand<'_>) -> Result<T, SizeError>,
    ) -> Result<T, SizeError> {
        let interrupt = Interrupt::listen();
        let line = Mutex::new(ProgressLine::new(self.console.quiet));
        let watcher = |progress| {
            // another thread says as much
            if let Ok(mut line) = line.try_lock() {
                line.update(progress);
            }
            interrupt.control()
        };
        let demanded = || demanded((&self.input.netlist, self.study), &watcher, ask);
        let answer = self.console.phases.timed("size", demanded);
        line.lock().unwrap_or_else(PoisonError::into_inner).clear();
        answer
    }

    /// Shows the answer and writes it, if that is asked for; `write` writes it.
    fn show(
        &self,
        page: &dyn Page,
        write: impl FnOnce() -> Result<(), Failure>,
    ) -> Result<Exit, Failure> {
        let exit = self.console.show(page, self.args.printed.format)?;
        let file = quoted(&self.file.display().to_string());
        if self.args.write && exit == Exit::Done {
            write()?;
            self.console.next(&format!("lptn run {file}"));
        } else if exit == Exit::Done && self.args.printed.format == Format::Table {
            let several = self.input.netlist.studies.sizes.len() > 1;
            let name = if several { format!(" {}", self.study.name) } else { String::new() };
            self.console.next(&format!("lptn size {file}{name} --write"));
        }
        Ok(exit)
    }
}

fn single(asked: &Asked<'_>, name: &str) -> Result<Exit, Failure> {
    let &Asked { input, study, .. } = asked;
    let parameter = parameter(input, study, name)?;
    let unit = input.unit_of(parameter);
    let range =
        study.ranges(&input.netlist.network).ok().and_then(|ranges| Some(ranges.first()?.1));
    let range = range.unwrap_or((f64::NAN, f64::NAN));
    let goal = study.goal;
    let sizing =
        asked.demand(|demand| lptn_study::size(&SizeTask { demand, parameter, range, goal }));
    let sizing = sizing.map_err(|error| failed(input, study, &error))?;
    let kept = &asked.kept;
    let answer = Answer { input, study, kept, name, parameter, unit, range, sizing };
    asked.show(&answer, || write::write(&answer, asked.file, asked.console))
}

const STUDIES: Studies = Studies {
    section: "size",
    codes: ["size::no_study", "size::which_study"],
    question: "what is to be sized?",
    example: "[size.fan]\nminimise = \"p\"\nvary = { p = { from = \"1 W/K\", to = \"10 W/K\" } }\n\
              require = [\"steel.T <= 80 [degC]\"]",
};

fn parameter(input: &Input, study: &SizeStudy, name: &str) -> Result<ParameterId, Failure> {
    input.netlist.network.parameter(name).map_err(|_| {
        let message = format!("there is no parameter `{name}`");
        let problem = Diagnostic::error("netlist::unknown_parameter", message);
        input.refused(Exit::Input, problem.at(study.span.clone(), ""))
    })
}

/// What a study seeks.
fn aim(study: &SizeStudy) -> Aim<'_> {
    let objective = &study.objective;
    Aim { value: &objective.value, goal: study.goal, of_results: objective.of_results }
}

/// The parameters that a study changes, in the order in which designs have them.
fn changed(study: &SizeStudy) -> impl Iterator<Item = &String> {
    let set = study.catalogues.iter().flat_map(|one| &one.columns).map(|one| &one.name);
    study.varied.iter().map(|one| &one.name).chain(set)
}

fn failed(input: &Input, study: &SizeStudy, error: &SizeError) -> Failure {
    let problem = match error {
        SizeError::Changing(changing) => changing::explained(input, study, (error, changing)),
        _ => told(error).at(study.span.clone(), ""),
    };
    // the library does not know the units
    let message = match error {
        SizeError::Trial { values, case, error } => {
            let at = |(name, value): (&String, &f64)| {
                let id = input.netlist.network.parameter(name).ok()?;
                Some(page::quantity(name, *value, &input.unit_of(id)))
            };
            let with: Vec<String> = changed(study).zip(values).filter_map(at).collect();
            let case = if case.is_empty() { String::new() } else { format!(", case `{case}`") };
            format!("with {}{case}: {error}", with.join(", "))
        }
        _ => problem.message,
    };
    input.refused(error.class().into(), Diagnostic { message, ..problem })
}

/// What came of sizing a parameter.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a SizeStudy,
    pub(crate) kept: &'a Kept<'a>,
    /// The name of the parameter.
    pub(crate) name: &'a str,
    pub(crate) parameter: ParameterId,
    /// In SI units.
    pub(crate) range: (f64, f64),
    /// In which the parameter is shown.
    pub(crate) unit: Unit,
    pub(crate) sizing: Sizing,
}

impl Answer<'_> {
    /// The requirement that stops the parameter; `None` if the end of the range or an edge does.
    pub(crate) fn binding(&self) -> Option<&Requirement> {
        let closest = self.kept.requirement(self.sizing.closest);
        (!matches!(self.sizing.verdict, Verdict::BestEnd | Verdict::Edge)).then_some(closest)
    }

    fn closest_unit(&self) -> String {
        self.kept.unit(self.sizing.closest)
    }
}
