//! One candidate after the other: values in, numbers out.
//!
//! The reports of a sweep are additional reports of the network that only the sweep uses
//! (`Network::reporting`). Windows over the whole run read them.

use lptn_analysis::{Analysis, AnalysisError, Found, RunAnalysis, RunError};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Functional, Measure, Netlist, SweepOver, SweepStudy};
use lptn_network::{Network, Parameters, Report, ReportId, RunSettings};
use lptn_solve::{Proceed, Selection, Solution, SteadyState, Window};

use crate::sweep::cases::Cases;
use crate::sweep::error::SweepError;

/// The code of a report that is not a number.
const NOT_FINITE: &str = "sweep::not_finite";

/// The results of a candidate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Candidate {
    /// The values of the axes, in SI units.
    pub values: Vec<f64>,
    /// The reports in SI units and in the order of the study; NaN if it failed.
    pub reports: Vec<f64>,
    /// Number of laws outside of the ranges in which they are known.
    pub outside: usize,
    /// The code of the error that it failed with.
    pub failed: Option<&'static str>,
}

/// Why a candidate has no numbers.
enum Lost {
    Failed(&'static str),
    Interrupted,
}

impl From<AnalysisError> for Lost {
    fn from(error: AnalysisError) -> Self {
        match error {
            AnalysisError::Run(RunError::Interrupted { .. }) => Self::Interrupted,
            error => Self::Failed(error.code()),
        }
    }
}

/// A sweep that is about to begin: everything that all candidates share.
#[derive(Debug)]
pub struct SweepTask {
    netlist: Netlist,
    study: SweepStudy,
    cases: Cases,
    /// The network with the reports of the study as its further reports.
    network: Network,
    reports: Vec<ReportId>,
    /// The columns of those that are taken over time.
    columns: Selection,
    parameters: Parameters,
}

impl SweepTask {
    /// Prepares a sweep and checks everything that is known before a candidate is solved.
    ///
    /// # Errors
    /// [`SweepError`].
    pub fn new(netlist: Netlist, study: SweepStudy, cases: Cases) -> Result<Self, SweepError> {
        let report = |measure: &Measure| Report {
            name: measure.name.clone(),
            value: measure.of.clone(),
            ty: measure.over_time.of_ty,
            text: measure.text.clone(),
        };
        let (network, reports) =
            netlist.network.reporting(study.reports.iter().map(report).collect());
        let timed: Vec<ReportId> = study
            .reports
            .iter()
            .zip(&reports)
            .filter(|(measure, _)| measure.functional() != Functional::Value)
            .map(|(_, id)| *id)
            .collect();
        let columns = Selection::of_reports(&timed);
        let parameters = network.given();
        let task = Self { netlist, study, cases, network, reports, columns, parameters };
        task.check()?;
        Ok(task)
    }

    fn check(&self) -> Result<(), SweepError> {
        match self.study.over {
            SweepOver::Run => Ok(()),
            SweepOver::Periodic => self.check_period(),
            SweepOver::Steady => {
                let values: Vec<_> = self.study.reports.iter().map(|report| &report.of).collect();
                let changing = self.network.changing_inputs_of(&values);
                if changing.is_empty() { Ok(()) } else { Err(SweepError::Changing(changing)) }
            }
        }
    }

    fn check_period(&self) -> Result<(), SweepError> {
        let (start, period) = (self.start(), self.period(&self.network));
        let period = period.ok_or(SweepError::NoPeriod)?;
        let repeats = self.network.check_period(start, period);
        let repeats = repeats.map_err(|error| SweepError::Periodic(error.into()))?;
        let not = lptn_solve::PeriodicError::NotPeriodic;
        repeats.map_err(|found| SweepError::Periodic(not(found)))
    }

    /// The candidates.
    pub fn cases(&self) -> &Cases {
        &self.cases
    }

    /// The study.
    pub fn study(&self) -> &SweepStudy {
        &self.study
    }

    /// The network with the netlist's own values and the reports of the study.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// The netlist.
    pub(super) fn netlist(&self) -> &Netlist {
        &self.netlist
    }

    /// The time in s at which steady states read their inputs.
    pub(super) fn start(&self) -> f64 {
        self.netlist.run.as_ref().map_or(0.0, |run| run.start)
    }

    /// The length of the cycle in s.
    fn period(&self, network: &Network) -> Option<f64> {
        self.cases.plan().period.or_else(|| network.repeat_period().ok().flatten())
    }

