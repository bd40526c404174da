//! A network in steady state, seen from one node.

use lptn_assembly::ThermalSystem;
use lptn_network::{ConductorFlow, End, InputError, Item, Network, NodeId};

use crate::error::ReduceError;
use crate::rises::{Rises, Way};

/// Share of the largest rise below which the rise of the port is none.
const HELD: f64 = 1e-9;

/// The Norton equivalent of a linear network at a port: `q = Q_N - (T - T_ref) / R_eq`, where q is
/// the heat in W that the network gives out of the port if something outside fixes the port at T.
///
/// `R_eq = (G^-1)_pp` is the rise of the port for 1 W into it. By reciprocity (G is symmetric) the
/// response `R_kp` of node k to heat at the port is that of the port to heat at k, so one solution
/// gives the weights of all sources, `R_pk / R_pp`, and of all boundaries: the share of the 1 W
/// that each takes. A stream that goes on to another node acts downstream only: G is then not
/// symmetric, and the weights come from a solution with its transpose, equally exact. Source: L. O.
/// Chua, C. A. Desoer, E. S. Kuh, Linear and Nonlinear Circuits (1987), chapters 5 and 13.
#[derive(Clone, Debug, PartialEq)]
pub struct NortonEquivalent {
    /// The node seen from outside.
    pub port: NodeId,
    /// `R_eq` in K/W, positive.
    pub resistance: f64,
    /// `R_kp` in K/W: rise of every node for 1 W into the port, between 0 and `R_eq`; 0 for nodes
    /// that no heat from the port reaches.
    pub response: Vec<f64>,
    /// `R_pk` in K/W: rise of the port for 1 W into every node; the same as `response` if no stream
    /// goes on to another node.
    pub influence: Vec<f64>,
    /// Weight of every boundary in `T_ref`: not negative, sum 1.
    pub boundary_weights: Vec<f64>,
    /// Weight of every source in `Q_N`: `R_pk / R_pp` of its node, between 0 and 1.
    pub source_weights: Vec<f64>,
}

/// The inputs of a network, seen from its port at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// The port's steady temperature with all sources off, in K.
    pub reference: f64,
    /// `Q_N` in W: the heat at the port with the same effect there as all sources.
    pub heat: f64,
}

/// The node of this name, for use as a port.
///
/// # Errors
/// [`ReduceError::UnknownPort`], with a suggestion, and [`ReduceError::BoundaryPort`].
pub fn port(network: &Network, name: &str) -> Result<NodeId, ReduceError> {
    match network.item(name) {
        Ok(Item::Boundary(_)) => Err(ReduceError::BoundaryPort { name: name.to_owned() }),
        _ => network.node(name).map_err(ReduceError::UnknownPort),
    }
}

/// Rise of node `to` in K for 1 W into node `from`, in K/W; the same with the two exchanged if no
/// stream goes on from one node to another.
///
/// # Errors
/// [`ReduceError::NoGround`] and [`ReduceError::Factorization`].
pub fn transfer_resistance(
    system: &ThermalSystem,
    from: NodeId,
    to: NodeId,
) -> Result<f64, ReduceError> {
    Ok(NortonEquivalent::new(system, from)?.response[to.index()])
}

/// Checks that the rises of all nodes for 1 W into the port, in K, include one of the port.
///
/// # Errors
/// [`ReduceError::Held`]
pub(crate) fn warms(network: &Network, port: NodeId, rises: &[f64]) -> Result<(), ReduceError> {
    let largest = rises.iter().fold(0.0, |most: f64, rise| most.max(rise.abs()));
    match rises[port.index()].abs() > HELD * largest {
        true => Ok(()),
        false => Err(ReduceError::Held { name: network.nodes()[port.index()].name.clone() }),
    }
}

impl NortonEquivalent {
    /// Reduces `system` at `port`.
    ///
    /// The resistance is right to 1e-12 for conductances that spread over three decades (tested).
    ///
    /// # Errors
    /// [`ReduceError::NoGround`] if no path leads from the port to a boundary,
    /// [`ReduceError::Held`], [`ReduceError::Factorization`].
    pub fn new(system: &ThermalSystem, port: NodeId) -> Result<Self, ReduceError> {
        grounded(system.network(), port)?;
        Self::with(system, port, &mut Rises::new(system)?)
    }

