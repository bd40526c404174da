//! Streams along faces of grids, from one row of cells to the next.

use crate::id::NodeId;
use crate::parts::grid::GridFace;

/// A stream along a face: one massless node of fluid for each row of cells across the flow.
#[derive(Clone, Debug)]
pub struct FaceStream {
    /// Its name, which begins those of its nodes, `NAME[1]` at its inlet.
    pub name: String,
    /// The face.
    pub at: GridFace,
    /// The axis along which it flows.
    pub axis: usize,
    /// True if it flows against the axis.
    pub reversed: bool,
    pub(crate) first: u32,
    pub(crate) count: usize,
}

impl FaceStream {
    /// Its nodes from inlet to outlet.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = NodeId> + use<> {
        let first = self.first as usize;
        (first..first + self.count).map(NodeId::from_len)
    }

    /// The node at a row of cells, counted from 0 along the axis.
    pub(crate) fn node_at(&self, row: usize) -> NodeId {
        let place = if self.reversed { self.count - 1 - row } else { row };
        NodeId::from_len(self.first as usize + place)
    }
}
