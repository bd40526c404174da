//! Time histories of heats, flows and heat transfer coefficients, from a record.

mod doubts;
mod figure;
mod follow;
mod json;
mod lacking;
mod page;
mod report;

use std::sync::Arc;

use lptn_fit::infer::{Estimated, InferError, InferTask, Inferred, infer as inferred};
use lptn_netlist::{Diagnostic, Files, InferStudy};
use lptn_units::{Type, Unit};

use crate::answer::Answer;
use crate::example;
use crate::failure::Failure;
use crate::fit::network::record_place;
use crate::input::Input;
use crate::listener::Listener;
use crate::studies::Studies;

pub use follow::{FollowedRows, Following};

/// Asks for the time histories of signals while a record was measured.
#[derive(Clone, Debug, Default)]
pub struct InferQuestion {
    /// Name of the `[infer.NAME]`; `None` for the only one.
    pub study: Option<String>,
}

/// An inference that can be computed.
#[derive(Debug)]
pub struct InferenceOfRecord {
    input: Arc<Input>,
    study: InferStudy,
    task: InferTask,
}

/// Time histories with their bands, and the temperatures that go with them.
#[derive(Debug)]
pub struct InferAnswer {
    input: Arc<Input>,
    study: InferStudy,
    /// The signals that were inferred, and the record.
    pub task: InferTask,
    /// The time histories, in SI units.
    pub found: Inferred,
    /// The unit in which each signal is shown.
    pub units: Vec<Unit>,
    doubts: Vec<Diagnostic>,
}

impl Answer for InferAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts].concat()
    }
}

impl InferQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A study that does not exist or cannot be computed, and an inference that was interrupted.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<InferAnswer, Failure> {
        self.begin(input, listener)?.compute(listener)
    }

    /// Reads the study in advance.
    ///
    /// # Errors
    /// A study that does not exist, and one that does not fit its network.
    pub fn begin(
        &self,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<InferenceOfRecord, Failure> {
        let study = self.study(&input)?;
        listener.warn(&input.netlist.files, &input.netlist.warnings);
        let task = task(&input, &study)?;
        Ok(InferenceOfRecord { input, study, task })
    }

    /// Begins to follow a record whose rows come one by one.
    ///
    /// # Errors
    /// A study that does not exist or does not fit its network.
    /// One that does not give the change of a signal or the scatter of a column.
    pub fn follow(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<Following, Failure> {
        let study = self.study(&input)?;
        let own = input.netlist.warnings.iter().filter(|warning| follow::counts(&study, warning));
        listener.warn(&input.netlist.files, &own.cloned().collect::<Vec<_>>());
        Following::new(input, study)
    }

    fn study(&self, input: &Input) -> Result<InferStudy, Failure> {
        let infers = &input.netlist.studies.infers;
        STUDIES.find(input, (infers, |study| &study.name), self.study.as_deref()).cloned()
    }
}

impl InferenceOfRecord {
    /// Computes it.
    ///
    /// # Errors
    /// A run that fails, a signal without effect on the record, and an interruption.
    pub fn compute(self, listener: &dyn Listener) -> Result<InferAnswer, Failure> {
        let Self { input, study, task } = self;
        let found = inferred(&task, &|step| listener.progress(step))
            .map_err(|error| failed(&input, &study, &error))?;
        let units = task.estimated.iter().map(|estimated| unit_of(&input, estimated)).collect();
        let mut answer = InferAnswer { input, study, task, found, units, doubts: Vec::new() };
        answer.doubts = doubts::of(&answer);
        listener.warn(answer.files(), &answer.doubts);
        Ok(answer)
    }
}

fn task(input: &Input, study: &InferStudy) -> Result<InferTask, Failure> {
    InferTask::of(&input.netlist, study).map_err(|error| failed(input, study, &error))
}

const STUDIES: Studies = Studies {
    section: "infer",
    codes: ["infer::no_study", "infer::which_study"],
    question: "an inference needs a record and the signals to estimate",
    example: example::infer,
};

fn failed(input: &Input, study: &InferStudy, error: &InferError) -> Failure {
    let of = |name: &str| study.estimated.iter().find(|estimated| estimated.name == name);
    let span = match error {
        InferError::Record(inner) => record_place(&study.reads, inner),
        InferError::NotPositive { signal, .. } | InferError::Unfelt { signal } => {
            of(signal).map(|estimated| &estimated.span)
        }
        InferError::Lag { sensor } => {
            let sensors = &input.netlist.studies.sensors;
            sensors.iter().find(|own| own.name == *sensor).map(|own| &own.span)
        }
        _ => None,
    };
    input.failure(error, Some(span.unwrap_or(&study.span).clone()))
}

/// The unit of a signal: that of temperatures if it is one, else its own.
fn unit_of(input: &Input, estimated: &Estimated) -> Unit {
    let signals = input.netlist.network.signals();
    let Some(signal) = signals.iter().find(|signal| signal.name == estimated.name) else {
        return input.netlist.temperature_unit.clone();
    };
    if signal.ty == Type::ABSOLUTE_TEMPERATURE {
        return input.netlist.temperature_unit.clone();
    }
    let usual = || Unit::parse(&signal.ty.usual_unit()).ok();
    let si =
        || Unit { text: signal.ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty: signal.ty };
    signal.unit.clone().or_else(usual).unwrap_or_else(si)
}

impl InferAnswer {
    /// The netlist that was asked.
    pub fn input(&self) -> &Arc<Input> {
        &self.input
    }

    /// A value of a signal in the unit in which it is shown.
    fn shown(&self, course: usize, si: f64) -> f64 {
        self.units[course].from_si(si)
    }

    /// A difference of two values of a signal in its unit.
    fn shown_difference(&self, course: usize, si: f64) -> f64 {
        si / self.units[course].scale
    }
}
