//! Nodes without a path to a boundary: they keep their energy, which determines where they come to
//! rest.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{ConductorFlow, End, Network, NodeId};

use crate::error::SteadyError;
use crate::newton::Newton;
use crate::newton_error::NewtonError;
use crate::unsolved::Unsolved;

/// Most rounds that restore the energy of every island at the start; a linear network takes two.
const ROUNDS: usize = 250;

/// Rounds after which the interval that contains the solution is halved each time.
const QUICK: usize = 40;

/// Remaining error, in K of a uniform rise.
const REST: f64 = 1e-10;

/// Largest imbalance of the heat into an island, relative to the heat of its sources.
const BALANCED: f64 = 1e-12;

/// A set of connected nodes that keeps its energy.
pub(crate) struct Island {
    pub(crate) nodes: Vec<NodeId>,
    /// The unknown that is fixed while the others are solved for.
    pinned: usize,
}

impl Island {
    /// The islands of a system that neither a source that depends on temperatures nor a stream
    /// reaches, but for constant streams that go round and round, and whose mass does not change.
    pub(crate) fn all_of(system: &ThermalSystem) -> Vec<Self> {
        let exchanges = exchanges(system.network());
        let fixed = |id: NodeId| system.network().capacity_of_states(id).is_none();
        let keeps =
            |nodes: &Vec<NodeId>| nodes.iter().all(|&id| !exchanges[id.index()] && fixed(id));
        let islands = system.network().ungrounded().into_iter().filter(keeps);
        islands.filter_map(|nodes| Self::new(system, nodes)).collect()
    }

    fn new(system: &ThermalSystem, nodes: Vec<NodeId>) -> Option<Self> {
        let pinned = system.states().iter().position(|id| nodes.binary_search(id).is_ok())?;
        Some(Self { nodes, pinned })
    }

    /// Refuses an island that is heated or cooled without end.
    fn check(&self, system: &ThermalSystem, work: &Workspace) -> Result<(), SteadyError> {
        let network = system.network();
        let (mut heat, mut size) = (0.0, 0.0);
        for (source, power) in network.sources().iter().zip(system.source_powers(work)) {
            for (node, share) in &source.into {
                if self.nodes.binary_search(node).is_ok() {
                    heat += share * power;
                    size += (share * power).abs();
                }
            }
        }
        if heat.abs() <= BALANCED * size {
            return Ok(());
        }
        let names: Vec<String> =
            self.nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
        Err(SteadyError::NoBoundary { nodes: self.nodes.clone(), names, heat })
    }

    /// The states in it, with their places among the unknowns.
    fn states(&self, system: &ThermalSystem) -> Vec<(usize, NodeId)> {
        let inside = |(_, id): &(usize, NodeId)| self.nodes.binary_search(id).is_ok();
        system.states().iter().copied().enumerate().filter(inside).collect()
    }

    /// The energy over that at the start in J, and the capacity in J/K; infinite with the sign of
    /// the side on which a node leaves the temperatures for which its capacity is known.
    fn energy(&self, system: &ThermalSystem, temperatures: &[f64]) -> (f64, f64) {
        let network = system.network();
        let stored = self.states(system).into_iter().map(|(i, id)| {
            let (t, constant) = (temperatures[i], network.capacity(id));
            match network.enthalpy(id) {
                None => (constant * (t - network.initial(id)), constant),
                Some(curve) => match (curve.heat(t), curve.capacity(t)) {
                    (Some(heat), Some(capacity)) => (heat, capacity),
                    _ if t < curve.range().0 => (f64::NEG_INFINITY, constant),
                    _ => (f64::INFINITY, constant),
                },
            }
        });
        stored.fold((0.0, 0.0), |(heat, capacity), (h, c)| (heat + h, capacity + c))
    }

    /// The first node that is outside the temperatures for which its capacity is known.
    fn outside(&self, system: &ThermalSystem, temperatures: &[f64]) -> Option<NewtonError> {
        let network = system.network();
        self.states(system).into_iter().find_map(|(i, id)| {
            let curve =
                network.enthalpy(id).filter(|curve| curve.heat(temperatures[i]).is_none())?;
            Some(NewtonError::Input(crate::unfold::outside(system, i, curve)))
        })
    }

    /// Moves all its nodes by the same rise in K, but none below a tenth of its temperature.
    fn shift(&self, system: &ThermalSystem, temperatures: &mut [f64], rise: f64) {
        let inside = system.unknowns().iter().zip(temperatures);
        let inside = inside.filter(|(id, _)| self.nodes.binary_search(id).is_ok());
        inside.for_each(|(_, t)| *t = (*t + rise).max(0.1 * *t));
    }
}