    /// Solves one candidate; `None` if `control` interrupted it.
    pub fn candidate(&self, case: u64, control: &dyn Fn() -> Proceed) -> Option<Candidate> {
        let mut values = vec![0.0; self.cases.parameters().len()];
        self.cases.values(case, &mut values);
        let found = self.solved(&values, control);
        let none = || vec![f64::NAN; self.study.reports.len()];
        match found {
            Ok((reports, outside)) => Some(Candidate { values, reports, outside, failed: None }),
            Err(Lost::Failed(code)) => {
                Some(Candidate { values, reports: none(), outside: 0, failed: Some(code) })
            }
            Err(Lost::Interrupted) => None,
        }
    }

    fn solved(
        &self,
        values: &[f64],
        control: &dyn Fn() -> Proceed,
    ) -> Result<(Vec<f64>, usize), Lost> {
        let mut parameters = self.parameters.clone();
        for (id, &value) in self.cases.parameters().zip(values) {
            parameters.set(id, value);
        }
        let network = self.network.with(&parameters).map_err(|errors| {
            Lost::Failed(errors.0.first().map_or(NOT_FINITE, |first| first.code()))
        })?;
        let settings = self.netlist.settings_of(&network).map_err(|problems| {
            Lost::Failed(problems.first().map_or(NOT_FINITE, |first| first.code))
        })?;
        let system = ThermalSystem::assemble(&network).map_err(failed)?;
        let analysis = self.analysis(&network, settings.as_ref())?;
        let found = analysis.ask(&system, &mut |_| control())?;
        let reports = match &found {
            Found::Steady(answer) => self.in_steady_state(&network, answer)?,
            Found::Run(answer) => self.over_time(answer)?,
            Found::Cycle(answer) => self.over_time(&answer.solution)?,
        };
        match reports.iter().all(|number| number.is_finite()) {
            true => Ok((reports, found.trust().out_of_range.len())),
            false => Err(Lost::Failed(NOT_FINITE)),
        }
    }

    fn analysis(
        &self,
        network: &Network,
        settings: Option<&RunSettings>,
    ) -> Result<Analysis, Lost> {
        Ok(match self.study.over {
            SweepOver::Steady => Analysis::Steady { time: self.start(), within: None },
            SweepOver::Run => {
                Analysis::Run(self.run(network, settings.ok_or(Lost::Failed("run::no_run"))?))
            }
            SweepOver::Periodic => {
                let period = self.period(network).ok_or(Lost::Failed("sweep::no_period"))?;
                Analysis::Cycle(self.run(network, &RunSettings::cycle(settings, period)))
            }
        })
    }

    /// A run that takes the reports over the whole of it, and keeps nothing else.
    fn run(&self, network: &Network, settings: &RunSettings) -> RunAnalysis {
        let (name, of) = (self.study.name.clone(), self.columns.clone());
        let window = Window { name, from: settings.start, to: settings.stop, of };
        let windows = if self.columns.is_empty() { Vec::new() } else { vec![window] };
        RunAnalysis::of(network, settings).bare().over(windows)
    }

    fn in_steady_state(&self, network: &Network, steady: &SteadyState) -> Result<Vec<f64>, Lost> {
        let mut scope = steady.evaluation(network);
        let value = |id: &ReportId| network.report_value(*id, &mut scope).map_err(failed);
        self.reports.iter().map(value).collect()
    }

    fn over_time(&self, solution: &Solution) -> Result<Vec<f64>, Lost> {
        let seen = solution.windows().iter();
        let seen = seen.flat_map(|window| window.columns.iter().map(move |c| (window, c)));
        let mut scope = solution.network().evaluation();
        let mut seen = seen;
        let mut reports = Vec::with_capacity(self.study.reports.len());
        for measure in &self.study.reports {
            let number = match measure.functional() {
                Functional::Value => measure.of.at(&mut scope).map_err(failed)?,
                functional => {
                    let (window, column) = seen.next().ok_or(Lost::Failed(NOT_FINITE))?;
                    if column.is_open() {
                        return Err(Lost::Failed("run::unresolved"));
                    }
                    let life = measure.over_time.life.as_ref().map(|life| life.at(&mut scope));
                    let life = life.transpose().map_err(failed)?;
                    functional.of(&window.history(column), life)
                }
            };
            reports.push(number + 0.0); // no `-0` in columns
        }
        Ok(reports)
    }
}

fn failed(error: impl lptn_units::Problem) -> Lost {
    Lost::Failed(error.code())
}
