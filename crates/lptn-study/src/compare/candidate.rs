//! One candidate.

use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_netlist::RunSettings;
use lptn_network::{LimitSeverity, Network};
use lptn_solve::{
    Beyond, Looks, Others, OutOfRange, OutputTimes, PeriodicError, Proceed, Progress,
    RecordedNodes, RunStatus, Statistics, SteadyState, Summary, Transient,
};

use crate::compare::doubt::Scatter;
use crate::compare::error::CompareError;
use crate::compare::heat::{self, HeatOut, HeatOver};
use crate::compare::limits::{self, LimitResult};
use crate::compare::peak::{Peak, hottest, peak};
use crate::compare::settled::{Found, Settled};

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
    pub limits: Vec<LimitResult>,
    /// The settled cycle, where signals repeat themselves: what came of it, or why there is none.
    pub settled: Option<Result<Settled, Arc<PeriodicError>>>,
    /// Where its heat goes.
    pub heat: HeatOut,
    /// Sum of all heat capacities in J/K.
    pub capacity: f64,
    /// Mass of all nodes in kg; `None` where that of a node with capacity is not known.
    pub mass: Option<f64>,
    /// A temperature that nothing real has.
    pub beyond: Option<Beyond>,
    /// Where laws were outside the ranges in which they are known.
    pub out_of_range: Vec<OutOfRange>,
    /// Its steady state, where there are others or they cannot be excluded.
    pub several: Option<SteadyState>,
    /// What the integration of its run or cycle took; zero in steady state.
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
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Self, CompareError> {
        match run {
            Some(run) => Self::over_time(system, run, observer),
            None => Self::in_steady_state(system, observer),
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
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Self, CompareError> {
        let network = system.network();
        match Settled::find(system, run, observer)? {
            Some(Ok(found)) => Ok(Self::over_a_cycle(network, found)),
            Some(Err(reason)) => Err(CompareError::Cycle(reason)),
            None if network.changing_inputs().is_empty() => Self::in_steady_state(system, observer),
            None => Err(CompareError::NoPeriod),
        }
    }

    /// The temperature limit with the least margin: of those of severity error, else of the
    /// warnings; `None` without a limit of a temperature.
    pub fn worst(&self) -> Option<&LimitResult> {
        let of = |severity| {
            let judged = self.limits.iter().filter(|l| !l.is_open());
            let limits = judged.filter(move |l| l.is_temperature() && l.severity == severity);
            limits.min_by(|a, b| a.margin.total_cmp(&b.margin))
        };
        of(LimitSeverity::Error).or_else(|| of(LimitSeverity::Warning))
    }

    fn in_steady_state(
        system: &ThermalSystem,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Self, CompareError> {
        let network = system.network();
        let settled = match Settled::find(system, None, observer)? {
            Some(Ok(found)) => return Ok(Self::over_a_cycle(network, found)),
            Some(Err(reason)) => Some(Err(reason)),
            None => None,
        };
        let steady = SteadyState::solve(system, 0.0).map_err(CompareError::Steady)?;
        let mut margins = steady.limit_margins(network, 0.0).map_err(CompareError::Input)?;
        for (limit, margin) in network.limits().iter().zip(&mut margins) {
            if !network.changing_inputs_of(&[&limit.of, &limit.value]).is_empty() {
                *margin = f64::NAN;
            }
        }
        let constant = network.changing_inputs().is_empty();
        let hottest = hottest(network.node_ids().zip(steady.temperatures.iter().copied()));
        let temperature = hottest.map(|(_, temperature)| temperature);
        Ok(Self {
            hottest: hottest.map(|(id, _)| network.nodes()[id.index()].name.clone()),
            peak: temperature.map(|temperature| Peak { temperature, at: None }),
            steady: temperature.filter(|_| constant),
            time_to_95: None,
            limits: limits::in_steady_state(network, &margins),
            settled,
            heat: HeatOut::in_steady_state(network, &steady),
            capacity: capacity(network),
            mass: mass(network),
            beyond: Beyond::of_steady(network, &steady),
            out_of_range: OutOfRange::of_steady(network, &steady).map_err(CompareError::Input)?,
            several: Some(steady).filter(is_doubtful),
            statistics: Statistics::default(),
            looks: Looks::default(),
            scatter: None,
        })
    }

    /// Where signals repeat themselves and nothing says how long a run is.
    fn over_a_cycle(network: &Network, found: Found) -> Self {
        let Found { settled, solution } = found;
        Self {
            hottest: settled.hottest.clone(),
            peak: settled.peak,
            steady: None,
            time_to_95: None,
            limits: settled.limits.clone(),
            settled: Some(Ok(settled)),
            heat: HeatOut::over_time(network, &solution, HeatOver::Cycle),
            capacity: capacity(network),
            mass: mass(network),
            beyond: Beyond::of_run(&solution),
            out_of_range: solution.out_of_range().to_vec(),
            several: None,
            statistics: *solution.statistics(),
            looks: solution.looks(),
            scatter: None,
        }
    }

    fn over_time(
        system: &ThermalSystem,
        run: &RunSettings,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Self, CompareError> {
        let network = system.network();
        let constant = network.changing_inputs().is_empty();
        let steady = if constant { SteadyState::solve(system, run.start).ok() } else { None };
        let transient = transient(system, run, steady.as_ref())?;
        let solution = transient.solve_observed(system, observer);
        let solution = solution.map_err(|error| CompareError::Run(Box::new(error)))?;
        if let RunStatus::Interrupted(time) = solution.end() {
            return Err(CompareError::Interrupted(time));
        }
        let nodes = Summary::new(&solution, steady.as_ref()).nodes;
        let node = hottest(nodes.iter().map(|node| (node, node.peak.0))).map(|(node, _)| node);
        Ok(Self {
            hottest: node.map(|node| network.nodes()[node.node.index()].name.clone()),
            peak: node.map(|node| peak(node, run)),
            steady: node.and_then(|node| node.steady),
            time_to_95: node.and_then(|node| node.time_to_95),
            limits: limits::over_time(network, solution.limits()),
            settled: Settled::find(system, Some(run), observer)?
                .map(|found| found.map(|found| found.settled)),
            heat: HeatOut::over_time(network, &solution, HeatOver::Run),
            capacity: capacity(network),
            mass: mass(network),
            beyond: Beyond::of_run(&solution),
            out_of_range: solution.out_of_range().to_vec(),
            several: steady.filter(is_doubtful),
            statistics: *solution.statistics(),
            looks: solution.looks(),
            scatter: None,
        })
    }
}

fn is_doubtful(steady: &SteadyState) -> bool {
    steady.others != Others::None
}

/// The run of the file without its rows, and with every node watched: peaks and limits are looked
/// at between rows.
fn transient(
    system: &ThermalSystem,
    run: &RunSettings,
    steady: Option<&SteadyState>,
) -> Result<Transient, CompareError> {
    let network = system.network();
    let nodes: Vec<_> = network.node_ids().collect();
    let watch = Summary::watches(system, run.start, &nodes, steady).map_err(CompareError::Start)?;
    let of = Transient::of(network, run);
    let windows = of.windows.iter().cloned().chain(heat::window(network, (run.start, run.stop)));
    Ok(Transient {
        output: OutputTimes::At(vec![run.stop]),
        record: RecordedNodes::Nodes(Vec::new()),
        watch,
        hottest_only: true,
        windows: windows.collect(),
        ..of
    })
}

fn capacity(network: &Network) -> f64 {
    network.node_ids().map(|id| network.capacity(id)).sum()
}

/// A part whose material is not known makes the whole unknown: a sum without it would look like a
/// light design.
fn mass(network: &Network) -> Option<f64> {
    network.whole_mass()
}
