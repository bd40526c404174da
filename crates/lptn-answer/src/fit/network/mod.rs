//! Parameters of a network from records of its temperatures and heat flows.

mod figure;
mod interrupted;
mod page;
mod report;
mod residuals;
mod shared_noise;
mod units;
mod words;

pub use interrupted::InterruptedFit;
pub(super) use page::{parameter, values};
pub(super) use units::common;
pub(crate) use words::{doubts, verdict};

use std::sync::Arc;

use lptn_fit::network::{
    NetworkFit, NetworkFitError, NetworkFitTask, Unknown, fit_network_observed,
};
use lptn_netlist::{Diagnostic, Files, FitStudy, Posterior, Span};
use lptn_network::ParameterId;
use lptn_report::{Shortest, differing};
use lptn_solve::available_threads;
use lptn_units::Unit;

use crate::answer::Answer;
use crate::example;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::studies::Studies;
use crate::unseparated::{Named, names_and_units};

/// Digits that are written into a netlist: a tenth of a standard error never is beyond them.
const DIGITS: usize = 9;

/// Asks which parameters of a network describe its records.
///
/// Ask a netlist with its own values: another fit may have counted the same records.
#[derive(Clone, Debug, Default)]
pub struct FitNetworkQuestion {
    /// Name of the `[fit.NAME]`; `None` for the only one.
    pub study: Option<String>,
    /// Number of searches from other starts between the bounds; `None` for that of the study.
    pub starts: Option<usize>,
}

/// A fit that can be computed.
#[derive(Debug)]
pub struct FitOfNetwork {
    input: Arc<Input>,
    study: FitStudy,
    /// The study that was requested by its name.
    named: Option<String>,
    task: NetworkFitTask,
}

/// Outcome of a fit.
#[derive(Debug)]
pub enum FitNetworkEnd {
    /// It found values.
    Found(Box<FitNetworkAnswer>),
    /// The listener interrupted it.
    Interrupted(Box<InterruptedFit>),
}

/// Parameters of a network with their errors, and how well it describes the records.
#[derive(Debug)]
pub struct FitNetworkAnswer {
    pub(super) input: Arc<Input>,
    study: FitStudy,
    /// The parameters and records of the fit.
    pub task: NetworkFitTask,
    /// The estimated quantities: parameters, then values of sensors.
    pub unknowns: Vec<Unknown>,
    /// The name of each estimated quantity.
    pub names: Vec<String>,
    /// The unit in which each estimated quantity is shown.
    pub units: Vec<Unit>,
    /// The values with their errors, in SI units.
    pub fit: NetworkFit,
    doubts: Vec<Diagnostic>,
}

impl Answer for FitNetworkAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts].concat()
    }
}

pub(super) const STUDIES: Studies = Studies {
    section: "fit",
    codes: ["fit::no_study", "fit::which_study"],
    question: "a fit needs records and parameters",
    example: example::fit,
};

impl FitNetworkQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A study that does not exist or cannot be computed, a search without a minimum, and one that
    /// was interrupted.
    pub fn ask(
        &self,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<FitNetworkAnswer, Failure> {
        match self.begin(input, listener)?.compute(listener)? {
            FitNetworkEnd::Found(answer) => Ok(*answer),
            FitNetworkEnd::Interrupted(fit) => Err(fit.failure()),
        }
    }

    /// Reads the study in advance.
    ///
    /// # Errors
    /// A study that does not exist, and one that does not fit its network.
    pub fn begin(
        &self,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<FitOfNetwork, Failure> {
        let netlist = &input.netlist;
        let fits = &netlist.studies.fits;
        let study = STUDIES.find(&input, (fits, |study| &study.name), self.study.as_deref())?;
        listener.warn(&netlist.files, &netlist.warnings);
        let mut task = NetworkFitTask::of(netlist, study, available_threads())
            .map_err(|error| failed(&input, study, &error))?;
        task.more_starts = self.starts.unwrap_or(task.more_starts);
        let (study, named) = (study.clone(), self.study.clone());
        Ok(FitOfNetwork { input, study, named, task })
    }
}

impl FitOfNetwork {
    /// The parameters that it varies.
    pub fn varied(&self) -> impl Iterator<Item = ParameterId> + '_ {
        self.task.parameters.iter().map(|varied| varied.parameter)
    }

    /// Computes it.
    ///
    /// # Errors
    /// A run that fails, and a search without a minimum.
    pub fn compute(self, listener: &dyn Listener) -> Result<FitNetworkEnd, Failure> {
        let Self { input, study, named, task } = self;
        let observe = |stage, step| listener.stage(&stage, step);
        let fit = match fit_network_observed(&task, &observe) {
            Err(NetworkFitError::Interrupted { stage, best }) => {
                let fit = InterruptedFit::new((input, &task), named, (stage, best));
                return Ok(FitNetworkEnd::Interrupted(Box::new(fit)));
            }
            outcome => outcome.map_err(|error| failed(&input, &study, &error))?,
        };
        if let Some(stop) = fit.not_converged {
            let message = format!("fit `{}` did not converge: {}", study.name, stop.text());
            let problem = Diagnostic::error("fit::not_converged", message);
            let problem = problem.at(study.span.clone(), "");
            let help = words::unfound(&task, (stop, &fit));
            return Err(input.refused(Exit::Failed, problem.help(help)));
        }
        let mut answer = FitNetworkAnswer::new((input, study), task, fit);
        answer.doubts = doubts(&answer);
        listener.warn(answer.files(), &answer.doubts);
        Ok(FitNetworkEnd::Found(Box::new(answer)))
    }
}

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

