//! Measurements that determine parameters of a network to a given error.

mod figure;
mod given;
mod page;
mod shown;
mod words;

use std::sync::Arc;

use lptn_fit::network::NetworkFitError;
use lptn_fit::network::design::{Design, DesignError, DesignTask, design};
use lptn_netlist::{Diagnostic, Files, PlanStudy, Span};
use lptn_solve::available_threads;
use lptn_units::Unit;

use crate::answer::Answer;
use crate::example;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::studies::Studies;
use crate::taken;
use crate::unseparated::{Named, names_and_units};

/// Asks for the sensors, the runs and their duration.
#[derive(Clone, Debug, Default)]
pub struct PlanQuestion {
    /// Name of the `[plan.NAME]`; `None` for the only one.
    pub study: Option<String>,
}

/// A measurement to come, and the errors that it leaves.
#[derive(Debug)]
pub struct PlanAnswer {
    input: Arc<Input>,
    study: PlanStudy,
    /// The possible sensors and runs, and the parameters that must be known.
    pub task: DesignTask,
    /// The measurement, with standard errors in SI units.
    pub design: Design,
    /// The name of each unknown.
    pub names: Vec<String>,
    /// The unit in which each unknown is shown.
    pub units: Vec<Unit>,
    doubts: Vec<Diagnostic>,
}

impl Answer for PlanAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts].concat()
    }
}

const STUDIES: Studies = Studies {
    section: "plan",
    codes: ["plan::no_study", "plan::which_study"],
    question: "a plan needs parameters to determine, and places for sensors",
    example: example::plan,
};

impl PlanQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A study that does not exist or cannot be computed, and a plan that was interrupted.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<PlanAnswer, Failure> {
        let plans = &input.netlist.studies.plans;
        let study = STUDIES.find(&input, (plans, |study| &study.name), self.study.as_deref())?;
        let study = study.clone();
        listener.warn(&input.netlist.files, &input.netlist.warnings);
        let (task, design) =
            planned(&input, &study, listener).map_err(|error| failed(&input, &study, &error))?;
        let (names, units) = names_and_units(&input, &task.unknowns, &task.record_names());
        let mut answer =
            PlanAnswer { input, study, task, design, names, units, doubts: Vec::new() };
        answer.doubts = answer.found_doubts();
        listener.warn(answer.files(), &answer.doubts);
        Ok(answer)
    }
}

fn planned(
    input: &Input,
    study: &PlanStudy,
    listener: &dyn Listener,
) -> Result<(DesignTask, Design), DesignError> {
    let given = |stage, step| listener.stage(&stage, step);
    let task = DesignTask::of(&input.netlist, study, (available_threads(), &given))?;
    let count = task.runs.len();
    let design = design(&task, &|run, step| {
        listener.stage(&format_args!("run {} of {count}", run + 1), step)
    })?;
    Ok((task, design))
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

impl PlanAnswer {
    /// The estimated quantities by their names.
    fn named(&self) -> Named<'_> {
        let (unknowns, values) = (&self.task.unknowns, self.task.values.clone());
        Named { unknowns, names: &self.names, units: &self.units, values }
    }

    /// Doubts in the fits whose records exist, and in parameters that are taken as exact.
    fn found_doubts(&self) -> Vec<Diagnostic> {
        let (of, found) = ((&*self.input, &self.study), (&self.task, &self.design));
        let exact = taken::of_plan(of, found, &self.named());
        given::doubts(&self.input, &self.task).into_iter().chain(exact).collect()
    }
}
