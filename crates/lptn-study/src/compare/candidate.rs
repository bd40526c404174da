//! One candidate.

use std::sync::Arc;

use lptn_analysis::{Observer, Trust};
use lptn_assembly::ThermalSystem;
use lptn_network::{LimitSeverity, Network, NodeId, RunSettings};
use lptn_solve::{Looks, Others, PeriodicError, Proceed, Statistics, SteadyState, Summary};

use crate::compare::asked::{all_nodes, bare};
use crate::compare::doubt::Scatter;
use crate::compare::error::CompareError;
use crate::compare::heat::{HeatOut, HeatOver};
use crate::compare::limits::{self, CandidateLimit};
use crate::compare::peak::{Peak, hottest, peak};
use crate::compare::reports::{self, CandidateReport};
use crate::compare::settled::{self, Settled};

/// The compared results of a candidate. Temperatures in K, times in s.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The name of the hottest node; `None` if a network consists of boundaries alone.
    pub hottest: Option<String>,
    /// Its peak during the run, or its steady temperature if there is no run.
    pub peak: Option<Peak>,
    /// Its temperature in steady state; `None` if inputs change with time or there is none.
    pub steady: Option<f64>,
    /// Time to get 95 % of the way from its start to its steady state; `None` if the run ends
    /// before.
    pub time_to_95: Option<f64>,
    /// Every limit, in the order of the network.
    pub limits: Vec<CandidateLimit>,
    /// Every report that is a number over time, in the order of the network.
    pub reports: Vec<CandidateReport>,
    /// The periodic steady state if signals repeat themselves: its results, or why there is none.
    pub settled: Option<Result<Settled, Arc<PeriodicError>>>,
    /// The distribution of its heat.
    pub heat: HeatOut,
    /// Sum of all heat capacities in J/K.
    pub capacity: f64,
    /// Mass of all nodes in kg; `None` if that of a node with capacity is not known.
    pub mass: Option<f64>,
    /// The trust in its numbers.
    pub trust: Trust,
    /// Its steady state, if there are others or they cannot be excluded.
    pub several: Option<SteadyState>,
    /// The work of its run or cycle; zero in steady state.
    pub statistics: Statistics,
    /// Number of evaluations in it.
    pub looks: Looks,
    /// The effect of the `±` of parameters on it, if requested: see [`Scatter::of_run`].
    pub scatter: Option<Scatter>,
}

impl Candidate {
    /// Runs a candidate. Without settings of a run it is compared over its periodic steady state if
    /// its signals repeat themselves, else in steady state.
    ///
    /// # Errors
    /// [`CompareError`] if it cannot be solved.
    pub fn evaluate(
        system: &ThermalSystem,
        run: Option<&RunSettings>,
    ) -> Result<Self, CompareError> {
        Self::evaluate_observed(system, run, &mut |_| Proceed::Continue)
    }

    /// The same; `observer` is called after every step of the run and may interrupt it.
    ///
    /// # Errors
    /// [`CompareError`] if it cannot be solved or was interrupted.
    pub fn evaluate_observed(
        system: &ThermalSystem,
        run: Option<&RunSettings>,
        observer: &mut Observer<'_>,
    ) -> Result<Self, CompareError> {
        match run {
            Some(run) => Self::over_time(system, run, observer),
            None => Self::without_run(system, observer),
        }
    }

    /// Compares a candidate over its periodic cycle, although it may have a run, from which start
    /// and tolerance are taken; in steady state if its inputs are constant.
    ///
    /// # Errors
    /// [`CompareError`] if there is no periodic steady state, or it was interrupted.
    pub fn settled_observed(
        system: &ThermalSystem,
        run: Option<&RunSettings>,
        observer: &mut Observer<'_>,
    ) -> Result<Self, CompareError> {
        match Settled::find(system, run, observer)? {
            Some(Ok(found)) => Ok(Self::over_a_cycle(system, found)),
            Some(Err(reason)) => Err(CompareError::Cycle(reason)),
            None if system.network().changing_inputs().is_empty() => {
                Self::in_steady_state(system, None)
            }
            None => Err(CompareError::NoPeriod),
        }
    }

    /// The temperature limit with the least margin: one of severity error, else one of the
    /// warnings; `None` without a limit of a temperature.
    pub fn worst(&self) -> Option<&CandidateLimit> {
        let of = |severity| {
            let judged = self.limits.iter().filter(|l| !l.is_open());
            let limits = judged.filter(move |l| l.is_temperature() && l.severity == severity);
            limits.min_by(|a, b| a.margin.total_cmp(&b.margin))
        };
        of(LimitSeverity::Error).or_else(|| of(LimitSeverity::Warning))
    }