/// The interval of the fixed temperature, in K.
#[derive(Clone, Copy)]
struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// The next temperature in K: where the capacity points, if that is inside and fast enough.
    fn next(&mut self, held: f64, (heat, capacity): (f64, f64), round: usize) -> f64 {
        if heat > 0.0 {
            self.high = self.high.min(held)
        } else {
            self.low = self.low.max(held)
        }
        let next = held - heat / capacity;
        let half = if self.high.is_finite() { 0.5 * (self.low + self.high) } else { 2.0 * held };
        if round < QUICK && next > self.low && next < self.high { next } else { half }
    }

    /// True if nothing is left of it: the heat content jumps there, as when a node melts.
    fn is_closed(self) -> bool {
        self.high.is_finite() && self.high - self.low <= 4.0 * f64::EPSILON * self.high
    }
}

/// True for each node whose heat flows the energy of its island does not account for.
fn exchanges(network: &Network) -> Vec<bool> {
    let mut exchanges = vec![false; network.nodes().len()];
    // flows into and out of each node, in W/K
    let mut flows = vec![(0.0, 0.0); network.nodes().len()];
    for (conductor, id) in network.conductors().iter().zip(network.conductor_ids()) {
        if !conductor.law.is_stream() {
            continue;
        }
        let (End::Node(from), End::Node(to)) = (conductor.from, conductor.to) else { continue };
        match network.flow(id) {
            ConductorFlow::Stream(rate) => {
                let (from, to) = if rate < 0.0 { (to, from) } else { (from, to) };
                flows[from.index()].1 += rate.abs();
                flows[to.index()].0 += rate.abs();
            }
            _ => [from, to].into_iter().for_each(|node| exchanges[node.index()] = true),
        }
    }
    for (exchanges, (inward, outward)) in exchanges.iter_mut().zip(flows) {
        *exchanges |= f64::abs(inward - outward) > BALANCED * (inward + outward);
    }
    for (source, id) in network.sources().iter().zip(network.source_ids()) {
        if !network.source_variables(id).is_empty() {
            source.into.iter().for_each(|(node, _)| exchanges[node.index()] = true);
        }
    }
    exchanges
}

/// Solves the balances of a system with islands, whose energies are those of the start.
pub(crate) fn solve(
    system: &ThermalSystem,
    work: &mut Workspace,
    islands: &[Island],
    temperatures: &mut [f64],
) -> Result<(), SteadyError> {
    islands.iter().try_for_each(|island| island.check(system, work))?;
    search(system, work, islands, temperatures)
        .map_err(|error| SteadyError::Unsolved(Unsolved::new(system, error)))
}

fn search(
    system: &ThermalSystem,
    work: &mut Workspace,
    islands: &[Island],
    temperatures: &mut [f64],
) -> Result<(), NewtonError> {
    let pinned: Vec<usize> = islands.iter().map(|island| island.pinned).collect();
    let free: Vec<usize> = (0..temperatures.len()).filter(|i| !pinned.contains(i)).collect();
    let mut newton = if free.is_empty() { None } else { Some(Newton::new(system, free)?) };
    let mut intervals = vec![Interval { low: 0.0, high: f64::INFINITY }; islands.len()];
    let mut change = 0.0;
    for round in 0..ROUNDS {
        if let Some(newton) = &mut newton {
            newton.solve(work, temperatures)?;
        }
        change = 0.0;
        for (island, interval) in islands.iter().zip(&mut intervals) {
            let energy = island.energy(system, temperatures);
            let held = temperatures[island.pinned];
            let rise = energy.0 / energy.1;
            let next = interval.next(held, energy, round);
            let target = match (rise.abs() <= REST, interval.is_closed()) {
                (true, _) => held - rise,
                (false, true) => held,
                (false, false) => next,
            };
            change = f64::max(change, if rise.abs() <= REST { 0.0 } else { (target - held).abs() });
            island.shift(system, temperatures, target - held);
        }
        if change <= 0.0 {
            let outside = islands.iter().find_map(|island| island.outside(system, temperatures));
            return match (outside, newton.map(|mut newton| newton.unstable(work, temperatures))) {
                (Some(outside), _) => Err(outside),
                (None, Some(Ok(Some(unknown)))) => {
                    Err(NewtonError::Unstable { unknown, swings: false })
                }
                _ => Ok(()),
            };
        }
    }
    let unknown = islands.first().map_or(0, |island| island.pinned);
    Err(NewtonError::Stalled { unknown, change })
}
