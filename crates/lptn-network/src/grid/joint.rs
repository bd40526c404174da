//! Paths that end at faces of grids: one for each cell of the face.

use lptn_laws::{Extent, Kind};
use lptn_units::Dimension;

use crate::builder::{NetworkBuilder, Path};
use crate::error::BuildErrorKind;
use crate::grid::Face;
use crate::grid::build::{product, scaled, typed};
use crate::id::{BoundaryId, ConductorId, End, GridId, Item, JointId, NodeId};
use crate::network::Network;
use crate::parts::Parts;
use crate::value::{Input, Value};

/// A face of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GridFace {
    /// The grid.
    pub grid: GridId,
    /// Which of its faces.
    pub face: Face,
}

/// What a path may end at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Terminal {
    /// A node or boundary.
    End(End),
    /// A face of a grid.
    Face(GridFace),
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

/// A path that ends at a face: one conductor for each cell, which share its conductance or area.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: Kind,
    /// The end that positive heat leaves.
    pub from: Terminal,
    /// The end that positive heat enters.
    pub to: Terminal,
    /// Its whole area in m^2, where it is given; it has to be that of the face.
    pub area: Option<Value>,
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Joint {
    /// Its conductors, `NAME[j,k]` by the cells of the face it starts at, else of that it ends at. At the end of a rod,
    /// whose cell has no index there, it is one, named as the path itself.
    pub fn conductors(&self) -> impl ExactSizeIterator<Item = ConductorId> + use<> {
        (self.first as usize..self.end as usize).map(ConductorId::from_len)
    }

    /// The faces it ends at: one or two.
    pub fn faces(&self) -> impl Iterator<Item = GridFace> + use<> {
        [self.from, self.to].into_iter().filter_map(|terminal| match terminal {
            Terminal::Face(face) => Some(face),
            Terminal::End(_) => None,
        })
    }
}

impl Parts {
    /// The joints of more than one conductor; the others are known by their conductor.
    pub(crate) fn shared_joints(&self) -> impl Iterator<Item = JointId> + '_ {
        let shared = |(_, joint): &(usize, &Joint)| {
            joint.conductors().next().is_some_and(|id| self.whole(Item::Conductor(id)).is_some())
        };
        self.joints.iter().enumerate().filter(shared).map(|(i, _)| JointId::from_len(i))
    }
}

impl Network {
    /// What a path ends at, by its name.
    pub fn terminal_name(&self, terminal: Terminal) -> String {
        match terminal {
            Terminal::End(end) => self.name_of(end.into()).into_owned(),
            Terminal::Face(at) => self.grids()[at.grid.index()].face_name(at.face),
        }
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

    /// The paths to faces that are more than one conductor, whose heat is a sum; the others are ordinary conductors.
    pub fn shared_joints(&self) -> impl Iterator<Item = JointId> + '_ {
        self.parts.shared_joints()
    }
}

impl NetworkBuilder {
    /// Adds a path between nodes, boundaries and faces of grids. One that ends at a face becomes a conductor for each of
    /// its cells; they share the conductance or the area of the whole. Two faces are joined cell by cell, in the order
    /// of the axes along each.
    ///
    /// Expressions in its values see the temperatures of each conductor by itself, and are those of the whole path.
    pub fn connect(
        &mut self,
        name: &str,
        kind: Kind,
        (from, to): (impl Into<Terminal>, impl Into<Terminal>),
        path: Path,
    ) -> Item {
        let (from, to) = (from.into(), to.into());
        if let (Terminal::End(from), Terminal::End(to)) = (from, to) {
            return Item::Conductor(self.conductor(name, kind, (from, to), path));
        }
        let item = Item::Joint(JointId::from_len(self.parts.joints.len()));
        let first = self.next_conductor();
        let (name, area) = (name.to_owned(), path.area());
        let joint = Joint { name, kind, from, to, area, first, end: first };
        match self.joint_problem(&joint, item, path.is_stream()) {
            Some(problem) => {
                self.error(&joint.name, problem);
                self.register(&joint.name, item);
                self.parts.joints.push(joint);
                item
            }
            None => self.join(joint, (item, path)),
        }
    }

