//! Paths that end at faces of grids: one for each cell of the face.

use lptn_laws::{Extent, Kind};
use lptn_units::Dimension;

use crate::builder::grid::{scaled, typed};
use crate::builder::{NetworkBuilder, Path};
use crate::error::BuildErrorKind;
use crate::id::{End, FacePathId, Field, GridId, GridPatch, Item, NodeId};
use crate::law::Law;
use crate::parts::grid::{FacePath, GridFace, Terminal};
use crate::parts::overlap::{Joint, Placement};
use crate::parts::shape::Form;
use crate::value::{Input, Value};

impl NetworkBuilder {
    /// Adds a path between nodes, boundaries and faces of grids. One that ends at a face becomes a
    /// conductor for each of its cells; they share the conductance or the area of the whole. Two
    /// equal faces are joined cell by cell, in the order of the axes along each.
    ///
    /// Expressions in its values see the temperatures of each conductor by itself, and are those of
    /// the whole path.
    pub fn connect(
        &mut self,
        name: &str,
        kind: Kind,
        (from, to): (impl Into<Terminal>, impl Into<Terminal>),
        path: Path,
    ) -> Item {
        self.connect_at(name, kind, (from.into(), to.into()), (path, Placement::default()))
    }

    /// The same for two faces of blocks of which the first has a place on the second. Every pair of
    /// cells that overlap exchanges heat over their common area.
    pub fn connect_at(
        &mut self,
        name: &str,
        kind: Kind,
        (from, to): (Terminal, Terminal),
        (path, placement): (Path, Placement<Input>),
    ) -> Item {
        if let (Terminal::End(from), Terminal::End(to)) = (from, to) {
            return Item::Conductor(self.conductor(name, kind, (from, to), path));
        }
        let item = Item::FacePath(FacePathId::from_len(self.parts.face_paths.len()));
        let placement = self.placed((name, item), placement);
        let first = self.next_conductor();
        let (name, area) = (name.to_owned(), path.area());
        let (joint, end) = (Joint::CellByCell, first);
        let mut face_path = FacePath { name, kind, from, to, area, placement, joint, first, end };
        let problem = self.face_path_problem(&face_path, item, path.is_stream());
        let problem = problem.or_else(|| self.whole_problem(&face_path, item, &path));
        let problem = problem.or_else(|| self.stream_problem(&face_path, item));
        let problem = problem.or_else(|| self.overlap(&mut face_path, item, &path).err());
        match problem {
            Some(problem) => {
                self.error(&face_path.name, problem);
                self.register(&face_path.name, item);
                self.parts.face_paths.push(face_path);
                item
            }
            None if matches!(face_path.joint, Joint::CellByCell) => {
                self.join(face_path, (item, path))
            }
            None => self.join_pairs(face_path, (item, &path)),
        }
    }

    fn join(&mut self, mut face_path: FacePath, (item, path): (Item, Path)) -> Item {
        let named = face_path.faces().next();
        let indices = named.map_or_else(Vec::new, |at| self.face_indices(at));
        let (from, to) = (self.ends(face_path.from, named), self.ends(face_path.to, named));
        face_path.first = self.next_conductor();
        let whole = indices.iter().any(|index| !index.is_empty());
        if whole {
            self.register(&face_path.name, item);
        }
        if !indices.is_empty() {
            let mut last: Option<(f64, Law)> = None;
            for (cell, parts) in self.joined_cells(&face_path) {
                let (name, ends) =
                    (format!("{}{}", face_path.name, indices[cell]), (from[cell], to[cell]));
                let same = last.take().filter(|(of, _)| of.to_bits() == parts.to_bits());
                let law = same.map(|(_, law)| law).unwrap_or_else(|| {
                    self.shared_law(&face_path.name, path.clone().shared(parts))
                });
                self.alike(&name, face_path.kind, ends, &law);
                last = Some((parts, law));
            }
        }
        face_path.end = self.next_conductor();
        if whole {
            self.inner_conductors(face_path.first, item);
        }
        self.parts.face_paths.push(face_path);
        item
    }

    /// The cells of the face that a path ends at, or of its patch, with the number of parts of the
    /// path, if all were as large as that of the cell.
    fn joined_cells(&self, face_path: &FacePath) -> Vec<(usize, f64)> {
        if let Some(patch) = face_path.patch() {
            let shares = self.shares(patch).into_iter();
            return shares.map(|(cell, share)| (cell as usize, share.recip())).collect();
        }
        let parts = face_path.faces().next().map_or_else(Vec::new, |at| self.parts_of(at));
        parts.into_iter().enumerate().collect()
    }

    /// The indices of the cells of a face, as they end names.
    fn face_indices(&self, at: GridFace) -> Vec<String> {
        let Some(grid) = self.parts.grids.get(at.grid.index()) else { return Vec::new() };
        grid.face_places(at.face).map(|place| grid.face_indices(at.face, place)).collect()
    }

    /// For each cell of a face the number of parts of it, if all were as large as that of the cell.
    fn parts_of(&self, at: GridFace) -> Vec<f64> {
        let Some(grid) = self.parts.grids.get(at.grid.index()) else { return Vec::new() };
        grid.face_places(at.face).map(|place| grid.parts_of_face(at.face, place)).collect()
    }

