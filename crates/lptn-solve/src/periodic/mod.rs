//! The periodic state of a repeating cycle, by shooting: the start of a cycle that is its end as
//! well.
//!
//! Coarse cycles come first. The stated error is the residual over the share that a cycle forgets.
//! A switch in one cycle has to occur in the next before the two are used together.

mod cycle;
mod error;
mod memory;
mod proof;
mod search;
mod secants;

use lptn_assembly::ThermalSystem;

use crate::adiabatic::Island;
use crate::certify::Uncertified;
use crate::exact::ExactCycle;
use crate::pipe;
use crate::settings::{Proceed, Progress, Transient};
use crate::solution::Solution;
use crate::state::State;
use cycle::{Cycles, Observer};
pub use error::PeriodicError;
use search::{Found, Search};

/// Method by which a periodic state was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleMethod {
    /// In closed form, mode by mode: a linear network.
    Modes,
    /// By accelerated cycles.
    Shooting,
    /// Without a search: the network has no state.
    Stateless,
}

/// The periodic steady state of a network.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// The state at the start of the cycle.
    pub state: State,
    /// The cycle from there on, as the settings require.
    pub solution: Solution,
    /// The method that found it.
    pub method: CycleMethod,
    /// Cycles that were integrated, that of the solution included.
    pub cycles: usize,
    /// Steps of the integrator in all cycles.
    pub steps: u64,
    /// Evaluations of the heat flows in all cycles.
    pub flow_evaluations: u64,
    /// The largest difference in K between the start of the cycle and its end, as integrated, of
    /// the state variables (see [`State`]).
    pub residual: f64,
    /// The largest part of a disturbance that one cycle leaves over, from 0 to 1. For a network
    /// that is not linear it is an estimate: the larger of the value from the integrated cycles and
    /// that from the slowest time constant of its balances, at the start and in the middle of the
    /// cycle. `None` without states, or if nothing decays.
    pub multiplier: Option<f64>,
    /// Possible difference in K of the state from one that repeats itself exactly. By modes:
    /// rounding, and series instead of inputs. By shooting: residual and rounding over `1 -
    /// multiplier`, the sum over all later cycles if the slowest part of the network had all of the
    /// residual. The error of the integration, ten tolerances, comes on top.
    pub error: f64,
}

/// A multiplier above this shows an unstable state; one of a state that nothing brings back is 1,
/// to the errors of cycles.
const UNSTABLE: f64 = 1.01;

impl Periodic {
    /// The factor by which a cycle multiplies a disturbance, if the state is unstable.
    pub fn grows(&self) -> Option<f64> {
        self.multiplier.filter(|factor| *factor > UNSTABLE)
    }

    /// The periodic state of a network whose inputs repeat after `settings.stop - settings.start`,
    /// and the cycle from there on.
    ///
    /// A linear network of up to 2000 nodes is solved in closed form. Others are integrated cycle
    /// by cycle, coarsely at first. They start from the network's own start, which selects one of
    /// several periodic states. Each cycle begins where those before it make the next difference
    /// smallest; until the error is below ten tolerances, or the residual is and no longer shrinks.
    ///
    /// With [`Transient::certify`] the bounds of the solution are those on the distance from the
    /// periodic state itself.
    ///
    /// # Errors
    /// [`PeriodicError`].
    pub fn find(system: &ThermalSystem, settings: &Transient) -> Result<Self, PeriodicError> {
        Self::find_observed(system, settings, &mut |_| Proceed::Continue)
    }

