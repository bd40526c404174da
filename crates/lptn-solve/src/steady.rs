//! Steady state: directly for linear networks, by Newton's method for others.
//!
//! A steady state is refined with heat flows from the links, not with the matrix. The diagonal of
//! the matrix has lost a small conductance next to a large one by rounding. The heat of a link
//! leaves one node as the same number that enters the other. The total balance is therefore exact,
//! and the refinement restores the lost digits.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::{FactorError, Pattern};
use lptn_network::{History, InputError, Network, NodeId, Positions, ReportId};

use crate::adiabatic::{self, Island};
use crate::conductances::Conductances;
use crate::error::SteadyError;
use crate::events::find_consistent;
use crate::limit;
use crate::newton::{Newton, SMALL};
use crate::newton_error::NewtonError;
use crate::runaway::Runaway;
use crate::several::{Others, same, start};
use crate::snapshot::Snapshot;
use crate::standing;
use crate::times::just_after;
use crate::transient::{FINE, MOVED, ROUGH, Way, rest};
use crate::unsolved::Unsolved;
use crate::window::ReportSeen;

/// The temperatures at which no node stores heat any more.
#[derive(Clone, Debug)]
pub struct SteadyState {
    /// Its temperatures and heat flows, with the time at which its inputs were read. A steady state
    /// lends its fields.
    pub state: Snapshot,
    /// Heat flow of each conductor in W, positive from `from` to `to`, as received by `to`.
    pub conductor_heat: Vec<f64>,
    /// Heat that each stream brings to its two ends together in W, in the order of the conductors.
    pub stream_heat: Vec<f64>,
    /// The nodes without a path to a boundary: their temperatures follow from the energy at their
    /// start.
    pub adiabatic: Vec<NodeId>,
    /// Knowledge of other steady states with the same inputs.
    pub others: Others,
}

/// Largest difference of heat in and heat out of a steady state, relative to the total heat.
const BALANCE: f64 = 1e-9;

/// Outcome of a network from its start on.
enum Reached {
    /// It reaches this state.
    Rests(Box<SteadyState>),
    /// It becomes hotter without end.
    Runs(Runaway),
    /// The outcome is not known.
    Lost,
}

impl std::ops::Deref for SteadyState {
    type Target = Snapshot;

    fn deref(&self) -> &Snapshot {
        &self.state
    }
}

impl std::ops::Index<NodeId> for SteadyState {
    type Output = f64;

    /// The temperature of a node in K.
    ///
    /// # Panics
    /// For a node that the network does not have.
    fn index(&self, node: NodeId) -> &f64 {
        &self.temperatures[node.index()]
    }
}

impl SteadyState {
    /// The margin of each limit in SI units, positive while it is kept, zero if a temperature
    /// passes it by rounding only, NaN if it cannot be [judged](Network::is_judged); `t` in the
    /// limits is `time` in s, that of the steady state's inputs.
    ///
    /// # Errors
    /// [`InputError`] if a limit cannot be evaluated.
    pub fn limit_margins(&self, network: &Network, time: f64) -> Result<Vec<f64>, InputError> {
        let mut scope = self.evaluation(network);
        scope.set_time(time, time);
        limit::margins(network, &mut scope)
    }

    /// The reports that are numbers over time, while everything stays as it is here; NaN for those
    /// that then grow without end, and for those whose inputs change with time.
    ///
    /// # Errors
    /// [`InputError`] if a report cannot be evaluated.
    pub fn reports_over_time(&self, network: &Network) -> Result<Vec<ReportSeen>, InputError> {
        let mut scope = self.evaluation(network);
        let mut value = |id: ReportId| {
            let report = &network.reports()[id.index()];
            let moment = History::constant(network.report_value(id, &mut scope)?);
            let lasts = report.over_time.as_ref().is_some_and(|o| o.functional.is_lasting());
            match lasts && network.changing_inputs_of(&[&report.value]).is_empty() {
                true => network.report_over_time(id, &moment, &mut scope),
                false => Ok(f64::NAN),
            }
        };
        let one = |report| Ok(ReportSeen { report, value: value(report)?, open: 0.0, bound: None });
        network.reports_over_time().map(one).collect()
    }