    /// The ends at a terminal, one for each cell of the face that names the parts.
    pub(super) fn ends(&mut self, terminal: Terminal, named: Option<GridFace>) -> Vec<End> {
        match terminal {
            Terminal::End(end) => {
                vec![
                    end;
                    named.map_or(0, |at| self.parts.grids[at.grid.index()].face_count(at.face))
                ]
            }
            Terminal::Stream(id) => named.map_or_else(Vec::new, |at| self.rows_of(id, at)),
            Terminal::Patch(GridPatch { at, .. }) | Terminal::Face(at) => {
                self.surfaces(at.grid, at.face).into_iter().map(End::Node).collect()
            }
        }
    }

    /// Refuses a law of a whole part at a face of several cells.
    fn whole_problem(&self, of: &FacePath, item: Item, path: &Path) -> Option<BuildErrorKind> {
        let declared = path.formula().declaration();
        let cells = |at: GridFace| self.parts.grids[at.grid.index()].face_count(at.face);
        let many = declared.extent == Extent::Whole && of.faces().any(|at| cells(at) > 1);
        let end = if matches!(of.from, Terminal::Face(_)) { Field::From } else { Field::To };
        many.then_some(BuildErrorKind::WholeLaw { item, end, law: declared.name })
    }

    /// Why a path cannot end where it should.
    fn face_path_problem(
        &self,
        face_path: &FacePath,
        item: Item,
        stream: bool,
    ) -> Option<BuildErrorKind> {
        let faces: Vec<GridFace> = face_path.faces().collect();
        if faces.iter().any(|at| at.grid.index() >= self.parts.grids.len()) {
            return Some(BuildErrorKind::ForeignId { item });
        }
        if stream {
            return Some(BuildErrorKind::StreamIntoFace { item });
        }
        let grid = |at: GridFace| &self.parts.grids[at.grid.index()];
        if let Some(&face) = faces.iter().find(|at| !grid(**at).form().has(at.face)) {
            let name = grid(face).face_name(face.face);
            return Some(BuildErrorKind::NoFace { item, face, name });
        }
        let [a, b] = faces[..] else { return None };
        if face_path.patch().is_some() {
            let names = [face_path.from, face_path.to].map(|end| self.parts.terminal_name(end));
            return Some(BuildErrorKind::FaceShapes { item, faces: [a, b], names });
        }
        let kind = |at: GridFace| match grid(at).form() {
            Form::Block => None,
            Form::Cylinder { .. } => Some(at.face.axis()),
        };
        let both_curved = kind(a) == Some(0) && a.face == b.face;
        if kind(a) != kind(b) || both_curved {
            let names = [a, b].map(|at| grid(at).face_name(at.face));
            return Some(BuildErrorKind::FaceShapes { item, faces: [a, b], names });
        }
        kind(a)?;
        let cells = |at: GridFace| at.face.along().map(|axis| grid(at).cells[axis]);
        let name = |at: GridFace| grid(at).face_name(at.face);
        let (cells, names) = ([cells(a), cells(b)], [name(a), name(b)]);
        (cells[0] != cells[1]).then_some(BuildErrorKind::FaceCells {
            item,
            faces: [a, b],
            names,
            cells,
        })
    }

    /// The directions and faces of a grid; `None` if it is not of this builder.
    pub fn form(&self, grid: GridId) -> Option<Form> {
        Some(self.parts.grids.get(grid.index())?.form())
    }

    /// States the area in m^2 that a path with an exchange area belongs to. It has to be that of the
    /// face or patch at which the path ends.
    pub fn declare_face_area(&mut self, path: FacePathId, area: f64) {
        if let Some(path) = self.parts.face_paths.get_mut(path.index()) {
            path.area = Some(Value::Constant(area));
        }
    }

    /// The area of a face, for a path whose area is that of the face; `None` if the grid is not of
    /// this builder.
    pub fn face_area(&self, at: GridFace) -> Option<Input> {
        let grid = self.parts.grids.get(at.grid.index())?;
        Some(typed(grid.area(at.face), Dimension::AREA))
    }

    /// The nodes of a grid with the share of each in its volume, for a source into the whole. In a
    /// cylinder, the surfaces of its mantle and its hole take part if they are connected: a steady
    /// temperature with a uniform heat is then exact. Connect them first.
    pub fn shares_of_volume(&self, grid: GridId) -> Vec<(NodeId, f64)> {
        let Some(grid) = self.parts.grids.get(grid.index()) else { return Vec::new() };
        let heated = grid.places([0; 3]).flat_map(|at| grid.heated(at));
        heated.map(|(node, share)| (NodeId(node), share)).collect()
    }

    /// The surfaces of a face with the share of each in its area, for a source into the face.
    pub fn shares_of_face(&mut self, at: GridFace) -> Vec<(NodeId, f64)> {
        let nodes = self.surfaces(at.grid, at.face);
        let parts = self.parts_of(at);
        nodes.into_iter().zip(parts).map(|(node, parts)| (node, parts.recip())).collect()
    }
}

impl Path {
    /// The area that it names.
    fn area(&self) -> Option<Value> {
        let key = self.formula().declaration().area.first()?;
        Some(self.value(key)?.value.clone())
    }

    /// One of `count` equal parts of it, side by side.
    pub(super) fn shared(self, count: f64) -> Self {
        let times = |factor: f64| {
            move |input: Input| Input { value: scaled(&input.value, factor), ..input }
        };
        match self.formula().declaration().extent {
            Extent::Divided(keys) => {
                keys.iter().fold(self, |path, key| path.with(key, times(1.0 / count)))
            }
            Extent::Multiplied(key) => self.with(key, times(count)),
            Extent::Whole => self,
        }
    }
}
