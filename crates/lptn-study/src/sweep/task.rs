//! One candidate after the other: values in, numbers out.
//!
//! The reports of a sweep are additional reports of the network that only the sweep uses
//! (`Network::reporting`). A run follows those that are numbers over time.

use lptn_analysis::{Analysis, AnalysisError, Found, LimitResult, RunAnalysis, RunError};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Measure, Netlist, SweepOver, SweepStudy};
use lptn_network::{Network, Parameters, Report, ReportId, RunSettings};
use lptn_solve::{Proceed, Solution, SteadyState};

use crate::sweep::cases::Cases;
use crate::sweep::error::SweepError;
use crate::sweep::limits::SweepLimits;

/// The code of a report that is not a number.
const NOT_FINITE: &str = "sweep::not_finite";

/// The results of a candidate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Candidate {
    /// The values of the axes, in SI units.
    pub values: Vec<f64>,
    /// The reports in SI units and in the order of the study; NaN if it failed.
    pub reports: Vec<f64>,
    /// The margin of each limit in SI units; NaN if it was not judged. Empty if it failed.
    pub limits: Vec<f64>,
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
    limits: SweepLimits,
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
            ty: measure.ty,
            over_time: measure.is_over_time().then(|| measure.over_time.clone()),
            text: measure.text.clone(),
        };
        let (network, reports) =
            netlist.network.reporting(study.reports.iter().map(report).collect());
        let parameters = network.given();
        let limits = SweepLimits::of(&network);
        let task = Self { netlist, study, cases, network, reports, limits, parameters };
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

    /// The limits that every candidate is judged by.
    pub fn limits(&self) -> &SweepLimits {
        &self.limits
    }

    /// The netlist.
    pub(crate) fn netlist(&self) -> &Netlist {
        &self.netlist
    }

    /// The time in s at which steady states read their inputs.
    pub(crate) fn start(&self) -> f64 {
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
            Ok(found) => Some(Candidate { values, ..found }),
            Err(Lost::Failed(code)) => {
                let (reports, failed) = (none(), Some(code));
                Some(Candidate { values, reports, failed, ..Candidate::default() })
            }
            Err(Lost::Interrupted) => None,
        }
    }

    fn solved(&self, values: &[f64], control: &dyn Fn() -> Proceed) -> Result<Candidate, Lost> {
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
        let (reports, limits) = match &found {
            Found::Steady(answer) => {
                let limits = LimitResult::of_steady(&network, answer).map_err(failed)?;
                (self.in_steady_state(&network, answer)?, limits)
            }
            Found::Run(answer) => (self.over_time(answer)?, of_run(answer)),
            Found::Cycle(answer) => (self.over_time(&answer.solution)?, of_run(&answer.solution)),
        };
        let (outside, limits) = (found.trust().out_of_range.len(), limits.iter().map(margin));
        match reports.iter().all(|number| number.is_finite()) {
            true => Ok(Candidate { reports, limits: limits.collect(), outside, ..<_>::default() }),
            false => Err(Lost::Failed(NOT_FINITE)),
        }
    }

    fn analysis(
        &self,
        network: &Network,
        settings: Option<&RunSettings>,
    ) -> Result<Analysis, Lost> {
        // reports over time are followed anyway
        let bare = |settings: &RunSettings| RunAnalysis::of(network, settings).bare();
        Ok(match self.study.over {
            SweepOver::Steady => Analysis::Steady { time: self.start(), within: None },
            SweepOver::Run => Analysis::Run(bare(settings.ok_or(Lost::Failed("run::no_run"))?)),
            SweepOver::Periodic => {
                let period = self.period(network).ok_or(Lost::Failed("sweep::no_period"))?;
                Analysis::Cycle(bare(&RunSettings::cycle(settings, period)))
            }
        })
    }

    fn in_steady_state(&self, network: &Network, steady: &SteadyState) -> Result<Vec<f64>, Lost> {
        let mut scope = steady.evaluation(network);
        let value = |id: &ReportId| network.report_value(*id, &mut scope).map_err(failed);
        self.reports.iter().map(value).collect()
    }

    fn over_time(&self, solution: &Solution) -> Result<Vec<f64>, Lost> {
        let mut scope = solution.network().evaluation();
        let number = |(measure, id): (&Measure, &ReportId)| {
            if !measure.is_over_time() {
                return Ok(measure.of.at(&mut scope).map_err(failed)? + 0.0); // no `-0` in columns
            }
            let seen = solution.reports_over_time().iter().find(|seen| seen.report == *id);
            match seen.ok_or(Lost::Failed(NOT_FINITE))? {
                seen if seen.open > 0.0 => Err(Lost::Failed("run::unresolved")),
                seen => Ok(seen.value),
            }
        };
        self.study.reports.iter().zip(&self.reports).map(number).collect()
    }
}

fn of_run(solution: &Solution) -> Vec<LimitResult> {
    solution.limits().iter().map(LimitResult::of_run).collect()
}

/// The margin of a limit; not judged if its possible error decides whether the limit is kept.
fn margin(found: &LimitResult) -> f64 {
    match found.open > 0.0 && found.open >= found.margin.abs() {
        true => f64::NAN,
        false => found.margin,
    }
}

fn failed(error: impl lptn_units::Problem) -> Lost {
    Lost::Failed(error.code())
}
