//! `lptn infer`

mod args;
mod doubts;
mod figure;
mod follow;
mod json;
mod output;
mod page;

pub(crate) use args::InferArgs;

use std::cell::RefCell;
use std::time::Instant;

use lptn_fit::infer::{InferError, InferTask, Inferred, Sought, infer as inferred};
use lptn_netlist::{Diagnostic, InferStudy};
use lptn_units::{Type, Unit};

use crate::console::Console;
use crate::files::Folder;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressLine;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::network::record_place;
use lptn_answer::input::{Input, Studies};

/// What was inferred, and from what.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a InferStudy,
    pub(crate) task: InferTask,
    pub(crate) found: Inferred,
    /// In which unit each course is shown.
    pub(crate) units: Vec<Unit>,
    pub(crate) doubts: Vec<Diagnostic>,
}

pub(crate) fn infer(args: &InferArgs, console: &Console) -> Result<Exit, Failure> {
    if args.follow {
        follow::possible(args, console)?;
    }
    let input = Input::load(&Source { set: args.set.clone(), ..Source::of(args.file.clone()) })?;
    let infers = &input.netlist.studies.infers;
    let study = STUDIES.find(&input, (infers, |study| &study.name), args.name.as_deref())?;
    if args.follow {
        let own = input.netlist.warnings.iter().filter(|warning| follow::counts(study, warning));
        console.warn(&input.netlist.files, &own.cloned().collect::<Vec<_>>());
        return follow::follow((&input, study), console);
    }
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let task =
        InferTask::of(&input.netlist, study).map_err(|error| failed(&input, study, &error))?;
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let found = observed(&task, console).map_err(|error| failed(&input, study, &error))?;
    let units = task.sought.iter().map(|sought| unit_of(&input, sought)).collect();
    let mut answer = Answer { input: &input, study, task, found, units, doubts: Vec::new() };
    answer.doubts = doubts::of(&answer);
    console.warn(&input.netlist.files, &answer.doubts);
    if let Some(folder) = &folder {
        output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.show(&answer, args.printed.format)?;
    if let Some(folder) = &folder {
        let [first, others @ ..] = output::NAMES;
        let path = folder.path().join(first);
        console.note(&format!("wrote  {}, {}", path.display(), others.join(", ")));
    }
    Ok(exit)
}

/// With its progress, until Ctrl-C.
fn observed(task: &InferTask, console: &Console) -> Result<Inferred, InferError> {
    let interrupt = Interrupt::listen();
    let line = RefCell::new(ProgressLine::new(console.quiet));
    let outcome = inferred(task, &|step| {
        line.borrow_mut().update(step);
        interrupt.control()
    });
    line.into_inner().clear();
    outcome
}

const STUDIES: Studies = Studies {
    section: "infer",
    codes: ["infer::no_study", "infer::which_study"],
    question: "which course is sought, in which record?",
    example: "[infer.power]\ndata = \"record.csv\"\ncolumn = { ring_gear = \"steel.T\" }\n\
              sigma = \"0.1 K\"\nfind = [\"P\"]",
};

fn failed(input: &Input, study: &InferStudy, error: &InferError) -> Failure {
    let of = |name: &str| study.sought.iter().find(|sought| sought.name == name);
    let span = match error {
        InferError::Record(inner) => record_place(&study.reads, inner),
        InferError::NotPositive { signal, .. } | InferError::Unfelt { signal } => {
            of(signal).map(|sought| &sought.span)
        }
        InferError::Lag { sensor } => {
            let sensors = &input.netlist.studies.sensors;
            sensors.iter().find(|own| own.name == *sensor).map(|own| &own.span)
        }
        _ => None,
    };
    input.failure(error, Some(span.unwrap_or(&study.span).clone()))
}

/// The unit of a signal: that of temperatures where it is one, else its own.
fn unit_of(input: &Input, sought: &Sought) -> Unit {
    let signals = input.netlist.network.signals();
    let Some(signal) = signals.iter().find(|signal| signal.name == sought.name) else {
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

impl Answer<'_> {
    /// A value of a course in the unit in which it is shown.
    fn shown(&self, course: usize, si: f64) -> f64 {
        self.units[course].from_si(si)
    }

    /// A difference of two.
    fn shown_difference(&self, course: usize, si: f64) -> f64 {
        si / self.units[course].scale
    }
}
