//! Grids: a block of one material, cut into equal cells.
//!
//! Each cell is a node in its middle. Two neighbours are joined by the conduction between their middles, `k A / d`, with
//! the conductivity at the mean of their temperatures; a face that something is attached to has a massless node on
//! each of its cells, joined to it by the conduction through half a cell, `2 k A / d`. This is the finite-volume scheme
//! with nodes in the middle of cells (S. V. Patankar, Numerical Heat Transfer and Fluid Flow, Hemisphere 1980, section
//! 4.2); its error shrinks with the square of the cell.

mod build;
mod check;
mod joint;
mod value;

pub use build::{Block, Substance};
pub use joint::{GridFace, Joint, Terminal};
pub use value::GridValue;

pub(crate) use check::collapse;

use crate::id::{ConductorId, GridId, Item, JointId, NodeId};
use crate::network::Network;
use crate::parts::Parts;
use crate::value::Value;

/// The most cells of a grid.
pub const MOST_CELLS: usize = 2_000_000;

/// A face of a block: the axis it is perpendicular to, and whether it is the near or the far one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// At the start of x.
    X0,
    /// At the end of x.
    X1,
    /// At the start of y.
    Y0,
    /// At the end of y.
    Y1,
    /// At the start of z.
    Z0,
    /// At the end of z.
    Z1,
}

impl Face {
    /// All six.
    pub const ALL: [Self; 6] = [Self::X0, Self::X1, Self::Y0, Self::Y1, Self::Z0, Self::Z1];

    /// Its name: `x0`, `x1`, ..
    pub fn name(self) -> &'static str {
        ["x0", "x1", "y0", "y1", "z0", "z1"][self as usize]
    }

    /// The face of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|face| face.name() == name)
    }

    /// The axis it is perpendicular to: 0 for x, 1 for y, 2 for z.
    pub fn axis(self) -> usize {
        self as usize / 2
    }

    /// The two axes along it.
    pub fn along(self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis()]
    }

    fn is_far(self) -> bool {
        self as usize % 2 == 1
    }
}

/// A block of one material, cut into equal cells: see [`NetworkBuilder::grid`](crate::NetworkBuilder::grid).
#[derive(Clone, Debug)]
pub struct Grid {
    /// Its name, which begins those of its cells, faces and inner paths.
    pub name: String,
    /// How many cells there are along x, y and z.
    pub cells: [usize; 3],
    /// How many indices its cells have: the counts that were given.
    pub axes: usize,
    /// Its lengths along x, y and z in m.
    pub size: [Value; 3],
    /// Its thermal conductivity along x, y and z in W/(m K).
    pub conductivity: [Value; 3],
    /// What it is made of.
    pub substance: Substance,
    /// Its temperature at the start in K.
    pub initial: Option<Value>,
    /// The first of its cells, which follow one another, the last index running fastest.
    first: u32,
    /// The first surface node of each face that something is attached to.
    surfaces: [Option<u32>; 6],
}

/// Indices as names end with them: `[1,2]`, nothing without any.
fn bracketed(indices: impl Iterator<Item = usize>) -> String {
    let list: Vec<String> = indices.map(|index| (index + 1).to_string()).collect();
    if list.is_empty() { String::new() } else { format!("[{}]", list.join(",")) }
}

impl Grid {
    /// The number of its cells.
    pub fn count(&self) -> usize {
        self.cells.iter().product()
    }

    /// The number of cells at a face.
    pub fn face_count(&self, face: Face) -> usize {
        face.along().into_iter().map(|axis| self.cells[axis]).product()
    }

