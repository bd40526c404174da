//! Adds grids: their cells, surfaces and inner paths.

use std::f64::consts::TAU;
use std::sync::Arc;

use lptn_laws::Kind;
use lptn_units::{Dimension, Type};

use crate::builder::{NetworkBuilder, Path, make_room};
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, End, Field, GridId, Item, MaterialId, NodeId};
use crate::law::Law;
use crate::numbers::grid::ring_radii;
use crate::parts::grid::{Face, Grid, Inner, MOST_CELLS, Substance, places_of};
use crate::parts::grid_names::PathNames;
use crate::parts::label::Label;
use crate::parts::rings::Rings;
use crate::parts::shape::Shape;
use crate::value::{Input, Size, Value};

/// A block as the input of a grid: see [`NetworkBuilder::grid`].
#[derive(Clone, Debug)]
pub struct GridBlock {
    /// Its lengths along x, y and z; constant.
    pub size: [Input; 3],
    /// Number of cells along x, and along y and z if it is divided there too: one to three counts
    /// of at least 1, together at most [`MOST_CELLS`].
    pub cells: Vec<usize>,
    /// Its thermal conductivity along x, y and z; it may depend on `T`: its mean over the
    /// temperatures between two neighbours counts.
    pub conductivity: [Input; 3],
    /// Its material, or density and specific heat capacity.
    pub substance: Substance<Input>,
    /// Its temperature at the start.
    pub initial: Option<Input>,
}

/// A cylinder, or a sector of one, as the input of a grid: see [`NetworkBuilder::grid`].
#[derive(Clone, Debug)]
pub struct GridCylinder {
    /// Inner radius, a length; constant. `None` or 0 without a hole.
    pub r_in: Option<Input>,
    /// Outer radius, a length above `r_in`; constant. Its ratio to `r_in` may not change with
    /// parameters: shares of heat and means over rings follow from it.
    pub r_out: Input,
    /// Length along the axis; constant.
    pub length: Input,
    /// Angle of a sector, above 0 and below 360 deg; constant. `None` or the number 360 deg for the
    /// full circle.
    pub angle: Option<Input>,
    /// Number of rings, of cells around the axis, and along it: one to three counts of at least 1,
    /// together at most [`MOST_CELLS`].
    pub cells: Vec<usize>,
    /// Its thermal conductivity along r, phi and z, as that of a block.
    pub conductivity: [Input; 3],
    /// Its material, or density and specific heat capacity.
    pub substance: Substance<Input>,
    /// Its temperature at the start.
    pub initial: Option<Input>,
}

/// A block or a cylinder as the input of a grid: see [`NetworkBuilder::grid`].
#[derive(Clone, Debug)]
pub struct GridBody {
    shape: Shape<Input>,
    cells: Vec<usize>,
    conductivity: [Input; 3],
    substance: Substance<Input>,
    initial: Option<Input>,
}

impl From<GridBlock> for GridBody {
    fn from(block: GridBlock) -> Self {
        let GridBlock { size, cells, conductivity, substance, initial } = block;
        Self { shape: Shape::Block(size), cells, conductivity, substance, initial }
    }
}

impl From<GridCylinder> for GridBody {
    fn from(cylinder: GridCylinder) -> Self {
        let GridCylinder { r_in, r_out, length, angle, cells, conductivity, substance, initial } =
            cylinder;
        let is = |number: f64| move |input: &Input| matches!(input.value, Value::Constant(value) if (value - number).abs() <= ROUNDED);
        let r_in = r_in.filter(|r_in| r_in.ty != LENGTH || !is(0.0)(r_in));
        let angle = angle.filter(|angle| angle.ty != ANGLE || !is(TAU)(angle));
        let shape = Shape::Cylinder { r_in, r_out, length, angle };
        Self { shape, cells, conductivity, substance, initial }
    }
}

/// Rounding of an angle in rad, or of a radius in m.
const ROUNDED: f64 = 1e-14;
const LENGTH: Type = Type::of(Dimension::LENGTH);
const ANGLE: Type = Type::of(Dimension::ANGLE);

