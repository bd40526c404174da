//! The sparse system `C dT/dt = q(t, T)` of a network.

use lptn_network::{ConductorId, End, InputError, Network, NodeId};

use crate::eliminate::{Elimination, Link, TooMany};
use crate::error::AssemblyError;
use crate::pattern::JacobianPattern;
use crate::workspace::Workspace;

/// A network as a system of ordinary differential equations in its nodes with capacity.
///
/// The states are the nodes with capacity, in the network's order. `flow` and `jacobian` read the same links,
/// and a link's heat leaves one end and enters the other as one number with two signs.
#[derive(Clone, Debug)]
pub struct ThermalSystem {
    network: Network,
    /// Node of each state.
    states: Vec<NodeId>,
    /// Capacity of each state in J/K.
    capacity: Vec<f64>,
    /// Links between states, by state number.
    links: Vec<Link>,
    /// Links from a state (`a`) to a vertex that is a boundary (`b`).
    ties: Vec<Link>,
    /// Links between two boundaries, by vertex: no state feels them, the ledger does.
    bridges: Vec<Link>,
    elimination: Elimination,
    pattern: JacobianPattern,
}

impl ThermalSystem {
    /// Assembles a network: structure, links and pattern, once.
    ///
    /// # Errors
    /// [`AssemblyError`] if a massless node has too many neighbours to be eliminated.
    pub fn assemble(network: &Network) -> Result<Self, AssemblyError> {
        let nodes = network.nodes().len();
        let massless: Vec<bool> = network.nodes().iter().map(|n| n.massless).collect();
        let (elimination, kept) =
            Elimination::new(all_links(network), &massless).map_err(|e| too_many(network, &e))?;
        let states: Vec<NodeId> = network.node_ids().filter(|id| !massless[id.index()]).collect();
        let mut state_of = vec![u32::MAX; nodes];
        (0..).zip(&states).for_each(|(state, id)| state_of[id.index()] = state);
        let (mut links, mut ties, mut bridges) = (Vec::new(), Vec::new(), Vec::new());
        for Link { a, b, g } in kept {
            match (state_of.get(a as usize), state_of.get(b as usize)) {
                (Some(&a), Some(&b)) => links.push(Link { a, b, g }),
                (Some(&a), None) => ties.push(Link { a, b, g }),
                _ => bridges.push(Link { a, b, g }),
            }
        }
        let pattern = JacobianPattern::new(states.len(), &links);
        let capacity = states.iter().map(|&id| network.capacity(id)).collect();
        Ok(Self { network: network.clone(), states, capacity, links, ties, bridges, elimination, pattern })
    }

    /// The network it was assembled from.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// The node of each state.
    pub fn states(&self) -> &[NodeId] {
        &self.states
    }

    /// Heat capacity of each state in J/K.
    pub fn capacity(&self) -> &[f64] {
        &self.capacity
    }

    /// Temperature of each state at the start in K.
    pub fn initial(&self) -> Vec<f64> {
        self.states.iter().map(|&id| self.network.initial(id)).collect()
    }

    /// The pattern of [`ThermalSystem::jacobian`].
    pub fn pattern(&self) -> &JacobianPattern {
        &self.pattern
    }

    /// A workspace for this system.
    pub fn workspace(&self) -> Workspace {
        Workspace::new(&self.network)
    }

    /// Reads the inputs at `time` \[s\], comparisons of `t` as they stand at `segment` \[s\].
    ///
    /// # Errors
    /// [`InputError`] naming the source or boundary whose value cannot be had.
    pub fn read_inputs(&self, work: &mut Workspace, time: f64, segment: f64) -> Result<(), InputError> {
        if !work.read(&self.network, time, segment)? {
            return Ok(());
        }
        work.heat.fill(0.0);
        for (source, power) in self.network.sources().iter().zip(&work.power) {
            work.heat[source.into.index()] += power;
        }
        self.elimination.distribute(&mut work.heat);
        Ok(())
    }

    /// Takes these heats into the nodes in W and these temperatures of the boundaries in K in place of the
    /// network's own inputs, until those are read again: the response to a heat that no source puts in.
    pub fn apply(&self, work: &mut Workspace, heat: &[f64], boundaries: &[f64]) {
        work.forget();
        work.heat.fill(0.0);
        work.heat[..heat.len()].copy_from_slice(heat);
        self.elimination.distribute(&mut work.heat);
        work.temperature[self.network.nodes().len()..].copy_from_slice(boundaries);
    }

    /// Writes the heat flow into each state in W, from the inputs last read and the temperatures `y` in K.
    pub fn flow(&self, work: &Workspace, y: &[f64], flow: &mut [f64]) {
        for (q, id) in flow.iter_mut().zip(&self.states) {
            *q = work.heat[id.index()];
        }
        for link in &self.links {
            let (a, b) = (link.a as usize, link.b as usize);
            let q = link.g * (y[a] - y[b]);
            flow[a] -= q;
            flow[b] += q;
        }
        for tie in &self.ties {
            flow[tie.a as usize] += tie.g * (work.temperature[tie.b as usize] - y[tie.a as usize]);
        }
    }