    /// Solves `G T = q` with the inputs as they are at `time` in s. If something switches, it finds
    /// a state in which nothing has to, from the positions at the start on.
    ///
    /// Unless the form of the network excludes several steady states, the network is followed from
    /// its start, and the state is the one that it reaches. Others are searched for from hotter and
    /// colder temperatures: see [`SteadyState::others`]. If there are several the network is
    /// followed with less error.
    ///
    /// # Errors
    /// [`SteadyError`], in particular for nodes without a path to a boundary, and for networks that
    /// cycle.
    pub fn solve(system: &ThermalSystem, time: f64) -> Result<Self, SteadyError> {
        let first = Self::solve_within(system, time, ROUGH)?;
        if !matches!(first.others, Others::At(_) | Others::Unstable(_)) {
            return Ok(first);
        }
        match Self::solve_within(system, time, FINE) {
            Ok(second) if second.others != Others::NotKnown => Ok(second),
            Err(error @ SteadyError::Runaway { .. }) => Err(error),
            _ => Ok(first),
        }
    }

    /// The same as [`SteadyState::solve`], with the network followed from its start to one
    /// tolerance in K, which has to be positive: it goes where a run with this tolerance does.
    ///
    /// # Errors
    /// As [`SteadyState::solve`].
    pub fn solve_within(
        system: &ThermalSystem,
        time: f64,
        tolerance: f64,
    ) -> Result<Self, SteadyError> {
        let switches = system.network().has_events();
        let found = match switches {
            true => find_consistent(system, time),
            false => Self::with_positions(system, time, &Positions::default()),
        };
        let decided = match found {
            Err(SteadyError::NoBoundary { .. } | SteadyError::Input(_)) => true,
            // a state that rests at the start need not rest on the way
            Err(SteadyError::Cycles { .. }) => system.network().states().is_empty(),
            _ => false,
        };
        let unique = !switches && system.is_monotone();
        if decided || unique || system.states().is_empty() {
            return found;
        }
        match (found, Self::reached(system, time, tolerance)) {
            (found, Reached::Runs(away)) => {
                let elsewhere = found.map_or_else(
                    |_| elsewhere(system, time, |work| start(system, work)),
                    |found| Others::At(found.state.temperatures),
                );
                Err(away.error(system, elsewhere.stable()))
            }
            (Ok(found), Reached::Lost) => Ok(Self { others: Others::NotKnown, ..found }),
            (Err(error), Reached::Lost) => Err(error),
            (Ok(found), Reached::Rests(reached)) if !found.is_near(&reached) => {
                Ok(Self { others: Others::At(found.state.temperatures), ..*reached })
            }
            (_, Reached::Rests(reached)) => Ok(reached.searched(system)),
        }
    }

    /// The steady state that the network reaches from its start, if it could be followed there.
    fn reached(system: &ThermalSystem, time: f64, tolerance: f64) -> Reached {
        let rest = match rest(system, time, tolerance) {
            Way::Rests(rest) => rest,
            Way::Left(last) => {
                let away = Runaway::of(system, (time, &last.positions), &last.temperatures);
                return away.map_or(Reached::Lost, Reached::Runs);
            }
            Way::Lost => return Reached::Lost,
        };
        let found = Self::from_start(system, time, &rest.positions, Some(&rest.temperatures));
        let Ok(steady) = found else { return Reached::Lost };
        let unknowns = steady.unknowns(system);
        let moved =
            unknowns.iter().zip(&rest.temperatures).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if moved <= MOVED { Reached::Rests(Box::new(steady)) } else { Reached::Lost }
    }

    /// The same, with a search for others: if something switches or energy is kept there are others
    /// by design.
    fn searched(self, system: &ThermalSystem) -> Self {
        if !self.adiabatic.is_empty() {
            return self;
        }
        let others = elsewhere(system, self.time, |_| self.unknowns(system));
        Self { others, ..self }
    }

