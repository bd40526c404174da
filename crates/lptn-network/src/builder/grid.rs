//! Adds grids: their cells, surfaces and inner paths.

use std::sync::Arc;

use lptn_laws::{Formula, Kind};
use lptn_units::{Dimension, Type};

use crate::builder::{NetworkBuilder, Path, make_room};
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, End, Field, GridId, Item, NodeId};
use crate::law::Law;
use crate::parts::grid::{Face, Grid, Inner, MOST_CELLS, Substance};
use crate::parts::grid_names::PathNames;
use crate::parts::label::Label;
use crate::value::{Input, Size, Value};

/// The input of a grid: see [`NetworkBuilder::grid`].
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
    /// Adds a block of one material, cut into equal cells.
    ///
    /// A cell is a node named `NAME[i,j,k]`, with as many indices as there are counts of cells,
    /// from 1; the path from it to the next one along x is `NAME.x[i,j,k]`. Faces are named
    /// `NAME.x0` to `NAME.z1`; see [`NetworkBuilder::surfaces`] and [`NetworkBuilder::connect`].
    pub fn grid(&mut self, name: &str, block: GridBlock) -> GridId {
        let id = GridId::from_len(self.parts.grids.len());
        let item = Item::Grid(id);
        let length = Type::of(Dimension::LENGTH);
        let (cells, axes) = self.divisions(name, id, &block.cells);
        let size = block.size.map(|s| self.typed((name, item, Field::Size), s, length));
        let k = Type::of(Dimension::CONDUCTIVITY);
        let conductivity =
            block.conductivity.map(|v| self.typed((name, item, Field::Conductivity), v, k));
        let capacity = self.cell_capacity((name, item), &block.substance, (&size, cells));
        let initial = block
            .initial
            .map(|t| self.typed((name, item, Field::Initial), t, Type::ABSOLUTE_TEMPERATURE));
        let substance = match block.substance {
            Substance::Material(material) => Substance::Material(material),
            Substance::Properties { density, cp } => {
                Substance::Properties { density: density.value, cp: cp.value }
            }
        };
        let first =
            u32::try_from(self.parts.nodes.len()).expect("a network holds fewer than 2^32 nodes");
        let (name, paths, surfaces) = (name.to_owned(), [None; 3], [None; 6]);
        let grid = Grid {
            name,
            cells,
            axes,
            size,
            conductivity,
            substance,
            initial,
            first,
            paths,
            surfaces,
        };
        let errors = self.errors.len();
        self.register(&grid.name, item);
        if self.errors.len() == errors {
            self.check_name(&format!("{}{}", grid.name, grid.indices([0; 3])), item);
        }
        self.parts.grids.push(grid.clone());
        self.cells(&grid, item, capacity);
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

    /// The capacity of one cell.
    fn cell_capacity(
        &mut self,
        (name, item): (&str, Item),
        substance: &Substance<Input>,
        (size, cells): (&[Value; 3], [usize; 3]),
    ) -> Option<Input> {
        let share = 1.0 / cells.iter().product::<usize>() as f64;
        let volume = product(size.iter().cloned().chain([Value::Constant(share)]).collect());
        match substance {
            Substance::Material(material) => {
                let lump = self.lump(*material, Size::Volume(typed(volume, Dimension::VOLUME)));
                if lump.is_none() {
                    let known = &self.parts.materials[material.index()];
                    let field =
                        if known.cp.is_none() { Field::SpecificHeat } else { Field::Density };
                    self.error(name, BuildErrorKind::NoProperty { item, field });
                }
                lump
            }
            Substance::Properties { density, cp } => {
                let at = |field| (name, item, field);
                let density =
                    self.typed(at(Field::Density), density.clone(), Type::of(Dimension::DENSITY));
                let cp = self.typed(
                    at(Field::SpecificHeat),
                    cp.clone(),
                    Type::of(Dimension::SPECIFIC_HEAT),
                );
                Some(typed(product(vec![volume, density, cp]), Dimension::CAPACITY))
            }
        }
    }

    fn cells(&mut self, grid: &Grid, whole: Item, capacity: Option<Input>) {
        // without a capacity there is an error already
        let capacity = capacity.unwrap_or_else(|| typed(Value::Constant(1.0), Dimension::CAPACITY));
        let initial = grid.initial.clone();
        let initial = initial.map(|value| Input {
            value,
            ty: Type::ABSOLUTE_TEMPERATURE,
            deviation: None,
            lump: None,
        });
        make_room(&mut self.parts.nodes, grid.count());
        for at in grid.places([0; 3]) {
            let name = format!("{}{}", grid.name, grid.indices(at));
            self.push_node(&name, Some(capacity.clone()), initial.clone(), false);
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
        let law = self.shared_law(&grid.name, grid.path(axis, 1.0));
        let first = self.next_conductor();
        if let Some(known) = self.parts.grids.last_mut() {
            known.paths[axis] = Some(first);
        }
        let names = Arc::new(PathNames::new(grid, axis));
        let mut less = [0; 3];
        less[axis] = 1;
        for (place, at) in (0..).zip(grid.places(less)) {
            let next = [0, 1, 2].map(|other| at[other] + less[other]);
            let [from, to] = [at, next].map(|at| End::Node(NodeId(grid.first + grid.offset(at))));
            let label = Label::Inner(Arc::clone(&names), place);
            self.push_law(label, Kind::Conduction, (from, to), law.clone());
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

    /// Number of nodes and of conductors so far.
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
    /// not of this builder.
    pub fn surfaces(&mut self, grid: GridId, face: Face) -> Vec<NodeId> {
        let Some(known) = self.parts.grids.get(grid.index()) else { return Vec::new() };
        if known.surfaces[face as usize].is_some() {
            return known.surfaces(face).collect();
        }
        let (whole, known) = (Item::Grid(grid), known.clone());
        let first =
            u32::try_from(self.parts.nodes.len()).expect("a network holds fewer than 2^32 nodes");
        let first_path = self.next_conductor();
        let law = self.shared_law(&known.name, known.path(face.axis(), 0.5));
        let mut nodes = Vec::with_capacity(known.face_count(face));
        for at in known.face_places(face) {
            let indices = known.face_indices(face, at);
            let surface = self.massless(&format!("{}{indices}", known.face_name(face)));
            let cell = End::Node(NodeId(known.first + known.offset(at)));
            let name = format!("{}.cell{indices}", known.face_name(face));
            self.alike(&name, Kind::Conduction, (cell, surface.into()), &law);
            nodes.push(surface);
        }
        let end =
            u32::try_from(self.parts.nodes.len()).expect("a network holds fewer than 2^32 nodes");
        self.parts.grids[grid.index()].surfaces[face as usize] = Some(first);
        // the one surface of a rod's end has the name of the face and is not an inner node
        if known.face_axes(face).next().is_some() {
            self.parts.inner_nodes.push(Inner { first, end, whole });
        }
        self.inner_conductors(first_path, whole);
        nodes
    }
}

impl Grid {
    /// Conduction along an axis through this part of a cell.
    fn path(&self, axis: usize, part: f64) -> Path {
        let across = [0, 1, 2].into_iter().filter(|other| *other != axis);
        let (sides, counts): (Vec<Value>, Vec<f64>) =
            across.map(|other| (self.size[other].clone(), self.cells[other] as f64)).unzip();
        let share = counts.iter().product::<f64>().recip();
        let area = product(sides.into_iter().chain([Value::Constant(share)]).collect());
        let thickness = scaled(&self.size[axis], part / self.cells[axis] as f64);
        let k = typed(self.conductivity[axis].clone(), Dimension::CONDUCTIVITY);
        let (area, thickness) = (typed(area, Dimension::AREA), typed(thickness, Dimension::LENGTH));
        Path::new(Formula::Slab, [k, area, thickness])
    }
}