/// A value whose type is known.
pub(crate) fn typed(value: Value, dimension: Dimension) -> Input {
    Input { value, ty: Type::of(dimension), deviation: None, lump: None }
}

/// A value times a number.
pub(crate) fn scaled(value: &Value, factor: f64) -> Value {
    match value {
        Value::Constant(number) => Value::Constant(number * factor),
        other => Value::Product(vec![other.clone(), Value::Constant(factor)].into()),
    }
}

pub(crate) fn product(values: Vec<Value>) -> Value {
    Value::Product(values.into())
}

const FEW: &str = "a network has fewer than 2^32 conductors";

impl NetworkBuilder {
    /// Adds a block or a cylinder of one material, cut into cells: those of a block are equal, those
    /// of a cylinder have equal widths between their nodes.
    ///
    /// A cell is a node named `NAME[i,j,k]`, with as many indices as there are counts of cells,
    /// from 1; the path from it to the next one along x is `NAME.x[i,j,k]`. Faces are named
    /// `NAME.x0` to `NAME.z1`. A cylinder has r, phi and z instead, and the faces `NAME.inner`,
    /// `NAME.outer`, `NAME.phi0`, `NAME.phi1`, `NAME.z0` and `NAME.z1`; see [`NetworkBuilder::surfaces`] and [`NetworkBuilder::connect`].
    pub fn grid(&mut self, name: &str, body: impl Into<GridBody>) -> GridId {
        let body: GridBody = body.into();
        let id = GridId::from_len(self.parts.grids.len());
        let item = Item::Grid(id);
        let (cells, axes) = self.divisions(name, id, &body.cells);
        let shape = self.shape((name, item), body.shape);
        let rings = ring_radii(&self.parts, &shape).map(|radii| Rings::new(radii, cells[0]));
        let k = Type::of(Dimension::CONDUCTIVITY);
        let conductivity =
            body.conductivity.map(|v| self.typed((name, item, Field::Conductivity), v, k));
        let initial = body
            .initial
            .map(|t| self.typed((name, item, Field::Initial), t, Type::ABSOLUTE_TEMPERATURE));
        let substance = self.substance((name, item), body.substance);
        let first = u32::try_from(self.parts.nodes.len())
            .expect("a network contains fewer than 2^32 nodes");
        let (name, paths, surfaces) = (name.to_owned(), [None; 3], [None; 6]);
        let grid = Grid {
            name,
            cells,
            axes,
            shape,
            rings,
            conductivity,
            substance,
            initial,
            first,
            paths,
            surfaces,
            patches: Vec::new(),
        };
        let errors = self.errors.len();
        self.register(&grid.name, item);
        if self.errors.len() == errors {
            self.check_name(&format!("{}{}", grid.name, grid.indices([0; 3])), item);
        }
        self.parts.grids.push(grid.clone());
        self.cells(&grid, item);
        self.inner_paths(&grid, item);
        id
    }

    /// Counts that can be used instead of those given, and the number of counts given.
    fn divisions(&mut self, name: &str, grid: GridId, counts: &[usize]) -> ([usize; 3], usize) {
        if counts.is_empty() || counts.len() > 3 || counts.contains(&0) {
            self.error(name, BuildErrorKind::GridCells { grid, counts: counts.to_vec() });
            return ([1; 3], counts.len().clamp(1, 3));
        }
        let all = counts.iter().try_fold(1_usize, |product, count| product.checked_mul(*count));
        if all.is_none_or(|all| all > MOST_CELLS) {
            self.error(name, BuildErrorKind::GridTooLarge { grid, counts: counts.to_vec() });
            return ([1; 3], counts.len());
        }
        let count = |axis: usize| counts.get(axis).copied().unwrap_or(1);
        ([count(0), count(1), count(2)], counts.len())
    }

