//! `lptn plan`

mod args;
mod figure;
mod given;
mod page;
mod shown;
mod words;

pub(crate) use args::PlanArgs;

use std::sync::{Mutex, PoisonError};

use lptn_fit::network::NetworkFitError;
use lptn_fit::network::design::{Design, DesignError, DesignTask, design};
use lptn_netlist::{Diagnostic, PlanStudy, Span};
use lptn_solve::{Proceed, Progress, available_threads};
use lptn_units::Unit;

use crate::console::Console;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressLine;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, Studies};
use lptn_answer::taken;
use lptn_answer::unseparated::{Named, names_and_units};

pub(crate) fn plan(args: &PlanArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&Source { set: args.set.clone(), ..Source::of(args.file.clone()) })?;
    let plans = &input.netlist.studies.plans;
    let study = STUDIES.find(&input, (plans, |study| &study.name), args.name.as_deref())?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let (task, design) =
        planned(&input, study, console).map_err(|error| failed(&input, study, &error))?;
    let (names, units) = names_and_units(&input, &task.unknowns, &task.record_names());
    let answer = Answer { input: &input, study, task, design, names, units };
    let named = answer.named();
    let doubt = taken::of_plan((&input, study), (&answer.task, &answer.design), &named);
    let doubts: Vec<Diagnostic> =
        given::doubts(&input, &answer.task).into_iter().chain(doubt).collect();
    console.warn(&input.netlist.files, &doubts);
    console.show(&answer, args.printed.format)
}

const STUDIES: Studies = Studies {
    section: "plan",
    codes: ["plan::no_study", "plan::which_study"],
    question: "what is to be measured?",
    example: "[plan.next]\nknow = { R_int = \"5 %\" }\n\
              place = { ring = { of = \"steel.T\", noise = \"0.1 K\" } }\n\
              every = \"1 s\"\nduration = \"30 min\"",
};

/// The plan, with its progress, until Ctrl-C.
fn planned<'a>(
    input: &'a Input,
    study: &PlanStudy,
    console: &Console,
) -> Result<(DesignTask<'a>, Design), DesignError> {
    let interrupt = Interrupt::listen();
    let line = Mutex::new(ProgressLine::new(console.quiet));
    let watch = |which: &dyn Fn() -> String, step: Progress| -> Proceed {
        // no run waits for the line: the next step says more
        if let Ok(mut line) = line.try_lock() {
            line.update_of(&which(), step);
        }
        interrupt.control()
    };
    let outcome = console.phases.timed("plan", || {
        let task = DesignTask::of(
            &input.netlist,
            study,
            (available_threads(), &|stage, step| watch(&|| stage.to_string(), step)),
        )?;
        let count = task.runs.len();
        let found =
            design(&task, &|run, step| watch(&|| format!("run {} of {count}", run + 1), step))?;
        Ok((task, found))
    });
    line.lock().unwrap_or_else(PoisonError::into_inner).clear();
    outcome
}

fn failed(input: &Input, study: &PlanStudy, error: &DesignError) -> Failure {
    let span: Option<&Span> = match error {
        DesignError::Place(NetworkFitError::Observed { column, .. }) => {
            let place = study.places.iter().find(|place| place.observed.column == *column);
            place.map(|place| &place.observed.span)
        }
        DesignError::Run { run, .. } => {
            let own = |name: &str| run == name || run.starts_with(&format!("{name} ("));
            study.runs.iter().find(|run| own(&run.name)).map(|run| &run.span)
        }
        _ => None,
    };
    input.failure(error, Some(span.unwrap_or(&study.span).clone()))
}

/// What is best measured, and of what.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a PlanStudy,
    pub(crate) task: DesignTask<'a>,
    pub(crate) design: Design,
    /// What each unknown is called, and in which unit it is shown.
    pub(crate) names: Vec<String>,
    pub(crate) units: Vec<Unit>,
}

impl Answer<'_> {
    /// What is sought, by its names.
    fn named(&self) -> Named<'_> {
        let (unknowns, values) = (&self.task.unknowns, self.task.values.clone());
        Named { unknowns, names: &self.names, units: &self.units, values }
    }
}
