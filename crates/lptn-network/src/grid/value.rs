//! What is shown of a grid: means and extremes of its cells, means of its faces.

use std::sync::Arc;

use crate::builder::NetworkBuilder;
use crate::grid::{Face, Grid, GridFace};
use crate::id::{GridId, Item};
use crate::network::Network;
use crate::parts::Parts;

/// A temperature of a grid as a whole, in K.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum GridValue {
    /// `NAME.mean`: the mean over its volume.
    Mean(GridId),
    /// `NAME.min`: that of the coldest cell.
    Min(GridId),
    /// `NAME.max`: that of the hottest cell.
    Max(GridId),
    /// `NAME.x1.T`: the mean over a face, of its surface where something is attached to it, else of the cells behind it.
    Face(GridFace),
}

impl GridValue {
    /// The name of its column.
    pub fn name(self, network: &Network) -> String {
        self.name_in(&network.parts)
    }

    fn name_in(self, parts: &Parts) -> String {
        let grid = &parts.grids[self.grid().index()];
        match self {
            Self::Mean(_) => format!("{}.mean", grid.name),
            Self::Min(_) => format!("{}.min", grid.name),
            Self::Max(_) => format!("{}.max", grid.name),
            Self::Face(at) => format!("{}.T", grid.face_name(at.face)),
        }
    }

    /// The grid.
    pub fn grid(self) -> GridId {
        match self {
            Self::Mean(id) | Self::Min(id) | Self::Max(id) => id,
            Self::Face(at) => at.grid,
        }
    }

    /// Its value from these temperatures of nodes in K.
    pub(crate) fn of(self, members: &[u32], nodes: &[f64]) -> f64 {
        let all = members.iter().map(|&node| nodes[node as usize]);
        match self {
            Self::Mean(_) | Self::Face(_) => all.sum::<f64>() / members.len() as f64,
            Self::Min(_) => all.reduce(f64::min).unwrap_or(f64::NAN),
            Self::Max(_) => all.reduce(f64::max).unwrap_or(f64::NAN),
        }
    }
}

impl Grid {
    /// The nodes that a value is made of.
    fn members(&self, value: GridValue) -> Vec<u32> {
        match value {
            GridValue::Face(at) if self.surfaces[at.face as usize].is_some() => {
                self.surfaces(at.face).map(|id| id.0).collect()
            }
            GridValue::Face(at) => {
                self.face_places(at.face).map(|place| self.first + self.offset(place)).collect()
            }
            _ => self.nodes().map(|id| id.0).collect(),
        }
    }
}

impl Parts {
    /// The value of this name, if there is one.
    pub(crate) fn grid_value(&self, name: &str) -> Option<GridValue> {
        let (base, ending) = name.rsplit_once('.')?;
        let grid = |name: &str| match self.item(name) {
            Some(Item::Grid(id)) => Some(id),
            _ => None,
        };
        Some(match ending {
            "mean" => GridValue::Mean(grid(base)?),
            "min" => GridValue::Min(grid(base)?),
            "max" => GridValue::Max(grid(base)?),
            "T" => {
                let (base, face) = base.rsplit_once('.')?;
                GridValue::Face(GridFace { grid: grid(base)?, face: Face::of_name(face)? })
            }
            _ => return None,
        })
    }

    pub(crate) fn grid_value_members(&self, value: GridValue) -> Vec<u32> {
        self.grids[value.grid().index()].members(value)
    }

    /// The values of all grids: mean, minimum, maximum and faces.
    pub(crate) fn grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        (0..self.grids.len()).map(GridId::from_len).flat_map(|id| {
            let faces = Face::ALL.map(|face| GridValue::Face(GridFace { grid: id, face }));
            [GridValue::Mean(id), GridValue::Min(id), GridValue::Max(id)].into_iter().chain(faces)
        })
    }

    pub(crate) fn grid_value_names(&self) -> impl Iterator<Item = String> + '_ {
        self.grid_values().map(|value| value.name_in(self))
    }

    /// Lays down which nodes the values are made of that expressions of results name.
    pub(crate) fn settle_grid_values(&mut self) {
        let values: Vec<GridValue> = self.layout.grid_values().iter().map(|(value, _)| *value).collect();
        let members = values.into_iter().map(|value| self.grid_value_members(value)).collect();
        Arc::make_mut(&mut self.layout).set_members(members);
    }
}

impl NetworkBuilder {
    /// Gives a place to a value of a grid (`NAME.mean`, `NAME.x1.T`) that an expression of results names.
    pub(crate) fn name_grid_value(&mut self, name: &str) {
        if let Some(value) = self.parts.grid_value(name) {
            Arc::make_mut(&mut self.parts.layout).add_grid_value(value);
        }
    }
}

impl Network {
    /// The values of grids that are worth a column: mean, minimum, maximum, and the faces that something is attached to,
    /// but for those of a single node, which is named as the face is.
    pub fn grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        self.parts.grid_values().filter(|value| match value {
            GridValue::Face(at) => {
                let grid = &self.grids()[at.grid.index()];
                grid.surfaces[at.face as usize].is_some() && grid.face_axes(at.face).next().is_some()
            }
            _ => true,
        })
    }

    /// The values of grids that are not in [`Network::grid_values`]: faces that nothing is attached to.
    pub fn idle_grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        self.parts.grid_values().filter(|value| match value {
            GridValue::Face(at) => self.grids()[at.grid.index()].surfaces[at.face as usize].is_none(),
            _ => false,
        })
    }

    /// The nodes that a value of a grid is made of, by their indices.
    pub fn grid_value_members(&self, value: GridValue) -> Vec<u32> {
        self.parts.grid_value_members(value)
    }

    /// A value of a grid in K, from the temperatures of all nodes in K.
    pub fn grid_value(&self, value: GridValue, nodes: &[f64]) -> f64 {
        value.of(&self.grid_value_members(value), nodes)
    }
}
