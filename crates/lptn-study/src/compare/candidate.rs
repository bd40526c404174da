//! One candidate.

use std::sync::Arc;

use lptn_analysis::{Observer, Trust};
use lptn_assembly::ThermalSystem;
use lptn_network::{LimitSeverity, Network, RunSettings};
use lptn_solve::{Looks, Others, PeriodicError, Proceed, Statistics, SteadyState, Summary};

use crate::compare::asked::{all_nodes, bare};
use crate::compare::doubt::Scatter;
use crate::compare::error::CompareError;
use crate::compare::heat::{HeatOut, HeatOver};
use crate::compare::limits::{self, CandidateLimit};
use crate::compare::peak::{Peak, hottest, peak};
use crate::compare::settled::{self, Settled};

/// What is compared of a candidate. Temperatures in K, times in s.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The name of the node that gets hottest; `None` where a network consists of boundaries alone.
    pub hottest: Option<String>,
    /// Its peak during the run, or its steady temperature where there is no run.
    pub peak: Option<Peak>,
    /// Its temperature in steady state; `None` where inputs change with time or there is none.
    pub steady: Option<f64>,
    /// How long it takes to get 95 % of the way from its start to its steady state; `None` if the
    /// run ends before.
    pub time_to_95: Option<f64>,
    /// Every limit, in the order of the network.
    pub limits: Vec<CandidateLimit>,
    /// The settled cycle, where signals repeat themselves: what came of it, or why there is none.
    pub settled: Option<Result<Settled, Arc<PeriodicError>>>,
    /// Where its heat goes.
    pub heat: HeatOut,
    /// Sum of all heat capacities in J/K.
    pub capacity: f64,
    /// Mass of all nodes in kg; `None` where that of a node with capacity is not known.
    pub mass: Option<f64>,
    /// How far its numbers can be trusted.
    pub trust: Trust,
    /// Its steady state, where there are others or they cannot be excluded.
    pub several: Option<SteadyState>,
    /// The work of its run or cycle; zero in steady state.
    pub statistics: Statistics,
    /// How much was looked at in it.
    pub looks: Looks,
    /// What the `±` of parameters do to it, where that was asked for: see [`Scatter::of_run`].
    pub scatter: Option<Scatter>,
}

impl Candidate {
    /// Runs a candidate; without settings of a run it is compared over its settled cycle where its
    /// signals repeat themselves, else in steady state.
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

    /// Compares a candidate over its settled cycle, although it may have a run, which lends start and
    /// tolerance; in steady state where its inputs are constant.
    ///
    /// # Errors
    /// [`CompareError`] if there is no settled cycle, or it was interrupted.
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

    /// The temperature limit with the least margin: of those of severity error, else of the
    /// warnings; `None` without a limit of a temperature.
    pub fn worst(&self) -> Option<&CandidateLimit> {
        let of = |severity| {
            let judged = self.limits.iter().filter(|l| !l.is_open());
            let limits = judged.filter(move |l| l.is_temperature() && l.severity == severity);
            limits.min_by(|a, b| a.margin.total_cmp(&b.margin))
        };
        of(LimitSeverity::Error).or_else(|| of(LimitSeverity::Warning))
    }

    /// What every candidate has, whatever it was solved over.
    fn of(network: &Network, limits: &[lptn_analysis::LimitResult], trust: Trust) -> Self {
        Self {
            hottest: None,
            peak: None,
            steady: None,
            time_to_95: None,
            limits: limits::named(network, limits),
            settled: None,
            heat: HeatOut::default(),
            capacity: network.node_ids().map(|id| network.capacity(id)).sum(),
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
        let hottest = hottest(network.node_ids().zip(steady.temperatures.iter().copied()));
        let temperature = hottest.map(|(_, temperature)| temperature);
        Ok(Self {
            hottest: hottest.map(|(id, _)| network.nodes()[id.index()].name.clone()),
            peak: temperature.map(|temperature| Peak { temperature, at: None }),
            steady: temperature.filter(|_| constant),
            settled,
            heat: HeatOut::in_steady_state(network, &steady),
            several: doubtful(&steady),
            ..Self::of(network, &limits, steady.trust)
        })
    }

    /// Where signals repeat themselves and nothing says how long a run is.
    fn over_a_cycle(system: &ThermalSystem, found: settled::Found) -> Self {
        let settled::Found { settled, limits, answer } = found;
        let network = system.network();
        Self {
            hottest: settled.hottest.clone(),
            peak: settled.peak,
            heat: HeatOut::over_time(network, &answer.solution, HeatOver::Cycle),
            statistics: *answer.solution.statistics(),
            looks: answer.solution.looks(),
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
            settled: Settled::find(system, Some(run), observer)?
                .map(|found| found.map(|found| found.settled)),
            heat: HeatOut::over_time(network, &answer, HeatOver::Run),
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
