//! `lptn fit network`

mod args;
mod figure;
mod interrupted;
mod output;
mod page;
mod shared_noise;
mod units;
mod words;
mod write;

pub(crate) use args::NetworkArgs;
pub(crate) use page::{parameter, values};
pub(crate) use units::common;
pub(crate) use words::{doubts, verdict};

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use lptn_fit::network::{
    NetworkFit, NetworkFitError, NetworkFitTask, Unknown, fit_network_observed,
};
use lptn_netlist::{Diagnostic, FitStudy, Span};
use lptn_report::differing;
use lptn_solve::available_threads;
use lptn_units::Unit;

use crate::console::Console;
use crate::files::Folder;
use crate::files::names::POSTERIOR;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::options::Source;
use crate::progress::ProgressLine;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, Studies, quoted};
use lptn_answer::unseparated::{Named, names_and_units};

/// What came of a fit, and of what.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a FitStudy,
    pub(crate) task: NetworkFitTask<'a>,
    /// What was sought: parameters, then values of sensors.
    pub(crate) unknowns: Vec<Unknown>,
    /// What each is called and in which unit it is shown.
    pub(crate) names: Vec<String>,
    pub(crate) units: Vec<Unit>,
    pub(crate) fit: NetworkFit,
    /// Where a parameter sits on a bound, and what else is doubtful.
    pub(crate) doubts: Vec<Diagnostic>,
}

pub(crate) fn network(args: &NetworkArgs, console: &Console) -> Result<Exit, Failure> {
    let source = Source { set: args.set.clone(), ..Source::of(args.file.clone()) };
    // a fit begins with what the netlist itself says: what another one found counts the same
    // records, perhaps
    let input = Input::load_from(&source, &Belief::None)?;
    let fits = &input.netlist.studies.fits;
    let study = STUDIES.find(&input, (fits, |study| &study.name), args.name.as_deref())?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let mut task = NetworkFitTask::of(&input.netlist, study, available_threads())
        .map_err(|error| failed(&input, study, &error))?;
    task.more_starts = args.starts.map_or(task.more_starts, usize::from);
    if args.write {
        write::possible(&input, &task)?;
    }
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let fit = match observed(&task, console) {
        Err(NetworkFitError::Interrupted { stage, best }) => {
            return interrupted::tell((&input, &task), (stage, best), (args, console));
        }
        outcome => outcome.map_err(|error| failed(&input, study, &error))?,
    };
    if let Some(stop) = fit.not_converged {
        let message = format!("fit `{}` did not converge: {}", study.name, stop.text());
        let problem = Diagnostic::error("fit::not_converged", message).at(study.span.clone(), "");
        let help = words::unfound(&task, (stop, &fit));
        return Err(input.refused(Exit::Failed, problem.help(help)));
    }
    let mut answer = Answer::new((&input, study), task, fit);
    answer.doubts = doubts(&answer);
    console.warn(&input.netlist.files, &answer.doubts);
    let mut files = Vec::new();
    if let Some(folder) = &folder {
        files = output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.show(&answer, args.printed.format)?;
    if let Some(folder) = &folder {
        let path = folder.path().join(&files[0]);
        console.note(&format!("wrote  {}, {}", path.display(), files[1..].join(", ")));
        if files.iter().any(|file| file == POSTERIOR) && input.netlist.run.is_some() {
            let file = quoted(&args.file.display().to_string());
            let posterior = quoted(&folder.path().join(POSTERIOR).display().to_string());
            console.next(&format!("lptn run {file} --posterior {posterior} --uncertainty linear"));
        }
    }
    match (args.write, exit) {
        (true, Exit::Done) => {
            write::write(&answer, &args.file, console)?;
            console.next(&format!("lptn run {}", quoted(&args.file.display().to_string())));
        }
        (true, _) => console.message("nothing is written: not every parameter is determined"),
        _ => {}
    }
    Ok(exit)
}

/// The fit, with its progress, until Ctrl-C.
fn observed(task: &NetworkFitTask<'_>, console: &Console) -> Result<NetworkFit, NetworkFitError> {
    let interrupt = Interrupt::listen();
    let line = Mutex::new(ProgressLine::new(console.quiet));
    let outcome = fit_network_observed(task, &|stage, step| {
        // no run waits for the line: the next step says more
        if let Ok(mut line) = line.try_lock() {
            line.update_of(&stage.to_string(), step);
        }
        interrupt.control()
    });
    line.into_inner().unwrap_or_else(PoisonError::into_inner).clear();
    outcome
}

pub(crate) const STUDIES: Studies = Studies {
    section: "fit",
    codes: ["fit::no_study", "fit::which_study"],
    question: "what is to be fitted to what?",
    example: "[fit.heating]\ndata = \"record.csv\"\ncolumn = { ring_gear = \"steel.T\" }\n\
              sigma = \"0.2 K\"\nvary = { R_int = { from = \"1 mK/W\", to = \"1 K/W\" } }",
};

fn failed(input: &Input, study: &FitStudy, error: &NetworkFitError) -> Failure {
    let span = match error {
        NetworkFitError::StartOutside { parameter } => {
            study.varied.get(*parameter).map(|varied| &varied.span)
        }
        error => record_place(study, error),
    };
    input.failure(error, Some(span.unwrap_or(&study.span).clone()))
}

/// The column or record that is at fault.
pub(crate) fn record_place<'s>(study: &'s FitStudy, error: &NetworkFitError) -> Option<&'s Span> {
    match error {
        NetworkFitError::Observed { column, .. }
        | NetworkFitError::NotLinear { column, .. }
        | NetworkFitError::NoValue { column, .. }
        | NetworkFitError::Units { column, .. } => study
            .observed
            .iter()
            .find(|observed| observed.column == *column)
            .map(|observed| &observed.span),
        NetworkFitError::SignalLag { column, .. } => {
            study.signals.iter().find(|signal| signal.column == *column).map(|signal| &signal.span)
        }
        NetworkFitError::Times { record, .. }
        | NetworkFitError::Start { record, .. }
        | NetworkFitError::InitialLong { record, .. }
        | NetworkFitError::Signal { record, .. } => {
            study.records.iter().find(|own| own.csv == *record).map(|own| &own.span)
        }
        _ => None,
    }
}

