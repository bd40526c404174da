//! Rises from heat alone: `G x = b` with every boundary at zero.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{ConductorFlow, Item, Network, NodeId};
use lptn_solve::Conductances;

use crate::error::ReduceError;
use crate::streams::{Streams, inflow};

/// Temperatures relative to boundaries that are all at zero.
pub(crate) struct Rises<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    solver: Solver<'a>,
    still: Vec<f64>,
}

enum Solver<'a> {
    Paths(Conductances<'a>),
    Streams(Box<Streams>),
}

/// The direction in which heat is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// The effect everywhere of heat here.
    Forth,
    /// The effect here of heat everywhere: the same if no stream goes on to another node.
    Back,
}

impl<'a> Rises<'a> {
    /// Factorises the conductances; heat may go in only where a path leads to a boundary.
    pub(crate) fn new(system: &'a ThermalSystem) -> Result<Self, ReduceError> {
        let network = system.network();
        if let Some(item) = first_variable(network) {
            return Err(ReduceError::NotLinear { name: network.name_of(item).into_owned() });
        }
        let solver = if system.is_linear() {
            Solver::Paths(Conductances::new(system)?)
        } else {
            Solver::Streams(Box::new(Streams::new(system)?))
        };
        let still = vec![0.0; network.boundaries().len()];
        Ok(Self { system, work: system.workspace(), solver, still })
    }

    /// True if heat acts both ways alike between two nodes, so that the modes are real and a step
    /// response is a sum of falling exponentials.
    pub(crate) fn is_symmetric(&self) -> bool {
        match &self.solver {
            Solver::Paths(_) => true,
            Solver::Streams(streams) => streams.symmetric && self.system.algebraic().is_empty(),
        }
    }

    /// Rise of every node in K for these heats into the nodes in W.
    pub(crate) fn of_nodes(&mut self, heat: &[f64], way: Way) -> Result<Vec<f64>, ReduceError> {
        self.system.apply(&mut self.work, heat, &self.still);
        self.solved(way)
    }

    /// Temperature of every node for the inputs in `work`.
    fn solved(&mut self, way: Way) -> Result<Vec<f64>, ReduceError> {
        let unknowns = match &mut self.solver {
            Solver::Paths(paths) => paths.states(&self.work, 0.0, Conductances::REFINEMENTS)?,
            Solver::Streams(streams) => {
                let b = inflow(self.system, &mut self.work).map_err(ReduceError::Input)?;
                streams.solve(&b, way == Way::Back)?
            }
        };
        self.system.recover(&mut self.work, &unknowns);
        Ok(self.system.node_temperatures(&self.work).to_vec())
    }

    /// Rise of every state in K for these heats into the states in W, refined once.
    pub(crate) fn of_states(&mut self, heat: &[f64]) -> Result<Vec<f64>, ReduceError> {
        let mut nodes = vec![0.0; self.system.network().nodes().len()];
        self.system.states().iter().zip(heat).for_each(|(id, q)| nodes[id.index()] = *q);
        self.system.apply(&mut self.work, &nodes, &self.still);
        match &mut self.solver {
            Solver::Paths(paths) => Ok(paths.states(&self.work, 0.0, 1)?),
            Solver::Streams(streams) => {
                let b = inflow(self.system, &mut self.work).map_err(ReduceError::Input)?;
                Ok(streams.solve(&b, false)?)
            }
        }
    }

    /// Temperature of every node in K for one boundary at 1 K, all others and all heats at zero.
    pub(crate) fn of_boundary(&mut self, boundary: usize) -> Result<Vec<f64>, ReduceError> {
        let mut temperatures = self.still.clone();
        temperatures[boundary] = 1.0;
        let none = vec![0.0; self.system.network().nodes().len()];
        self.system.apply(&mut self.work, &none, &temperatures);
        self.solved(Way::Forth)
    }

    /// The weight of each boundary at the port: `back` is the effect of heat everywhere on it, as
    /// [`Rises::of_nodes`] last returned it.
    pub(crate) fn boundary_weights(
        &mut self,
        port: NodeId,
        back: &[f64],
    ) -> Result<Vec<f64>, ReduceError> {
        if matches!(self.solver, Solver::Paths(_)) {
            return Ok(self.boundary_heat());
        }
        let none = vec![0.0; self.system.network().nodes().len()];
        let cold = vec![0.0; self.system.unknowns().len()];
        let mut weights = Vec::with_capacity(self.still.len());
        for boundary in 0..self.still.len() {
            let mut temperatures = self.still.clone();
            temperatures[boundary] = 1.0;
            self.system.apply(&mut self.work, &none, &temperatures);
            let b = inflow(self.system, &mut self.work).map_err(ReduceError::Input)?;
            let felt = self.system.unknowns().iter().zip(&b).map(|(id, q)| back[id.index()] * q);
            // the part of an eliminated port that comes from the boundary directly
            self.system.recover(&mut self.work, &cold);
            let direct = self.system.node_temperatures(&self.work)[port.index()];
            weights.push(felt.sum::<f64>() + direct);
        }
        Ok(weights)
    }

    /// Heat that every boundary takes in W at the last rises of [`Rises::of_nodes`].
    fn boundary_heat(&self) -> Vec<f64> {
        let mut heat = vec![0.0; self.still.len()];
        let mut states = vec![0.0; self.system.states().len()];
        self.system.unknown_temperatures(self.system.node_temperatures(&self.work), &mut states);
        self.system.linear_boundary_heat(&self.work, &states, &mut heat);
        heat.iter_mut().for_each(|q| *q = -*q);
        heat
    }
}

/// The first item that is more than a constant.
fn first_variable(network: &Network) -> Option<Item> {
    let varies = |flow| matches!(flow, ConductorFlow::Radiation(_) | ConductorFlow::Variable);
    let conductor = network.conductor_ids().find(|id| varies(network.flow(*id)));
    let source = network.source_ids().find(|id| !network.source_variables(*id).is_empty());
    let node = network.first_varying_capacity();
    let items = [conductor.map(Item::Conductor), source.map(Item::Source), node.map(Item::Node)];
    items.into_iter().flatten().next()
}