    pub(crate) fn with(
        system: &ThermalSystem,
        port: NodeId,
        rises: &mut Rises<'_>,
    ) -> Result<Self, ReduceError> {
        let network = system.network();
        let mut heat = vec![0.0; network.nodes().len()];
        heat[port.index()] = 1.0;
        let mut solved = |way| -> Result<Vec<f64>, ReduceError> {
            let rise = rises.of_nodes(&heat, way)?;
            let is_reached = reached(network, port, way);
            Ok(rise.iter().zip(is_reached).map(|(&r, is)| if is { r } else { 0.0 }).collect())
        };
        let response = solved(Way::Forth)?;
        let influence = if system.is_linear() { response.clone() } else { solved(Way::Back)? };
        let resistance = response[port.index()];
        warms(network, port, &response)?;
        let weight = |source: &lptn_network::Source| {
            source.into.iter().map(|(node, share)| share * influence[node.index()]).sum::<f64>()
                / resistance
        };
        let source_weights = network.sources().iter().map(weight).collect();
        let weights = rises.boundary_weights(port, &influence)?;
        let boundary_weights = weights.iter().map(|w| w.max(0.0)).collect();
        Ok(Self { port, resistance, response, influence, boundary_weights, source_weights })
    }

    /// `T_ref` in K from the temperatures of all boundaries in K.
    pub fn reference(&self, boundaries: &[f64]) -> f64 {
        // as differences: a network at one temperature has exactly that as its reference
        let base = boundaries.first().copied().unwrap_or(f64::NAN);
        base + boundaries
            .iter()
            .zip(&self.boundary_weights)
            .map(|(t, w)| w * (t - base))
            .sum::<f64>()
    }

    /// `Q_N` in W from the heat of all sources in W.
    pub fn heat(&self, sources: &[f64]) -> f64 {
        sources.iter().zip(&self.source_weights).map(|(p, w)| w * p).sum()
    }

    /// The inputs at `time`, in s.
    ///
    /// # Errors
    /// [`InputError`] if a source or boundary has no value.
    pub fn inputs(&self, system: &ThermalSystem, time: f64) -> Result<Inputs, InputError> {
        let mut work = system.workspace();
        system.read_inputs(&mut work, time, time)?;
        Ok(Inputs {
            reference: self.reference(system.boundary_temperatures(&work)),
            heat: self.heat(system.source_powers(&work)),
        })
    }

    /// Sum of the capacities of all nodes that heat from the port reaches, in J/K.
    pub fn capacity_sum(&self, network: &Network) -> f64 {
        let is_reached = reached(network, self.port, Way::Forth);
        let thermal = network.thermal_nodes().filter(|id| is_reached[id.index()]);
        thermal.map(|id| network.capacity(id)).sum()
    }

    /// `m1 = sum of R_pk C_k R_kp` in K s/W: the first moment of the impulse response at the port
    /// (W. C. Elmore, J. Appl. Phys. 19 (1948) 55; without streams the sum over squares).
    pub fn first_moment(&self, network: &Network) -> f64 {
        let rises = self.response.iter().zip(&self.influence);
        network.node_ids().zip(rises).map(|(id, (r, back))| network.capacity(id) * r * back).sum()
    }
}

/// The port must lead to a boundary. Nodes without a path over nodes to it need not: they do not
/// affect it.
pub(crate) fn grounded(network: &Network, port: NodeId) -> Result<(), ReduceError> {
    let Some(loose) = network.ungrounded().into_iter().find(|island| island.contains(&port)) else {
        return Ok(());
    };
    let names = loose.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
    Err(ReduceError::NoGround { names })
}

/// Marks the nodes that heat from the port reaches over nodes, or from which heat reaches the port.
fn reached(network: &Network, port: NodeId, way: Way) -> Vec<bool> {
    let mut next_to: Vec<Vec<usize>> = vec![Vec::new(); network.nodes().len()];
    for (conductor, id) in network.conductors().iter().zip(network.conductor_ids()) {
        if let (End::Node(a), End::Node(b)) = (conductor.from, conductor.to) {
            let (a, b) = (a.index(), b.index());
            let (forth, back) = match network.flow(id) {
                ConductorFlow::Stream(mcp) => (mcp > 0.0, mcp < 0.0),
                _ => (true, true),
            };
            let [forth, back] = if way == Way::Forth { [forth, back] } else { [back, forth] };
            forth.then(|| next_to[a].push(b));
            back.then(|| next_to[b].push(a));
        }
    }
    let mut reached = vec![false; next_to.len()];
    reached[port.index()] = true;
    let mut open = vec![port.index()];
    while let Some(node) = open.pop() {
        for &next in &next_to[node] {
            if !std::mem::replace(&mut reached[next], true) {
                open.push(next);
            }
        }
    }
    reached
}
