//! Grids: a body of one material, cut into cells.
//!
//! Each cell of a block is a node in its middle. Two neighbours are joined by the conduction between their
//! middles, `k A / d`, with the conductivity at the mean of their temperatures; a face that
//! something is attached to has a massless node on each of its cells, joined to it by the
//! conduction through half a cell, `2 k A / d`. This is the finite-volume scheme with nodes in the
//! middle of cells (S. V. Patankar, Numerical Heat Transfer and Fluid Flow, Hemisphere 1980,
//! section 4.2); its error shrinks with the square of the cell. Cells of round bodies are those of
//! [`rings`](crate::parts::rings).

use lptn_laws::Kind;

pub use crate::id::GridFace;
use crate::id::{BoundaryId, ConductorId, End, FaceStreamId, GridPatch, Item, MaterialId, NodeId};
pub use crate::parts::face::Face;
use crate::parts::overlap::{Joint, Placement};
use crate::parts::patch::Patch;
use crate::parts::rings::Rings;
use crate::parts::shape::{Form, Shape};
use crate::value::Value;

/// The most cells of a grid.
pub const MOST_CELLS: usize = 2_000_000;

/// A body of one material, cut into cells: see
/// [`NetworkBuilder::grid`](crate::NetworkBuilder::grid).
#[derive(Clone, Debug)]
pub struct Grid {
    /// Its name, which begins those of its cells, faces and inner paths.
    pub name: String,
    /// Number of cells along x, y and z, or r, phi and z.
    pub cells: [usize; 3],
    /// Number of indices of its cells: the number of counts that were given.
    pub axes: usize,
    /// Its shape with its lengths.
    pub shape: Shape,
    /// The rings of a round body.
    pub(crate) rings: Option<Rings>,
    /// Its thermal conductivity along x, y and z, or r, phi and z, in W/(m K).
    pub conductivity: [Value; 3],
    /// Its material, or density and specific heat capacity.
    pub substance: Substance,
    /// Its temperature at the start in K.
    pub initial: Option<Value>,
    /// The first of its cells, which follow one another, the last index running fastest.
    pub(crate) first: u32,
    /// The first inner path along each axis that has one, the last index running fastest.
    pub(crate) paths: [Option<u32>; 3],
    /// The first surface node of each face that something is attached to.
    pub(crate) surfaces: [Option<u32>; 6],
    /// Rectangles and circles of its faces.
    pub patches: Vec<Patch>,
}

/// Indices as names end with them: `[1,2]`, nothing without any.
pub(crate) fn bracketed(indices: impl Iterator<Item = usize>) -> String {
    let list: Vec<String> = indices.map(|index| (index + 1).to_string()).collect();
    if list.is_empty() { String::new() } else { format!("[{}]", list.join(",")) }
}

/// The place that indices from 1 have, if there are as many as axes and none is too large.
pub(crate) fn place(indices: &[usize], axes: usize, counts: [usize; 3]) -> Option<[usize; 3]> {
    let mut at = [0; 3];
    for (axis, index) in indices.iter().enumerate() {
        at[axis] = index.checked_sub(1).filter(|i| *i < counts[axis])?;
    }
    (indices.len() == axes).then_some(at)
}

/// The number of a place, the last index running fastest.
pub(crate) fn number(at: [usize; 3], counts: [usize; 3]) -> usize {
    (at[0] * counts[1] + at[1]) * counts[2] + at[2]
}

/// The places of this number of cells along each axis, the last one running fastest.
pub(crate) fn places_of([x, y, z]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..x).flat_map(move |i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k])))
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

    /// The massless nodes on a face, the last index running fastest; none of a face that nothing is
    /// attached to.
    pub fn surfaces(&self, face: Face) -> impl ExactSizeIterator<Item = NodeId> + use<> {
        let first = self.surfaces[face as usize];
        let count = first.map_or(0, |_| self.face_count(face));
        let first = first.unwrap_or(0) as usize;
        (first..first + count).map(NodeId::from_len)
    }

    /// The node of a cell, by its indices from 1; `None` if there is no such cell.
    pub fn cell(&self, indices: &[usize]) -> Option<NodeId> {
        let at = place(indices, self.axes, self.cells)?;
        Some(NodeId(self.first + self.offset(at)))
    }

    /// The axes that the cells of a face have indices of.
    pub fn face_axes(&self, face: Face) -> impl Iterator<Item = usize> + use<> {
        let axes = self.axes;
        face.along().into_iter().filter(move |axis| *axis < axes)
    }

    /// Its directions and faces.
    pub fn form(&self) -> Form {
        self.shape.form()
    }

    /// The name of a face: `wall.x1`.
    pub fn face_name(&self, face: Face) -> String {
        format!("{}.{}", self.name, self.form().face_name(face))
    }

    pub(crate) fn offset(&self, at: [usize; 3]) -> u32 {
        u32::try_from(number(at, self.cells)).expect("a grid has fewer than 2^32 cells")
    }

    /// The places of all cells but the last `less` ones along each axis.
    pub(crate) fn places(&self, less: [usize; 3]) -> impl Iterator<Item = [usize; 3]> + use<> {
        places_of([0, 1, 2].map(|axis| self.cells[axis] - less[axis]))
    }

    /// The places of the cells at a face.
    pub(crate) fn face_places(&self, face: Face) -> impl Iterator<Item = [usize; 3]> + use<> {
        let mut less = [0; 3];
        less[face.axis()] = self.cells[face.axis()] - 1;
        let shift = if face.is_far() { less } else { [0; 3] };
        self.places(less).map(move |at| [0, 1, 2].map(|axis| at[axis] + shift[axis]))
    }

    pub(crate) fn indices(&self, at: [usize; 3]) -> String {
        bracketed(at.into_iter().take(self.axes))
    }

    pub(crate) fn face_indices(&self, face: Face, at: [usize; 3]) -> String {
        bracketed(self.face_axes(face).map(|axis| at[axis]))
    }
}