    /// Writes the derivative of [`ThermalSystem::flow`] by the states in W/K into the slots of the pattern.
    ///
    /// It is symmetric, and constant as long as the network is linear.
    pub fn jacobian(&self, values: &mut [f64]) {
        values.fill(0.0);
        for (k, link) in self.links.iter().enumerate() {
            self.pattern.link_slots(k).into_iter().for_each(|slot| values[slot] += link.g);
            values[self.pattern.diagonal_slot(link.a as usize)] -= link.g;
            values[self.pattern.diagonal_slot(link.b as usize)] -= link.g;
        }
        for tie in &self.ties {
            values[self.pattern.diagonal_slot(tie.a as usize)] -= tie.g;
        }
    }

    /// Fills the temperatures of all nodes from those of the states, massless nodes recovered exactly.
    pub fn recover(&self, work: &mut Workspace, y: &[f64]) {
        for (t, id) in y.iter().zip(&self.states) {
            work.temperature[id.index()] = *t;
        }
        if !self.elimination.is_empty() {
            self.elimination.recover(&work.heat, &mut work.temperature);
        }
    }

    /// Takes the temperatures of all nodes in K as they were recovered before.
    pub fn place(&self, work: &mut Workspace, nodes: &[f64]) {
        work.temperature[..nodes.len()].copy_from_slice(nodes);
    }

    /// Temperatures of all nodes in K, as last recovered.
    pub fn node_temperatures<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.temperature[..self.network.nodes().len()]
    }

    /// Temperatures of all boundaries in K, as last read.
    pub fn boundary_temperatures<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.temperature[self.network.nodes().len()..]
    }

    /// Heat of all sources in W, as last read.
    pub fn source_powers<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.power
    }

    /// Writes the heat that each boundary gives to the network in W, from the inputs last read and the
    /// temperatures `y` of the states in K.
    ///
    /// The sum runs over the same links as [`ThermalSystem::flow`], after the elimination: a boundary next to a
    /// massless node through a large conductance would otherwise be the difference of two temperatures that
    /// are equal to the last digit.
    pub fn boundary_heat(&self, work: &Workspace, y: &[f64], heat: &mut [f64]) {
        let nodes = self.network.nodes().len();
        for (q, share) in heat.iter_mut().zip(&work.heat[nodes..]) {
            *q = -share; // what massless nodes hand on to it
        }
        for tie in &self.ties {
            let boundary = tie.b as usize;
            heat[boundary - nodes] += tie.g * (work.temperature[boundary] - y[tie.a as usize]);
        }
        for bridge in &self.bridges {
            let (a, b) = (bridge.a as usize, bridge.b as usize);
            let q = bridge.g * (work.temperature[a] - work.temperature[b]);
            heat[a - nodes] += q;
            heat[b - nodes] -= q;
        }
    }

    /// The sum of all conductances that lead to a boundary, after the elimination, in W/K.
    pub fn boundary_conductance(&self) -> f64 {
        self.ties.iter().chain(&self.bridges).map(|link| link.g).sum()
    }

    /// Temperatures of the states in K among those of all nodes.
    pub fn state_temperatures(&self, nodes: &[f64], y: &mut [f64]) {
        y.iter_mut().zip(&self.states).for_each(|(t, id)| *t = nodes[id.index()]);
    }

    /// The heat flow of a conductor in W, positive from `from` to `to`, from inputs read and nodes recovered.
    pub fn conductor_heat(&self, work: &Workspace, id: ConductorId) -> f64 {
        let conductor = &self.network.conductors()[id.index()];
        let at = |end| work.temperature[vertex(&self.network, end) as usize];
        self.network.conductance(id) * (at(conductor.from) - at(conductor.to))
    }
}

fn vertex(network: &Network, end: End) -> u32 {
    let index = match end {
        End::Node(id) => id.index(),
        End::Boundary(id) => network.nodes().len() + id.index(),
    };
    u32::try_from(index).expect("ids are 32 bits wide")
}

fn all_links(network: &Network) -> Vec<Link> {
    let link = |(c, id): (&lptn_network::Conductor, _)| Link {
        a: vertex(network, c.from),
        b: vertex(network, c.to),
        g: network.conductance(id),
    };
    network.conductors().iter().zip(network.conductor_ids()).map(link).collect()
}

fn too_many(network: &Network, error: &TooMany) -> AssemblyError {
    let ids: Vec<NodeId> = network.node_ids().collect();
    let node = ids[error.vertex as usize];
    let name = network.nodes()[node.index()].name.clone();
    AssemblyError::TooManyNeighbours { node, name, neighbours: error.neighbours }
}