    /// The results that every candidate has, whatever it was solved over.
    fn of(network: &Network, limits: &[lptn_analysis::LimitResult], trust: Trust) -> Self {
        Self {
            hottest: None,
            peak: None,
            steady: None,
            time_to_95: None,
            limits: limits::named(network, limits),
            reports: Vec::new(),
            settled: None,
            heat: HeatOut::default(),
            capacity: network.thermal_nodes().map(|id| network.capacity(id)).sum(),
            // a part of unknown material makes the whole unknown: a sum without it would look light
            mass: network.whole_mass(),
            trust,
            several: None,
            statistics: Statistics::default(),
            looks: Looks::default(),
            scatter: None,
        }
    }

    fn without_run(
        system: &ThermalSystem,
        observer: &mut Observer<'_>,
    ) -> Result<Self, CompareError> {
        match Settled::find(system, None, observer)? {
            Some(Ok(found)) => Ok(Self::over_a_cycle(system, found)),
            Some(Err(reason)) => Self::in_steady_state(system, Some(Err(reason))),
            None => Self::in_steady_state(system, None),
        }
    }

    fn in_steady_state(
        system: &ThermalSystem,
        settled: Option<Result<Settled, Arc<PeriodicError>>>,
    ) -> Result<Self, CompareError> {
        let network = system.network();
        let steady = lptn_analysis::steady(system, 0.0)?;
        let limits = lptn_analysis::LimitResult::of_steady(network, &steady)?;
        let constant = network.changing_inputs().is_empty();
        let hottest = hottest(temperatures(network, &steady));
        let temperature = hottest.map(|(_, temperature)| temperature);
        Ok(Self {
            hottest: hottest.map(|(id, _)| network.nodes()[id.index()].name.clone()),
            peak: temperature.map(|temperature| Peak { temperature, at: None }),
            steady: temperature.filter(|_| constant),
            reports: reports::named(network, &steady.reports_over_time(network)?),
            settled,
            heat: HeatOut::in_steady_state(network, &steady),
            several: doubtful(&steady),
            ..Self::of(network, &limits, steady.trust)
        })
    }

    /// Results if signals repeat themselves and no run has a given length.
    fn over_a_cycle(system: &ThermalSystem, found: settled::Found) -> Self {
        let settled::Found { settled, limits, answer } = found;
        let network = system.network();
        Self {
            hottest: settled.hottest.clone(),
            peak: settled.peak,
            heat: HeatOut::over_time(network, &answer.solution, (HeatOver::Cycle, settled.period)),
            statistics: *answer.solution.statistics(),
            looks: answer.solution.looks(),
            reports: reports::named(network, answer.solution.reports_over_time()),
            settled: Some(Ok(settled)),
            ..Self::of(network, &limits, answer.trust)
        }
    }

    fn over_time(
        system: &ThermalSystem,
        run: &RunSettings,
        observer: &mut Observer<'_>,
    ) -> Result<Self, CompareError> {
        let network = system.network();
        let constant = network.changing_inputs().is_empty();
        let steady = if constant { lptn_analysis::steady(system, run.start).ok() } else { None };
        let steady = steady.as_deref();
        let answer = bare(network, run)
            .towards((system, &all_nodes(network)), steady)
            .map_err(CompareError::Start)?
            .for_the_hottest()
            .solve(system, observer)?;
        let nodes = Summary::new(&answer, steady).nodes;
        let node = hottest(nodes.iter().map(|node| (node, node.peak.0))).map(|(node, _)| node);
        let limits: Vec<_> =
            answer.limits().iter().map(lptn_analysis::LimitResult::of_run).collect();
        Ok(Self {
            hottest: node.map(|node| network.nodes()[node.node.index()].name.clone()),
            peak: node.map(|node| peak(node, run)),
            steady: node.and_then(|node| node.steady),
            time_to_95: node.and_then(|node| node.time_to_95),
            reports: reports::named(network, answer.reports_over_time()),
            settled: Settled::find(system, Some(run), observer)?
                .map(|found| found.map(|found| found.settled)),
            heat: HeatOut::over_time(network, &answer, (HeatOver::Run, run.stop - run.start)),
            statistics: *answer.statistics(),
            looks: answer.looks(),
            several: steady.and_then(doubtful),
            ..Self::of(network, &limits, answer.trust)
        })
    }
}

/// A steady state that may not be the only one.
fn doubtful(steady: &SteadyState) -> Option<SteadyState> {
    (steady.others != Others::None).then(|| steady.clone())
}

/// The temperature of every node in K.
fn temperatures<'a>(
    network: &'a Network,
    steady: &'a SteadyState,
) -> impl Iterator<Item = (NodeId, f64)> + 'a {
    network.thermal_nodes().map(|id| (id, steady.temperatures[id.index()]))
}