/// The material of a grid's cells, or the properties by which they store heat.
#[derive(Clone, Debug)]
pub enum Substance<T = Value> {
    /// A material with density and specific heat; it may melt.
    Material(MaterialId),
    /// The properties themselves.
    Properties {
        /// Density in kg/m^3.
        density: T,
        /// Specific heat capacity in J/(kg K); may depend on `T`.
        cp: T,
    },
}

/// The end of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Terminal {
    /// A node or boundary.
    End(End),
    /// A face of a grid.
    Face(GridFace),
    /// A rectangle or circle of a face.
    Patch(GridPatch),
    /// A stream along a face: the fluid of each row of cells.
    Stream(FaceStreamId),
}

impl From<End> for Terminal {
    fn from(end: End) -> Self {
        Self::End(end)
    }
}

impl From<NodeId> for Terminal {
    fn from(id: NodeId) -> Self {
        Self::End(id.into())
    }
}

impl From<BoundaryId> for Terminal {
    fn from(id: BoundaryId) -> Self {
        Self::End(id.into())
    }
}

impl From<GridFace> for Terminal {
    fn from(face: GridFace) -> Self {
        Self::Face(face)
    }
}

impl From<GridPatch> for Terminal {
    fn from(patch: GridPatch) -> Self {
        Self::Patch(patch)
    }
}

/// A path that ends at a face or a patch of one: one conductor for each cell, which share its
/// conductance or area.
#[derive(Clone, Debug)]
pub struct FacePath {
    /// Its name, unique among nodes, boundaries and elements.
    pub name: String,
    /// The kind of section that contains it.
    pub kind: Kind,
    /// The end that positive heat leaves.
    pub from: Terminal,
    /// The end that positive heat enters.
    pub to: Terminal,
    /// Its whole area in m^2, if it is given; it has to be that of the face, or the common area of
    /// two.
    pub area: Option<Value>,
    /// The place of the first of two faces on the second.
    pub(crate) placement: Placement,
    /// The pairs of cells of two faces that its conductors join.
    pub(crate) joint: Joint,
    pub(crate) first: u32,
    pub(crate) end: u32,
}

impl FacePath {
    /// Its conductors, `NAME[j,k]` by the cells of the face it starts at, else of that it ends at;
    /// `NAME[j,k,l,m]` by both if they overlap in part.
    /// At the end of a rod, whose cell has no index there, one conductor named as the path.
    pub fn conductors(&self) -> impl ExactSizeIterator<Item = ConductorId> + use<> {
        (self.first as usize..self.end as usize).map(ConductorId::from_len)
    }

    /// True if parameters change the lengths or the place of the two faces that it joins.
    pub(crate) fn is_moving(&self) -> bool {
        matches!(self.joint, Joint::Moving(_))
    }

    /// The patch it ends at.
    pub fn patch(&self) -> Option<GridPatch> {
        [self.from, self.to].into_iter().find_map(|terminal| match terminal {
            Terminal::Patch(patch) => Some(patch),
            _ => None,
        })
    }

    /// The faces it ends at, or on which its patch lies: one or two.
    pub fn faces(&self) -> impl Iterator<Item = GridFace> + use<> {
        [self.from, self.to].into_iter().filter_map(|terminal| match terminal {
            Terminal::Face(face) => Some(face),
            Terminal::Patch(patch) => Some(patch.at),
            Terminal::End(_) | Terminal::Stream(_) => None,
        })
    }
}

/// Nodes or conductors that are parts of a grid or of a joint: from the first to before the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inner {
    pub(crate) first: u32,
    pub(crate) end: u32,
    pub(crate) whole: Item,
}