    /// The lengths of a body, and its angle.
    fn shape(&mut self, (name, item): (&str, Item), shape: Shape<Input>) -> Shape {
        let mut typed = |field, input, ty| self.typed((name, item, field), input, ty);
        let of = |key| Field::of_law(key).unwrap_or(Field::Size);
        match shape {
            Shape::Block(size) => Shape::Block(size.map(|s| typed(Field::Size, s, LENGTH))),
            Shape::Cylinder { r_in, r_out, length, angle } => Shape::Cylinder {
                r_in: r_in.map(|r| typed(of("r_in"), r, LENGTH)),
                r_out: typed(of("r_out"), r_out, LENGTH),
                length: typed(of("length"), length, LENGTH),
                angle: angle.map(|angle| typed(Field::Sector, angle, ANGLE)),
            },
        }
    }

    fn substance(&mut self, (name, item): (&str, Item), of: Substance<Input>) -> Substance {
        let at = |field| (name, item, field);
        match of {
            Substance::Material(material) => Substance::Material(material),
            Substance::Properties { density, cp } => Substance::Properties {
                density: self.typed(at(Field::Density), density, Type::of(Dimension::DENSITY)),
                cp: self.typed(at(Field::SpecificHeat), cp, Type::of(Dimension::SPECIFIC_HEAT)),
            },
        }
    }

    /// The capacity of a cell; `None` if its material lacks a property.
    fn cell_capacity(&mut self, grid: &Grid, ring: usize) -> Option<Input> {
        let volume = grid.volume(ring);
        match &grid.substance {
            Substance::Material(material) => {
                self.lump(*material, Size::Volume(typed(volume, Dimension::VOLUME)))
            }
            Substance::Properties { density, cp } => {
                let factors = vec![volume, density.clone(), cp.clone()];
                Some(typed(product(factors), Dimension::CAPACITY))
            }
        }
    }

    /// Reports the property that the material of a grid lacks.
    fn check_properties(&mut self, name: &str, (item, material): (Item, MaterialId)) {
        let known = &self.parts.materials[material.index()];
        let field = match (&known.cp, &known.density) {
            (None, _) => Field::SpecificHeat,
            (_, None) => Field::Density,
            _ => return,
        };
        self.error(name, BuildErrorKind::NoProperty { item, field });
    }

    fn cells(&mut self, grid: &Grid, whole: Item) {
        if let Substance::Material(material) = grid.substance {
            self.check_properties(&grid.name, (whole, material));
        }
        let initial = grid.initial.clone().map(|value| Input {
            value,
            ty: Type::ABSOLUTE_TEMPERATURE,
            deviation: None,
            lump: None,
        });
        make_room(&mut self.parts.nodes, grid.count());
        let mut last: Option<(usize, Input)> = None;
        for at in grid.places([0; 3]) {
            let ring = grid.ring(at);
            let known = last.take().filter(|(of, _)| *of == ring).map(|(_, capacity)| capacity);
            // without a capacity there is an error already
            let capacity = known
                .or_else(|| self.cell_capacity(grid, ring))
                .unwrap_or_else(|| typed(Value::Constant(1.0), Dimension::CAPACITY));
            let name = format!("{}{}", grid.name, grid.indices(at));
            self.push_node(&name, Some(capacity.clone()), initial.clone(), false);
            last = Some((ring, capacity));
        }
        let end = grid.first + grid.offset([grid.cells[0], 0, 0]);
        self.parts.inner_nodes.push(Inner { first: grid.first, end, whole });
    }

    /// The paths between neighbours, axis by axis.
    fn inner_paths(&mut self, grid: &Grid, whole: Item) {
        let first = self.next_conductor();
        let axes = (0..3).filter(|&axis| grid.cells[axis] > 1);
        let count = |axis: usize| grid.paths_along(axis).iter().product::<usize>();
        make_room(&mut self.parts.conductors, axes.clone().map(count).sum());
        for axis in axes {
            self.paths_along(grid, axis);
        }
        self.inner_conductors(first, whole);
    }