    /// The same as [`Periodic::find`], with an observer that is called after every step of every
    /// cycle and may interrupt.
    ///
    /// # Errors
    /// As [`Periodic::find`].
    pub fn find_observed(
        system: &ThermalSystem,
        settings: &Transient,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Self, PeriodicError> {
        settings
            .check()
            .map_err(|e| PeriodicError::Cycle(crate::error::TransientError::Settings(e)))?;
        if let Some(name) = pipe::first(system) {
            return Err(PeriodicError::Pipe { name });
        }
        if let Some(name) = system.network().first_sampled() {
            return Err(PeriodicError::Sampled { name });
        }
        let (network, period) = (system.network(), settings.stop - settings.start);
        let repeats = network.check_period(settings.start, period)?;
        repeats.map_err(PeriodicError::NotPeriodic)?;
        let mut observer = |progress: Progress| observer(progress);
        let observer: &mut Observer<'_> = &mut observer;
        let mut cycles = Cycles::new(system, settings, observer);
        if system.states().is_empty() {
            let (_, mut solution) = cycles.record(Vec::new(), settings.tolerance)?;
            solution.certificate =
                settings.certify.then(|| Err(Uncertified::without_state(system)));
            return Ok(Self::stateless(solution));
        }
        check_balance(&mut cycles)?;
        let exact = if system.is_linear() && !network.has_events() {
            exact(system, settings)
        } else {
            None
        };
        let method = if exact.is_some() { CycleMethod::Modes } else { CycleMethod::Shooting };
        let found = match exact {
            Some((start, exact)) => by_modes(&mut cycles, start, (&exact, settings.tolerance))?,
            None => Search::new(&mut cycles, settings.tolerance).find(system.initial())?,
        };
        let found =
            if settings.certify { proof::proven(&mut cycles, (found, method))? } else { found };
        Ok(Self::of(found, method, &cycles))
    }

    fn of(found: Found, method: CycleMethod, cycles: &Cycles<'_>) -> Self {
        Self {
            residual: found.shot.residual(),
            state: State::of_carried(found.shot.start),
            solution: found.solution,
            method,
            cycles: cycles.count,
            steps: cycles.steps,
            flow_evaluations: cycles.flow_evaluations,
            multiplier: found.multiplier,
            error: found.error,
        }
    }

    fn stateless(solution: Solution) -> Self {
        Self {
            state: State::of_carried(Vec::new()),
            solution,
            method: CycleMethod::Stateless,
            cycles: 1,
            steps: 0,
            flow_evaluations: 0,
            residual: 0.0,
            multiplier: None,
            error: 0.0,
        }
    }
}

/// A linear network in closed form; `None` if it or its inputs exceed that method.
fn exact(system: &ThermalSystem, settings: &Transient) -> Option<(Vec<f64>, ExactCycle)> {
    let period = settings.stop - settings.start;
    let exact = ExactCycle::solve(system.network(), settings.start, period).ok()?;
    let start = State::of_temperatures(system, &exact.temperatures).ok()?;
    let usable = start.carried().iter().all(|y| y.is_finite());
    usable.then(|| (start.carried().to_vec(), exact))
}

/// Integrates the cycle from the state in closed form: its end shows whether both agree.
fn by_modes(
    cycles: &mut Cycles<'_>,
    start: Vec<f64>,
    (exact, tolerance): (&ExactCycle, f64),
) -> Result<Found, PeriodicError> {
    let (shot, solution) = cycles.record(start, tolerance)?;
    let forgets = exact.multiplier > 0.0;
    Ok(Found {
        shot,
        solution,
        multiplier: forgets.then_some(exact.multiplier),
        error: exact.error,
    })
}

/// Heat that a cycle leaves in nodes without an exit is real if it is this many times the residual
/// of the energy balance.
const REAL: f64 = 10.0;

/// Refuses nodes that lead to no boundary if a cycle changes their heat.
fn check_balance(cycles: &mut Cycles<'_>) -> Result<(), PeriodicError> {
    let islands = Island::all_of(cycles.system);
    if islands.is_empty() {
        return Ok(());
    }
    let solution = cycles.first()?;
    let ledger = solution.ledger();
    for Island { nodes, .. } in islands {
        let heat: f64 = nodes.iter().map(|id| ledger.warmed(cycles.system.network(), *id)).sum();
        if heat.abs() > REAL * ledger.bound * ledger.turned_over {
            let network = cycles.system.network();
            let names = nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
            return Err(PeriodicError::NoBalance { nodes, names, heat });
        }
    }
    Ok(())
}
