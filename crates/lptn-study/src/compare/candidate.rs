//! One candidate.

use lptn_assembly::ThermalSystem;
use lptn_netlist::RunSettings;
use lptn_network::{InputError, LimitSeverity, Network};
use lptn_solve::{
    Beyond, NodeSummary, Others, OutOfRange, OutputTimes, Proceed, Progress, RecordedNodes,
    RunStatus, Solution, SteadyError, SteadyState, Summary, Transient, TransientError, Unsolved,
    first_there,
};
use lptn_units::Class;

use crate::compare::limits::{self, LimitResult};

/// The highest temperature of a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The temperature in K.
    pub temperature: f64,
    /// The time in s at which it is first there; `None` where the candidate was not run.
    pub at: Option<f64>,
}

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
    /// For each boundary by name the heat it takes at the end as a share of all heat that leaves;
    /// 0 for one that gives heat. `None` where no heat leaves. Last, as `streams`, what streams
    /// carry away that no other stream brings.
    pub shares: Vec<(String, Option<f64>)>,
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
}

lptn_units::errors! {
/// Why a candidate has no results.
#[derive(Debug)]
pub enum CompareError {
    /// It is not run and has no steady state.
    Steady => SteadyError as Class::not_an_answer;
    /// Its run failed.
    Run => Box<TransientError>;
    /// A limit, source or boundary has no value.
    Input => InputError;
    /// The balances of its massless nodes have no solution at the start.
    Start => Unsolved as Class::of_numbers;
    /// Its books do not close: relative residual, and what is allowed.
    Ledger(residual: f64, bound: f64) = "run::ledger",
        format!(
            "heat in, out and stored differ by {residual:.1e} of the heat turned over, more than \
             the {bound:.1e} allowed"
        ), class Class::Numbers;
    /// Its run was interrupted at this time in s: peaks and limits of a part would read like those
    /// of the whole.
    Interrupted(time: f64) = "run::interrupted", format!("the run was interrupted at {time} s"),
        class Class::Interrupted;
}
}

impl CompareError {
    /// The input that has no value, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(input) => Some(input),
            Self::Steady(error) => error.input(),
            Self::Run(error) => error.input(),
            Self::Start(unsolved) => unsolved.input(),
            _ => None,
        }
    }
}

impl Candidate {
    /// Runs a candidate; without settings of a run it is compared in steady state.
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
            None => Self::in_steady_state(system),
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

    fn in_steady_state(system: &ThermalSystem) -> Result<Self, CompareError> {
        let network = system.network();
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
            shares: shares(network, &steady.boundary_heat, &steady.stream_heat),
            capacity: capacity(network),
            mass: mass(network),
            beyond: Beyond::of_steady(network, &steady),
            out_of_range: OutOfRange::of_steady(network, &steady).unwrap_or_default(),
            several: Some(steady).filter(is_doubtful),
        })
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
        let ledger = solution.ledger();
        if let Some(residual) = ledger.relative_residual().filter(|_| !ledger.closes()) {
            return Err(CompareError::Ledger(residual.abs(), ledger.bound));
        }
        let nodes = Summary::new(&solution, steady.as_ref()).nodes;
        let node = hottest(nodes.iter().map(|node| (node, node.peak.0))).map(|(node, _)| node);
        let (heat, streams) =
            heat_at_the_end(system, &solution, run).map_err(CompareError::Input)?;
        Ok(Self {
            hottest: node.map(|node| network.nodes()[node.node.index()].name.clone()),
            peak: node.map(|node| peak(node, run)),
            steady: node.and_then(|node| node.steady),
            time_to_95: node.and_then(|node| node.time_to_95),
            limits: limits::over_time(network, solution.limits()),
            shares: shares(network, &heat, &streams),
            capacity: capacity(network),
            mass: mass(network),
            beyond: Beyond::of_run(&solution),
            out_of_range: solution.out_of_range().to_vec(),
            several: steady.filter(is_doubtful),
        })
    }
}

fn is_doubtful(steady: &SteadyState) -> bool {
    steady.others != Others::None
}

/// The peak of a node; one that the tolerance cannot tell from the start or from the end is there.
fn peak(node: &NodeSummary, run: &RunSettings) -> Peak {
    let ends = [(node.start, run.start), (node.end, run.stop)];
    Peak { temperature: node.peak.0, at: Some(first_there(node.peak, ends, 10.0 * run.tolerance)) }
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
    Ok(Transient {
        output: OutputTimes::At(vec![run.stop]),
        record: RecordedNodes::Nodes(Vec::new()),
        watch,
        ..Transient::of(network, run)
    })
}

/// What has the largest value; of equals the first.
pub(crate) fn hottest<T>(mut of: impl Iterator<Item = (T, f64)>) -> Option<(T, f64)> {
    let first = of.next()?;
    Some(
        of.fold(first, |best, other| if other.1.total_cmp(&best.1).is_gt() { other } else { best }),
    )
}

fn capacity(network: &Network) -> f64 {
    network.node_ids().map(|id| network.capacity(id)).sum()
}

/// The name of what streams carry away, among those of boundaries.
const STREAMS: &str = "streams";

/// A part whose material is not known makes the whole unknown: a sum without it would look like a
/// light design.
fn mass(network: &Network) -> Option<f64> {
    let nodes = network.node_ids().filter(|id| network.capacity(*id) > 0.0);
    let masses: Vec<Option<f64>> = nodes.map(|id| network.mass(id)).collect();
    if masses.is_empty() { None } else { masses.into_iter().sum() }
}

/// Heat that each boundary gives and each stream brings at the stop, from the last temperatures of
/// the watched nodes.
fn heat_at_the_end(
    system: &ThermalSystem,
    solution: &Solution,
    run: &RunSettings,
) -> Result<(Vec<f64>, Vec<f64>), InputError> {
    let last: Vec<f64> = solution.watched().iter().map(lptn_solve::Watched::last).collect();
    let mut work = system.workspace();
    system.read_inputs(&mut work, run.stop, run.stop)?;
    system.place(&mut work, &last);
    let mut unknowns = vec![0.0; system.unknowns().len()];
    system.unknown_temperatures(&last, &mut unknowns);
    let mut heat = vec![0.0; system.network().boundaries().len()];
    system.boundary_heat(&mut work, &unknowns, &mut heat)?;
    let mut streams = vec![0.0; system.streams().len()];
    system.stream_heat(&mut work, &mut streams)?;
    Ok((heat, streams))
}

/// What each boundary takes of the heat that leaves, and what streams carry away together: one
/// hands on what another brings, so a closed circuit carries nothing away.
fn shares(network: &Network, given: &[f64], streams: &[f64]) -> Vec<(String, Option<f64>)> {
    let taken = |&given: &f64| (-given).max(0.0);
    let (brought, moved) =
        streams.iter().fold((0.0, 0.0), |(sum, moved), q| (sum + q, moved + q.abs()));
    let carried = if brought.abs() > 1e-9 * moved { taken(&brought) } else { 0.0 };
    let all: f64 = given.iter().map(taken).sum::<f64>() + carried;
    let share = |taken: f64| (all > 0.0).then(|| taken / all);
    let names = network.boundaries().iter().map(|boundary| boundary.name.clone());
    let open = (carried > 0.0).then(|| (STREAMS.to_owned(), share(carried)));
    names.zip(given.iter().map(|given| share(taken(given)))).chain(open).collect()
}