impl FitNetworkAnswer {
    pub(crate) fn new(
        (input, study): (Arc<Input>, FitStudy),
        task: NetworkFitTask,
        fit: NetworkFit,
    ) -> Self {
        let unknowns = task.unknowns();
        let records: Vec<String> = task.runs.iter().map(|run| run.name.clone()).collect();
        let records = differing(&records);
        let (names, units) = names_and_units(&input, &unknowns, &records);
        Self { input, study, task, unknowns, names, units, fit, doubts: Vec::new() }
    }

    /// The netlist that was asked.
    pub fn input(&self) -> &Arc<Input> {
        &self.input
    }

    /// True if every parameter is determined.
    pub fn is_whole(&self) -> bool {
        self.fit.identifiability.as_ref().is_some_and(|known| known.is_whole())
    }

    /// The values with their covariance, for further studies.
    /// `None` if a value is not determined.
    pub fn posterior(&self) -> Option<Posterior> {
        let called = (self.input.text.stem.as_str(), self.study.name.as_str());
        self.fit.posterior(&self.task, called, &self.names)
    }

    /// The numbers of parameters that the netlist writes as numbers, in their units there.
    /// Each has the index of the parameter among the estimated quantities.
    pub fn numbers(&self) -> Vec<(usize, ParameterId, String)> {
        let number = |i: usize| {
            let parameter = self.task.parameters[i].parameter;
            self.input.netlist.written_number(parameter)?;
            let value = self.shown(i, self.fit.parameters[i].value);
            let rounded = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
            Some((i, parameter, Shortest::new().text(rounded).to_owned()))
        };
        (0..self.task.parameters.len()).filter_map(number).collect()
    }

    /// The estimated quantities with their names.
    fn named(&self) -> Named<'_> {
        let values = self.fit.parameters.iter().map(|parameter| parameter.value).collect();
        Named { unknowns: &self.unknowns, names: &self.names, units: &self.units, values }
    }

    pub(super) fn name(&self, i: usize) -> &str {
        &self.names[i]
    }

    /// Indices of network parameters among the estimated quantities, and indices of sensor values.
    fn estimated(&self) -> (Vec<usize>, Vec<usize>) {
        (0..self.unknowns.len()).partition(|&i| self.unknowns[i].parameter().is_some())
    }

    /// Place of an estimated quantity in the netlist.
    fn place(&self, i: usize) -> &Span {
        let sensors = &self.input.netlist.studies.sensors;
        let sensor = self.unknowns[i].sensor().and_then(|sensor| sensors.get(sensor));
        let varied = || self.study.varied.get(i).map(|varied| &varied.span);
        sensor.map(|sensor| &sensor.span).or_else(varied).unwrap_or(&self.study.span)
    }

    /// A parameter's value in its unit.
    fn shown(&self, i: usize, si: f64) -> f64 {
        self.units[i].from_si(si)
    }

    /// A difference of two values of a parameter in its unit.
    fn shown_difference(&self, i: usize, si: f64) -> f64 {
        si / self.units[i].scale
    }
}