    /// Temperatures of the unknowns in K.
    fn unknowns(&self, system: &ThermalSystem) -> Vec<f64> {
        let mut unknowns = vec![0.0; system.unknowns().len()];
        system.unknown_temperatures(&self.temperatures, &mut unknowns);
        unknowns
    }

    /// True if it is the same state but for rounding.
    fn is_near(&self, other: &Self) -> bool {
        same(&self.temperatures, &other.temperatures)
    }

    /// The steady state with these positions, even if something has to switch there.
    ///
    /// # Errors
    /// As [`SteadyState::solve`].
    pub(crate) fn with_positions(
        system: &ThermalSystem,
        time: f64,
        positions: &Positions,
    ) -> Result<Self, SteadyError> {
        Self::from_start(system, time, positions, None)
    }

    /// The same, with a search from these temperatures of the unknowns in K instead of those at the
    /// start.
    fn from_start(
        system: &ThermalSystem,
        time: f64,
        positions: &Positions,
        start: Option<&[f64]>,
    ) -> Result<Self, SteadyError> {
        let network = system.network();
        let mut work = system.workspace();
        if network.has_events() {
            work.set_positions(positions);
        }
        system.read_inputs(&mut work, time, just_after(time))?;
        let islands = Island::all_of(system);
        let direct = system.is_linear() && islands.is_empty() && network.states().is_empty();
        let unknowns = if direct {
            states(system, &work).map_err(SteadyError::Factorization)?
        } else {
            balanced(system, &mut work, &islands, start)?
        };
        system.recover(&mut work, &unknowns);
        let mut steady = Self::from_workspace(system, &mut work, &unknowns, time)?;
        steady.adiabatic = islands.into_iter().flat_map(|island| island.nodes).collect();
        let rest = rounding(system, &steady) + unsettled(system, &mut work, &unknowns)?;
        if steady.imbalance().abs() > BALANCE * steady.turned_over() + rest {
            return Err(SteadyError::Unbalanced {
                residual: steady.imbalance() / steady.turned_over(),
            });
        }
        check_absolute(network, &steady.temperatures)?;
        Ok(steady)
    }

    fn from_workspace(
        system: &ThermalSystem,
        work: &mut Workspace,
        unknowns: &[f64],
        time: f64,
    ) -> Result<Self, InputError> {
        let mut stream_heat = vec![0.0; system.streams().len()];
        system.stream_heat(work, &mut stream_heat)?;
        let state = Snapshot::of_workspace(system, work, unknowns, (time, true))?;
        Ok(Self {
            conductor_heat: state.received.iter().map(|[_, to]| *to).collect(),
            state,
            stream_heat,
            adiabatic: Vec::new(),
            others: Others::None,
        })
    }

    /// Heat of all sources, boundaries and streams in W: zero but for rounding.
    pub fn imbalance(&self) -> f64 {
        self.source_heat.iter().chain(&self.boundary_heat).chain(&self.stream_heat).sum()
    }

    /// The sum of the absolute heat of every source, boundary and conductor in W.
    pub fn turned_over(&self) -> f64 {
        let all = self.source_heat.iter().chain(&self.boundary_heat).chain(&self.conductor_heat);
        all.map(|q| q.abs()).sum()
    }
}

/// Result of a search around these unknowns, with the inputs at `time` in s; if something switches
/// there are several steady states by design.
fn elsewhere(
    system: &ThermalSystem,
    time: f64,
    around: impl FnOnce(&Workspace) -> Vec<f64>,
) -> Others {
    let mut work = system.workspace();
    let inputs = system.read_inputs(&mut work, time, just_after(time));
    if system.network().has_events() || inputs.is_err() {
        return Others::None;
    }
    let around = around(&work);
    Others::search(system, &mut work, &around)
}