impl<'a> Answer<'a> {
    pub(crate) fn new(
        (input, study): (&'a Input, &'a FitStudy),
        task: NetworkFitTask<'a>,
        fit: NetworkFit,
    ) -> Self {
        let unknowns = task.unknowns();
        let records: Vec<String> = task.runs.iter().map(|run| run.name.clone()).collect();
        let records = differing(&records);
        let (names, units) = names_and_units(input, &unknowns, &records);
        Self { input, study, task, unknowns, names, units, fit, doubts: Vec::new() }
    }
}

impl Answer<'_> {
    /// Whether every parameter is determined.
    pub(crate) fn is_whole(&self) -> bool {
        self.fit.identifiability.as_ref().is_some_and(|known| known.is_whole())
    }

    /// What was sought, by its names.
    pub(crate) fn named(&self) -> Named<'_> {
        let values = self.fit.parameters.iter().map(|parameter| parameter.value).collect();
        Named { unknowns: &self.unknowns, names: &self.names, units: &self.units, values }
    }

    pub(crate) fn name(&self, i: usize) -> &str {
        &self.names[i]
    }

    /// Places of the parameters of the network among what was sought, and of the values of sensors.
    pub(crate) fn sought(&self) -> (Vec<usize>, Vec<usize>) {
        (0..self.unknowns.len()).partition(|&i| self.unknowns[i].parameter().is_some())
    }

    /// Where it stands what is sought.
    pub(crate) fn place(&self, i: usize) -> &Span {
        let sensors = &self.input.netlist.studies.sensors;
        let sensor = self.unknowns[i].sensor().and_then(|sensor| sensors.get(sensor));
        let varied = || self.study.varied.get(i).map(|varied| &varied.span);
        sensor.map(|sensor| &sensor.span).or_else(varied).unwrap_or(&self.study.span)
    }

    /// A parameter's value in its unit.
    pub(crate) fn shown(&self, i: usize, si: f64) -> f64 {
        self.units[i].from_si(si)
    }

    /// A difference of two values of a parameter in its unit.
    pub(crate) fn shown_difference(&self, i: usize, si: f64) -> f64 {
        si / self.units[i].scale
    }
}
