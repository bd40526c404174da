//! Grids as a whole.

use crate::id::{ConductorId, FacePathId, Item, NodeId, SourceId};
use crate::network::Network;
use crate::parts::Parts;
use crate::parts::grid::{Face, Terminal};
use crate::parts::grid_value::GridValue;
use crate::parts::overlap::{Joint, Overlap};

impl Network {
    /// The item that a node or conductor is a part of: the grid of a cell, a surface node or an
    /// inner path, the joint of a path from one cell of a face; `None` for an independent item.
    pub fn whole(&self, item: Item) -> Option<Item> {
        self.parts.whole(item)
    }

    /// The independent nodes: all but cells and surfaces of grids and states.
    pub fn outer_nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.thermal_nodes().filter(|id| self.whole(Item::Node(*id)).is_none())
    }

    /// The independent conductors: all but those inside grids and joints.
    pub fn outer_conductors(&self) -> impl Iterator<Item = ConductorId> + '_ {
        self.conductor_ids().filter(|id| self.whole(Item::Conductor(*id)).is_none())
    }
}

impl Network {
    /// The values of grids that become columns: mean, minimum, maximum, and the faces that
    /// something is attached to, except those of a single node, which is named as the face is.
    pub fn grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        self.parts.grid_values().filter(|value| match value {
            GridValue::Face(at) => {
                let grid = &self.grids()[at.grid.index()];
                grid.surfaces[at.face as usize].is_some()
                    && grid.face_axes(at.face).next().is_some()
            }
            _ => true,
        })
    }

    /// The values of grids that are not in [`Network::grid_values`]: faces that nothing is attached
    /// to.
    pub fn idle_grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        self.parts.grid_values().filter(|value| match value {
            GridValue::Face(at) => {
                self.grids()[at.grid.index()].surfaces[at.face as usize].is_none()
            }
            _ => false,
        })
    }

    /// The nodes that a value of a grid is made of, by their indices.
    pub fn grid_value_members(&self, value: GridValue) -> Vec<u32> {
        self.parts.grid_value_members(value)
    }

    /// A value of a grid in K, from the temperatures of all nodes in K.
    pub fn grid_value(&self, value: GridValue, nodes: &[f64]) -> f64 {
        let grid = &self.grids()[value.grid().index()];
        value.of((&self.grid_value_members(value), &grid.weights(value)), nodes)
    }
}

impl Network {
    /// The name of the end of a path.
    pub fn terminal_name(&self, terminal: Terminal) -> String {
        self.parts.terminal_name(terminal)
    }

    /// The name of a node, for a cell that of its grid and for a surface that of its face.
    pub fn place_name(&self, id: NodeId) -> String {
        let Some(Item::Grid(grid)) = self.whole(Item::Node(id)) else {
            return self.nodes()[id.index()].name.clone();
        };
        let grid = &self.grids()[grid.index()];
        let face = Face::ALL.into_iter().find(|face| grid.surfaces(*face).any(|node| node == id));
        face.map_or_else(|| grid.name.clone(), |face| grid.face_name(face))
    }

    /// The names of the places that a source heats: nodes, grids, faces, patches.
    pub fn heated_places(&self, id: SourceId) -> Vec<String> {
        let nodes: Vec<NodeId> =
            self.sources()[id.index()].into.iter().map(|(node, _)| *node).collect();
        let mut places: Vec<String> = nodes.iter().map(|node| self.place_name(*node)).collect();
        places.dedup();
        let patches = self.parts.grid_values().filter(|value| matches!(value, GridValue::Patch(_)));
        let mut whole = patches.filter(|patch| {
            let members = self.parts.grid_value_members(*patch).into_iter();
            members.eq(nodes.iter().map(|node| node.0))
        });
        match whole.next() {
            Some(patch) => vec![patch.name(self).trim_end_matches(".T").to_owned()],
            None => places,
        }
    }

    /// The shares of two faces of blocks that touch; `None` for other paths and for equal faces.
    pub fn touching(&self, id: FacePathId) -> Option<[f64; 2]> {
        let path = &self.face_paths()[id.index()];
        let faces = self.parts.joined_blocks(path)?;
        if matches!(path.joint, Joint::CellByCell) {
            return None;
        }
        let along = self.parts.along(faces, &path.placement, &mut self.evaluation());
        Some(Overlap::of(along, &path.placement)?.shares)
    }

    /// The paths to faces that are more than one conductor, whose heat is a sum; the others are
    /// ordinary conductors.
    pub fn shared_face_paths(&self) -> impl Iterator<Item = FacePathId> + '_ {
        self.parts.shared_face_paths()
    }
}

impl Parts {
    pub(crate) fn terminal_name(&self, terminal: Terminal) -> String {
        match terminal {
            Terminal::End(end) => self.name_of(end.into()).into_owned(),
            Terminal::Face(at) => self.face_name(at),
            Terminal::Patch(patch) => self.name_of(Item::Patch(patch)).into_owned(),
            Terminal::Stream(id) => self.face_streams[id.index()].name.clone(),
        }
    }
}

impl GridValue {
    /// The name of its column.
    pub fn name(self, network: &Network) -> String {
        network.parts.grid_value_name(self)
    }
}