    /// The paths between neighbours along one axis.
    fn paths_along(&mut self, grid: &Grid, axis: usize) {
        let first = self.next_conductor();
        if let Some(known) = self.parts.grids.last_mut() {
            known.paths[axis] = Some(first);
        }
        let names = Arc::new(PathNames::new(grid, axis));
        let mut last: Option<(usize, Law)> = None;
        for (place, at) in (0..).zip(places_of(grid.paths_along(axis))) {
            let ring = grid.ring(at);
            let known = last.take().filter(|(of, _)| *of == ring).map(|(_, law)| law);
            let law = known.unwrap_or_else(|| self.shared_law(&grid.name, grid.path(axis, ring)));
            let mut next = at;
            next[axis] = (at[axis] + 1) % grid.cells[axis];
            let [from, to] = [at, next].map(|at| End::Node(NodeId(grid.first + grid.offset(at))));
            let label = Label::Inner(Arc::clone(&names), place);
            self.push_law(label, Kind::Conduction, (from, to), law.clone());
            last = Some((ring, law));
        }
    }

    /// The law of the next conductors, which are alike and share its values.
    pub(crate) fn shared_law(&mut self, name: &str, path: Path) -> Law {
        let item = Item::Conductor(ConductorId(self.next_conductor()));
        self.law(name, item, path)
    }

    pub(crate) fn alike(&mut self, name: &str, kind: Kind, ends: (End, End), law: &Law) {
        let id = self.push_law(name.into(), kind, ends, law.clone());
        self.register(name, Item::Conductor(id));
    }

    /// Number of nodes and of conductors up to now.
    pub fn sizes(&self) -> (usize, usize) {
        (self.parts.nodes.len(), self.parts.conductors.len())
    }

    /// The node of this name, if it was added.
    pub fn node_named(&self, name: &str) -> Option<NodeId> {
        match self.parts.item(name) {
            Some(Item::Node(id)) => Some(id),
            _ => None,
        }
    }

    pub(crate) fn next_conductor(&self) -> u32 {
        u32::try_from(self.parts.conductors.len()).expect(FEW)
    }

    /// Notes that the conductors from `first` on are parts of `whole`.
    pub(crate) fn inner_conductors(&mut self, first: u32, whole: Item) {
        let end = self.next_conductor();
        if end > first {
            self.parts.inner_conductors.push(Inner { first, end, whole });
        }
    }

    /// The massless nodes on a face of a grid, `NAME.x1[j,k]` by the indices of the cells along it,
    /// the last one running fastest. The first call makes them, with the path `NAME.x1.cell[j,k]`
    /// from the middle of the cell to each; all paths to the face end there. None if the grid is
    /// not of this builder or has no such face.
    pub fn surfaces(&mut self, grid: GridId, face: Face) -> Vec<NodeId> {
        let known = self.parts.grids.get(grid.index());
        let Some(known) = known.filter(|known| known.form().has(face)) else { return Vec::new() };
        if known.surfaces[face as usize].is_some() {
            return known.surfaces(face).collect();
        }
        let (whole, known) = (Item::Grid(grid), known.clone());
        let first = u32::try_from(self.parts.nodes.len())
            .expect("a network contains fewer than 2^32 nodes");
        let first_path = self.next_conductor();
        let mut last: Option<(usize, Law)> = None;
        let mut nodes = Vec::with_capacity(known.face_count(face));
        for at in known.face_places(face) {
            let indices = known.face_indices(face, at);
            let surface = self.massless(&format!("{}{indices}", known.face_name(face)));
            let cell = End::Node(NodeId(known.first + known.offset(at)));
            let name = format!("{}.cell{indices}", known.face_name(face));
            let ring = known.ring(at);
            let same = last.take().filter(|(of, _)| *of == ring).map(|(_, law)| law);
            let law =
                same.unwrap_or_else(|| self.shared_law(&known.name, known.path_to(face, ring)));
            self.alike(&name, Kind::Conduction, (cell, surface.into()), &law);
            last = Some((ring, law));
            nodes.push(surface);
        }
        let end = u32::try_from(self.parts.nodes.len())
            .expect("a network contains fewer than 2^32 nodes");
        self.parts.grids[grid.index()].surfaces[face as usize] = Some(first);
        // the one surface of a rod's end has the name of the face and is not an inner node
        if known.face_axes(face).next().is_some() {
            self.parts.inner_nodes.push(Inner { first, end, whole });
        }
        self.inner_conductors(first_path, whole);
        nodes
    }
}
