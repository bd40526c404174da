//! Masses of nodes.

use crate::evaluation::Evaluation;
use crate::id::NodeId;
use crate::network::Network;
use crate::value::{Lump, Size};

impl Network {
    /// The mass of a node with all its parts in kg; `None` if it has none, or the mass of a part is
    /// not known.
    pub fn mass(&self, id: NodeId) -> Option<f64> {
        self.mass_in(id, &mut self.evaluation())
    }

    /// The mass of all nodes with capacity in kg; `None` if there is none, or that of one is not
    /// known.
    pub fn whole_mass(&self) -> Option<f64> {
        let mut scope = self.evaluation();
        let nodes = self.thermal_nodes().filter(|id| self.capacity(*id) > 0.0);
        let mut all = None;
        for id in nodes {
            all = Some(all.unwrap_or(0.0) + self.mass_in(id, &mut scope)?);
        }
        all
    }

    fn mass_in(&self, id: NodeId, scope: &mut Evaluation) -> Option<f64> {
        let node = &self.nodes()[id.index()];
        let parts = self.capacitors().iter().filter(|part| part.node == id);
        let mut masses: Vec<Option<f64>> =
            parts.map(|part| self.lump_mass(part.lump.as_ref(), scope)).collect();
        if node.capacity.is_some() {
            masses.push(self.lump_mass(node.lump.as_ref(), scope));
        }
        if masses.is_empty() { None } else { masses.into_iter().sum() }
    }

    /// The values were evaluated when the network was built, so they can be again.
    fn lump_mass(&self, lump: Option<&Lump>, scope: &mut Evaluation) -> Option<f64> {
        let Lump { material, size } = lump?;
        match size {
            Size::Mass(mass) => mass.at(scope).ok(),
            Size::Volume(volume) => {
                let density =
                    self.materials()[material.index()].density.as_ref()?.at(scope).ok()?;
                Some(density * volume.at(scope).ok()?)
            }
        }
    }
}