    /// The nodes of its cells, the last index running fastest.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = NodeId> + use<> {
        let first = self.first as usize;
        (first..first + self.count()).map(NodeId::from_len)
    }

    /// The massless nodes on a face, the last index running fastest; none of a face that nothing is attached to.
    pub fn surfaces(&self, face: Face) -> impl ExactSizeIterator<Item = NodeId> + use<> {
        let first = self.surfaces[face as usize];
        let count = first.map_or(0, |_| self.face_count(face));
        let first = first.unwrap_or(0) as usize;
        (first..first + count).map(NodeId::from_len)
    }

    /// The node of a cell, by its indices from 1; `None` if there is no such cell.
    pub fn cell(&self, indices: &[usize]) -> Option<NodeId> {
        let mut at = [0; 3];
        for (axis, index) in indices.iter().enumerate() {
            at[axis] = index.checked_sub(1).filter(|i| *i < self.cells[axis])?;
        }
        (indices.len() == self.axes).then(|| NodeId(self.first + self.offset(at)))
    }

    /// The axes that the cells of a face have indices of.
    pub fn face_axes(&self, face: Face) -> impl Iterator<Item = usize> + use<> {
        let axes = self.axes;
        face.along().into_iter().filter(move |axis| *axis < axes)
    }

    /// The name of a face: `wall.x1`.
    pub fn face_name(&self, face: Face) -> String {
        format!("{}.{}", self.name, face.name())
    }

    fn offset(&self, at: [usize; 3]) -> u32 {
        let offset = (at[0] * self.cells[1] + at[1]) * self.cells[2] + at[2];
        u32::try_from(offset).expect("a grid has fewer than 2^32 cells")
    }

    /// The places of all cells but the last `less` ones along each axis.
    fn places(&self, less: [usize; 3]) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.cells[axis] - less[axis]);
        (0..x).flat_map(move |i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k])))
    }

    /// The places of the cells at a face.
    fn face_places(&self, face: Face) -> impl Iterator<Item = [usize; 3]> + use<> {
        let mut less = [0; 3];
        less[face.axis()] = self.cells[face.axis()] - 1;
        let shift = if face.is_far() { less } else { [0; 3] };
        self.places(less).map(move |at| [0, 1, 2].map(|axis| at[axis] + shift[axis]))
    }

    fn indices(&self, at: [usize; 3]) -> String {
        bracketed(at.into_iter().take(self.axes))
    }

    fn face_indices(&self, face: Face, at: [usize; 3]) -> String {
        bracketed(self.face_axes(face).map(|axis| at[axis]))
    }
}

/// Nodes or conductors that are parts of a grid or of a joint: from the first to before the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inner {
    first: u32,
    end: u32,
    whole: Item,
}

fn whole_of(inner: &[Inner], index: u32) -> Option<Item> {
    let place = inner.partition_point(|part| part.end <= index);
    inner.get(place).filter(|part| part.first <= index).map(|part| part.whole)
}

impl Parts {
    /// The grid or joint that a cell, a surface or a path is a part of.
    pub(crate) fn whole(&self, item: Item) -> Option<Item> {
        match item {
            Item::Node(id) => whole_of(&self.inner_nodes, id.0),
            Item::Conductor(id) => whole_of(&self.inner_conductors, id.0),
            _ => None,
        }
    }
}

impl Network {
    /// The grids.
    pub fn grids(&self) -> &[Grid] {
        &self.parts.grids
    }

    /// Ids of all grids.
    pub fn grid_ids(&self) -> impl ExactSizeIterator<Item = GridId> + use<> {
        (0..self.parts.grids.len()).map(GridId::from_len)
    }

    /// The paths that end at faces of grids.
    pub fn joints(&self) -> &[Joint] {
        &self.parts.joints
    }

    /// Ids of all paths that end at faces of grids.
    pub fn joint_ids(&self) -> impl ExactSizeIterator<Item = JointId> + use<> {
        (0..self.parts.joints.len()).map(JointId::from_len)
    }

    /// What a node or conductor is a part of: the grid of a cell, a surface node or an inner path, the joint of a path
    /// from one cell of a face; `None` for what stands for itself.
    pub fn whole(&self, item: Item) -> Option<Item> {
        self.parts.whole(item)
    }

    /// The nodes that stand for themselves: all but cells and surfaces of grids.
    pub fn outer_nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.node_ids().filter(|id| self.whole(Item::Node(*id)).is_none())
    }

    /// The conductors that stand for themselves: all but those inside grids and joints.
    pub fn outer_conductors(&self) -> impl Iterator<Item = ConductorId> + '_ {
        self.conductor_ids().filter(|id| self.whole(Item::Conductor(*id)).is_none())
    }
}
