//! Kept nodes as a network that runs.

use lptn_assembly::ThermalSystem;
use lptn_network::{
    BoundaryId, Conductance, End, HeatCapacity, Network, NetworkBuilder, NodeId, Temperature,
};

use crate::carried::{Carried, first};
use crate::error::ReduceError;
use crate::kept::Kept;
use crate::reduction::{initial, still};

/// Conductances below this share of all that meet in a node are rounding.
const ROUNDING: f64 = 1e-14;

impl Kept {
    /// The reduced network, its nodes with their own names and start temperatures, its inputs as
    /// written.
    ///
    /// # Errors
    /// [`ReduceError::Equivalent`] if an input cannot be expressed in it, [`ReduceError::NotGiven`],
    /// [`ReduceError::Switches`].
    pub fn network(&self, system: &ThermalSystem, start: f64) -> Result<Network, ReduceError> {
        let from = system.network();
        still(from)?;
        let total = |node: usize| self.grounds[node].iter().sum::<f64>() + self.linked(node);
        let ground = |node: usize, boundary: usize| -> f64 {
            let g = self.grounds[node][boundary];
            if g > ROUNDING * total(node) { g } else { 0.0 }
        };
        let all = 0..self.count();
        let feels = |boundary: usize| all.clone().any(|node| ground(node, boundary) > 0.0);
        let heat = |source: usize| all.clone().map(|node| self.shares[node][source]).sum::<f64>();
        let carried = Carried {
            system,
            boundaries: (0..from.boundaries().len()).map(feels).collect(),
            sources: (0..from.sources().len()).map(|source| heat(source) > 0.0).collect(),
        };
        let mut b = NetworkBuilder::new();
        carried.parameters(&mut b)?;
        let nodes = self.nodes(&mut b, system, start)?;
        let mut count = 0;
        let mut join = |b: &mut NetworkBuilder, node: NodeId, to: End, g: f64| {
            count += 1;
            b.resistor(&carried.free(&format!("G_{count}")), node, to, Conductance(g));
        };
        for &(i, j, g) in &self.links {
            join(&mut b, nodes[i], nodes[j].into(), g);
        }
        for boundary in (0..from.boundaries().len()).filter(|place| carried.boundaries[*place]) {
            let id: BoundaryId = carried.boundary(&mut b, boundary)?;
            for node in all.clone().filter(|node| ground(*node, boundary) > 0.0) {
                join(&mut b, nodes[node], id.into(), ground(node, boundary));
            }
        }
        for source in (0..from.sources().len()).filter(|place| carried.sources[*place]) {
            let all = all.clone().map(|node| (nodes[node].into(), self.shares[node][source]));
            let sum = heat(source);
            let into: Vec<(End, f64)> = all
                .filter(|(_, share)| *share > ROUNDING * sum)
                .map(|(node, share): (End, f64)| (node, share / sum))
                .collect();
            carried.source(&mut b, (source, sum), &into)?;
        }
        b.build().map_err(|errors| ReduceError::Equivalent(first(&errors)))
    }

    fn linked(&self, node: usize) -> f64 {
        let here = self.links.iter().filter(|(i, j, _)| *i == node || *j == node);
        here.map(|(_, _, g)| g).sum()
    }

    fn nodes(
        &self,
        b: &mut NetworkBuilder,
        system: &ThermalSystem,
        start: f64,
    ) -> Result<Vec<NodeId>, ReduceError> {
        let from = system.network();
        let mut nodes = Vec::with_capacity(self.count());
        for (&node, &capacity) in self.nodes.iter().zip(&self.capacity) {
            let name = &from.nodes()[node.index()].name;
            nodes.push(if capacity > 0.0 {
                let temperature = Temperature(initial(system, node, start)?);
                b.node(name, HeatCapacity(capacity), temperature)
            } else {
                b.massless(name)
            });
        }
        Ok(nodes)
    }
}
