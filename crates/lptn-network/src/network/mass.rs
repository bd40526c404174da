//! Masses of nodes.

use crate::id::NodeId;
use crate::network::Network;
use crate::value::{Lump, Size};

impl Network {
    /// The mass of a node with all its parts in kg; `None` if it has none, or the mass of a part is
    /// not known.
    pub fn mass(&self, id: NodeId) -> Option<f64> {
        let node = &self.nodes()[id.index()];
        let parts = self.capacitors().iter().filter(|part| part.node == id);
        let mut masses: Vec<Option<f64>> =
            parts.map(|part| self.lump_mass(part.lump.as_ref())).collect();
        if node.capacity.is_some() {
            masses.push(self.lump_mass(node.lump.as_ref()));
        }
        if masses.is_empty() { None } else { masses.into_iter().sum() }
    }

    /// The values were evaluated when the network was built, so they can be again.
    fn lump_mass(&self, lump: Option<&Lump>) -> Option<f64> {
        let Lump { material, size } = lump?;
        let mut scope = self.evaluation();
        match size {
            Size::Mass(mass) => mass.at(&mut scope).ok(),
            Size::Volume(volume) => {
                let density =
                    self.materials()[material.index()].density.as_ref()?.at(&mut scope).ok()?;
                Some(density * volume.at(&mut scope).ok()?)
            }
        }
    }
}
