//! Adds streams along faces of grids: their nodes, and the flow from one to the next.

use lptn_laws::Kind;

use crate::builder::{NetworkBuilder, Path};
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, End, FaceStreamId, Item, NodeId};
use crate::parts::face_stream::FaceStream;
use crate::parts::grid::{FacePath, GridFace, Terminal};

impl NetworkBuilder {
    /// Adds the nodes of a stream along a face: one massless node `NAME[i]` for each row of cells,
    /// from its inlet. `None` if the grid is not of this builder or the face does not have the axis.
    pub fn face_stream(
        &mut self,
        name: &str,
        at: GridFace,
        (axis, reversed): (usize, bool),
    ) -> Option<FaceStreamId> {
        let grid = self.parts.grids.get(at.grid.index())?;
        let has = grid.form().has(at.face) && at.face.along().contains(&axis);
        let count = grid.cells.get(axis).copied().filter(|_| has)?;
        let first = u32::try_from(self.parts.nodes.len()).ok()?;
        for i in 1..=count {
            self.massless(&format!("{name}[{i}]"));
        }
        let id = FaceStreamId::from_len(self.parts.face_streams.len());
        let name = name.to_owned();
        self.parts.face_streams.push(FaceStream { name, at, axis, reversed, first, count });
        Some(id)
    }

    /// The nodes of a stream along a face from inlet to outlet; none if it is not of this builder.
    pub fn stream_nodes(&self, id: FaceStreamId) -> Vec<NodeId> {
        let stream = self.parts.face_streams.get(id.index());
        stream.map_or_else(Vec::new, |stream| stream.nodes().collect())
    }

    /// Lets a stream flow from `from` along its face to `to`. The conductors are `NAME.x[1]` to its
    /// first node, `NAME.x[2]` to the second, and `NAME` to `to`; x is the direction.
    pub fn flow_along(
        &mut self,
        id: FaceStreamId,
        kind: Kind,
        (from, to): (End, End),
        path: Path,
    ) -> Vec<ConductorId> {
        let stream = self.parts.face_streams[id.index()].clone();
        let form = self.parts.grids[stream.at.grid.index()].form();
        let head = format!("{}.{}", stream.name, form.directions()[stream.axis]);
        let first = self.next_conductor() as usize;
        let law = self.shared_law(&stream.name, path);
        let mut before = from;
        for (i, node) in (1..).zip(stream.nodes()) {
            self.alike(&format!("{head}[{i}]"), kind, (before, node.into()), &law);
            before = node.into();
        }
        self.alike(&stream.name, kind, (before, to), &law);
        (first..=first + stream.count).map(ConductorId::from_len).collect()
    }

    /// The nodes of a stream next to each cell of a face.
    pub(super) fn rows_of(&self, id: FaceStreamId, at: GridFace) -> Vec<End> {
        let stream = &self.parts.face_streams[id.index()];
        let places = self.parts.grids[at.grid.index()].face_places(at.face);
        places.map(|place| stream.node_at(place[stream.axis]).into()).collect()
    }

    /// The reason why a path cannot join a stream along a face.
    pub(super) fn stream_problem(&self, path: &FacePath, item: Item) -> Option<BuildErrorKind> {
        let stream = [path.from, path.to].into_iter().find_map(|terminal| match terminal {
            Terminal::Stream(id) => self.parts.face_streams.get(id.index()),
            _ => None,
        })?;
        let rows = |at: &GridFace| {
            let grid = self.parts.grids.get(at.grid.index())?;
            let along = at.face.along().contains(&stream.axis);
            along.then_some(grid.cells[stream.axis])
        };
        let fits = path.faces().any(|at| rows(&at) == Some(stream.count));
        let rows = stream.count;
        (!fits).then(|| BuildErrorKind::StreamRows { item, stream: stream.name.clone(), rows })
    }
}