/// Effect of the last digit of the temperatures on the balance in W: a network at one temperature
/// carries heat of this size and nothing else.
fn rounding(system: &ThermalSystem, steady: &SteadyState) -> f64 {
    let all = steady.temperatures.iter().chain(&steady.boundary_temperatures);
    4.0 * f64::EPSILON * system.boundary_conductance() * all.copied().fold(0.0, f64::max)
}

/// The heat in W that the last corrections of Newton's method leave in the balances: if nothing
/// heats a nonlinear network, it is all the heat there is.
fn unsettled(
    system: &ThermalSystem,
    work: &mut Workspace,
    unknowns: &[f64],
) -> Result<f64, InputError> {
    if system.is_linear() {
        return Ok(0.0);
    }
    let mut values = vec![0.0; system.pattern().entries()];
    system.jacobian_at(work, unknowns, JacobianForm::Exact, &mut values)?;
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    // heat out of the network altogether for 1 K more of one unknown
    let out = |i| values[pattern.column(i)].iter().sum::<f64>().abs();
    Ok(SMALL * (0..unknowns.len()).map(out).sum::<f64>())
}

fn check_absolute(network: &Network, temperatures: &[f64]) -> Result<(), SteadyError> {
    match network.first_below_zero(temperatures) {
        Some(i) => Err(SteadyError::BelowAbsoluteZero {
            name: network.nodes()[i].name.clone(),
            temperature: temperatures[i],
        }),
        None => Ok(()),
    }
}

/// Temperatures of all unknowns of a network that is not linear or that keeps energy, from those at
/// the start.
fn balanced(
    system: &ThermalSystem,
    work: &mut Workspace,
    islands: &[Island],
    from: Option<&[f64]>,
) -> Result<Vec<f64>, SteadyError> {
    let mut temperatures = from.map_or_else(|| start(system, work), <[f64]>::to_vec);
    if islands.is_empty() {
        let mut free = standing::free(system, work, &temperatures)?;
        let unsolved = |error| SteadyError::Unsolved(Unsolved::new(system, error));
        let (start, mut unread) = (temperatures.clone(), None);
        loop {
            let mut newton = Newton::new(system, free.clone()).map_err(unsolved)?;
            match stable(&mut newton, work, &mut temperatures) {
                Ok(()) => break,
                Err(NewtonError::Singular { unknown })
                    if standing::is_unread(system, work, &start, unknown)? =>
                {
                    free.retain(|other| *other != unknown);
                    temperatures.copy_from_slice(&start);
                    unread.get_or_insert(NewtonError::Singular { unknown });
                }
                Err(error) => return Err(unsolved(error)),
            }
        }
        standing::still(system, work, &temperatures, &free)?;
        // it rests, but at a value that the way there decides
        if let Some(error) = unread {
            return Err(unsolved(error));
        }
    } else {
        adiabatic::solve(system, work, islands, &mut temperatures)?;
    }
    Ok(temperatures)
}

/// Newton's method may find an unstable state; then the network is followed from its start.
fn stable(
    newton: &mut Newton<'_>,
    work: &mut Workspace,
    temperatures: &mut [f64],
) -> Result<(), NewtonError> {
    let start = temperatures.to_vec();
    newton.solve(work, temperatures)?;
    let Some(unknown) = newton.unstable(work, temperatures)? else { return Ok(()) };
    let swings = newton.swings(work, temperatures)?;
    temperatures.copy_from_slice(&start);
    let settled = newton.settle(work, temperatures);
    match settled.and_then(|()| newton.unstable(work, temperatures)) {
        Ok(None) => Ok(()),
        _ => Err(NewtonError::Unstable { unknown, swings }),
    }
}

/// Temperatures of the states, solved for as a rise over one boundary.
fn states(system: &ThermalSystem, work: &Workspace) -> Result<Vec<f64>, FactorError> {
    let start = system.boundary_temperatures(work).first().copied().unwrap_or(0.0);
    Conductances::new(system)?.states(work, start, Conductances::REFINEMENTS)
}
