//! Temperatures of a grid in the results: means and extremes of its cells, means of its faces.

use crate::id::{GridId, GridPatch};
use crate::parts::face::Face;
use crate::parts::grid::{Grid, GridFace};

/// A temperature of a grid as a whole, in K.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum GridValue {
    /// `NAME.mean`: the mean over its volume.
    Mean(GridId),
    /// `NAME.min`: that of the coldest cell.
    Min(GridId),
    /// `NAME.max`: that of the hottest cell.
    Max(GridId),
    /// `NAME.x1.T`: the mean over a face, of its surface if something is attached to it, else of
    /// the cells next to it.
    Face(GridFace),
    /// `NAME.chip.T`: the mean over a patch, of the same nodes.
    Patch(GridPatch),
}

impl GridValue {
    /// The name of its column; `grid` is its grid.
    pub(crate) fn named(self, grid: &Grid) -> String {
        match self {
            Self::Mean(_) => format!("{}.mean", grid.name),
            Self::Min(_) => format!("{}.min", grid.name),
            Self::Max(_) => format!("{}.max", grid.name),
            Self::Face(at) => format!("{}.T", grid.face_name(at.face)),
            Self::Patch(patch) => format!("{}.T", grid.patch_name(patch)),
        }
    }

    /// The grid whose value it is.
    pub fn grid(self) -> GridId {
        match self {
            Self::Mean(id) | Self::Min(id) | Self::Max(id) => id,
            Self::Face(at) => at.grid,
            Self::Patch(patch) => patch.at.grid,
        }
    }

    /// Its value from these temperatures of nodes in K. Weights sum to 1; without any, all nodes
    /// count alike.
    pub(crate) fn of(self, (members, weights): (&[u32], &[f64]), nodes: &[f64]) -> f64 {
        let all = members.iter().map(|&node| nodes[node as usize]);
        match self {
            Self::Mean(_) | Self::Face(_) | Self::Patch(_) if !weights.is_empty() => {
                all.zip(weights).map(|(kelvin, weight)| kelvin * weight).sum()
            }
            Self::Mean(_) | Self::Face(_) | Self::Patch(_) => {
                all.sum::<f64>() / members.len() as f64
            }
            Self::Min(_) => all.reduce(f64::min).unwrap_or(f64::NAN),
            Self::Max(_) => all.reduce(f64::max).unwrap_or(f64::NAN),
        }
    }
}

impl Grid {
    /// The nodes that a value is made of.
    pub(crate) fn members(&self, value: GridValue) -> Vec<u32> {
        match value {
            GridValue::Face(at) => self.face_members(at.face),
            GridValue::Patch(patch) => {
                let face = self.face_members(patch.at.face);
                let shares = self.patch(patch).parts.shares.iter();
                shares.map(|(cell, _)| face[*cell as usize]).collect()
            }
            _ => self.nodes().map(|id| id.0).collect(),
        }
    }

    /// The surfaces of a face, or its cells if nothing is attached to it.
    fn face_members(&self, face: Face) -> Vec<u32> {
        match self.surfaces[face as usize] {
            Some(_) => self.surfaces(face).map(|id| id.0).collect(),
            None => self.face_places(face).map(|place| self.first + self.offset(place)).collect(),
        }
    }

    /// The weights of these nodes in a mean, which sum to 1; none if all count alike.
    pub(crate) fn weights(&self, value: GridValue) -> Vec<f64> {
        let alike = match value {
            GridValue::Face(at) => self.rings.is_none() || at.face.axis() == 0,
            GridValue::Patch(_) => false,
            _ => self.rings.is_none(),
        };
        match value {
            _ if alike => Vec::new(),
            GridValue::Patch(patch) => {
                self.patch(patch).parts.shares.iter().map(|(_, share)| *share).collect()
            }
            GridValue::Face(at) => {
                let parts =
                    self.face_places(at.face).map(|place| self.parts_of_face(at.face, place));
                parts.map(f64::recip).collect()
            }
            _ => self.places([0; 3]).map(|place| self.part_of_volume(place)).collect(),
        }
    }
}
