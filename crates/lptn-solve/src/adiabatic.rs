//! Nodes that no path leads from to a boundary: they keep their energy, which tells where they come to rest.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{ConductorKind, End, Network, NodeId};

use crate::error::SteadyError;
use crate::newton::{Newton, NewtonError};
use crate::unsolved::Unsolved;

/// Rounds of bringing the energy of every island to what it was at the start; a linear network takes two.
const ROUNDS: usize = 60;

/// What remains, in K of a uniform rise.
const REST: f64 = 1e-10;

/// How far the heat into an island may be from zero, relative to the heat of its sources.
const BALANCED: f64 = 1e-12;

/// A set of connected nodes that keeps its energy.
pub(crate) struct Island {
    pub(crate) nodes: Vec<NodeId>,
    /// The unknown that is held while the others are solved for.
    pinned: usize,
    /// Sum of the capacities at the start in J/K.
    capacity: f64,
}

impl Island {
    /// The islands of a system that neither a stream nor a source that depends on temperatures reaches.
    pub(crate) fn all_of(system: &ThermalSystem) -> Vec<Self> {
        let network = system.network();
        let keeps = |nodes: &Vec<NodeId>| !nodes.iter().any(|&id| exchanges(network, id));
        let islands = network.ungrounded().into_iter().filter(keeps);
        islands.filter_map(|nodes| Self::new(system, nodes)).collect()
    }

    fn new(system: &ThermalSystem, nodes: Vec<NodeId>) -> Option<Self> {
        let network = system.network();
        let pinned = system.states().iter().position(|id| nodes.binary_search(id).is_ok())?;
        let capacity = nodes.iter().map(|&id| network.capacity(id)).sum();
        Some(Self { nodes, pinned, capacity })
    }

    /// Refuses an island that is heated for ever.
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

    /// The energy over that at the start in J.
    fn energy(&self, system: &ThermalSystem, temperatures: &[f64]) -> f64 {
        let network = system.network();
        let states = system.states().iter().zip(temperatures);
        let inside = states.filter(|(id, _)| self.nodes.binary_search(id).is_ok());
        let stored = inside.map(|(&id, &t)| match network.enthalpy(id) {
            Some(curve) => curve.heat(t).unwrap_or(f64::NAN),
            None => network.capacity(id) * (t - network.initial(id)),
        });
        stored.sum()
    }
}

/// Whether a node takes part in anything that its energy does not account for.
fn exchanges(network: &Network, id: NodeId) -> bool {
    let end = End::Node(id);
    let stream = network
        .conductors()
        .iter()
        .any(|c| c.kind == ConductorKind::Advection && (c.from == end || c.to == end));
    let heated = network.sources().iter().zip(network.source_ids()).any(|(source, k)| {
        !network.source_variables(k).is_empty() && source.into.iter().any(|(node, _)| *node == id)
    });
    stream || heated
}

/// Solves the balances of a system with islands, whose energies are those of the start.
pub(crate) fn solve(
    system: &ThermalSystem,
    work: &mut Workspace,
    islands: &[Island],
    temperatures: &mut [f64],
) -> Result<(), SteadyError> {
    let unsolved = |error| SteadyError::Unsolved(Unsolved::new(system, error));
    islands.iter().try_for_each(|island| island.check(system, work))?;
    let pinned: Vec<usize> = islands.iter().map(|island| island.pinned).collect();
    let free: Vec<usize> = (0..temperatures.len()).filter(|i| !pinned.contains(i)).collect();
    let mut newton = if free.is_empty() { None } else { Some(Newton::new(system, free).map_err(unsolved)?) };
    let mut rise = f64::INFINITY;
    for _ in 0..ROUNDS {
        if let Some(newton) = &mut newton {
            newton.solve(work, temperatures).map_err(unsolved)?;
        }
        rise = 0.0;
        for island in islands {
            let missing = island.energy(system, temperatures) / island.capacity;
            rise = f64::max(rise, missing.abs());
            let inside = system.unknowns().iter().zip(&mut *temperatures);
            inside
                .filter(|(id, _)| island.nodes.binary_search(id).is_ok())
                .for_each(|(_, t)| *t = (*t - missing).max(0.1 * *t));
        }
        if rise <= REST {
            return Ok(());
        }
    }
    let unknown = islands.first().map_or(0, |island| island.pinned);
    Err(unsolved(NewtonError::Stalled { unknown, change: rise }))
}