    fn join(&mut self, mut joint: Joint, (item, path): (Item, Path)) -> Item {
        let named = joint.faces().next();
        let indices = named.map_or_else(Vec::new, |at| self.face_indices(at));
        let path = path.shared(indices.len() as f64);
        let (from, to) = (self.ends(joint.from, indices.len()), self.ends(joint.to, indices.len()));
        joint.first = self.next_conductor();
        let whole = indices.iter().any(|index| !index.is_empty());
        if whole {
            self.register(&joint.name, item);
        }
        for ((from, to), index) in from.into_iter().zip(to).zip(&indices) {
            self.conductor(&format!("{}{index}", joint.name), joint.kind, (from, to), path.clone());
        }
        joint.end = self.next_conductor();
        if whole {
            self.inner_conductors(joint.first, item);
        }
        self.parts.joints.push(joint);
        item
    }

    /// The indices of the cells of a face, as they end names.
    fn face_indices(&self, at: GridFace) -> Vec<String> {
        let Some(grid) = self.parts.grids.get(at.grid.index()) else { return Vec::new() };
        grid.face_places(at.face).map(|place| grid.face_indices(at.face, place)).collect()
    }

    fn ends(&mut self, terminal: Terminal, count: usize) -> Vec<End> {
        match terminal {
            Terminal::End(end) => vec![end; count],
            Terminal::Face(at) => self.surfaces(at.grid, at.face).into_iter().map(End::Node).collect(),
        }
    }

    /// Why a path cannot end where it should.
    fn joint_problem(&self, joint: &Joint, item: Item, stream: bool) -> Option<BuildErrorKind> {
        let faces: Vec<GridFace> = joint.faces().collect();
        if faces.iter().any(|at| at.grid.index() >= self.parts.grids.len()) {
            return Some(BuildErrorKind::ForeignId { item });
        }
        if stream {
            return Some(BuildErrorKind::StreamIntoFace { item });
        }
        let [a, b] = faces[..] else { return None };
        let cells = |at: GridFace| at.face.along().map(|axis| self.parts.grids[at.grid.index()].cells[axis]);
        let name = |at: GridFace| self.parts.grids[at.grid.index()].face_name(at.face);
        let (cells, names) = ([cells(a), cells(b)], [name(a), name(b)]);
        (cells[0] != cells[1]).then_some(BuildErrorKind::FaceCells { item, faces: [a, b], names, cells })
    }

    /// The area of a face, for a path whose area is that of the face; `None` if the grid is not of this builder.
    pub fn face_area(&self, at: GridFace) -> Option<Input> {
        let grid = self.parts.grids.get(at.grid.index())?;
        let sides = at.face.along().map(|axis| grid.size[axis].clone());
        Some(typed(product(sides.to_vec()), Dimension::AREA))
    }

    /// The nodes of a grid with the share of each in its volume, for a source into the whole.
    pub fn shares_of_volume(&self, grid: GridId) -> Vec<(NodeId, f64)> {
        let Some(grid) = self.parts.grids.get(grid.index()) else { return Vec::new() };
        let share = 1.0 / grid.count() as f64;
        grid.nodes().map(|node| (node, share)).collect()
    }

    /// The surfaces of a face with the share of each in its area, for a source into the face.
    pub fn shares_of_face(&mut self, at: GridFace) -> Vec<(NodeId, f64)> {
        let nodes = self.surfaces(at.grid, at.face);
        let share = 1.0 / nodes.len() as f64;
        nodes.into_iter().map(|node| (node, share)).collect()
    }
}

impl Path {
    /// The area that it names.
    fn area(&self) -> Option<Value> {
        let key = self.formula().declaration().area.first()?;
        Some(self.value(key)?.value.clone())
    }

    /// One of `count` equal parts of it, side by side.
    fn shared(self, count: f64) -> Self {
        let times = |factor: f64| move |input: Input| Input { value: scaled(&input.value, factor), ..input };
        match self.formula().declaration().extent {
            Extent::Divided(key) => self.with(key, times(1.0 / count)),
            Extent::Multiplied(key) => self.with(key, times(count)),
            Extent::Whole => self,
        }
    }
}
