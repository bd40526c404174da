//! Paths between two faces of blocks that overlap in part: one for each pair of cells.

use lptn_laws::{Carries, Extent};
use lptn_units::{Dimension, Type, format_number};

use crate::builder::grid::{product, typed};
use crate::builder::{NetworkBuilder, Path};
use crate::error::BuildErrorKind;
use crate::id::{Field, Item};
use crate::numbers::grid::written_along;
use crate::parts::grid::{Face, FacePath, Grid, GridFace, Terminal, bracketed, places_of};
use crate::parts::overlap::{Along, Joint, Overlap, Placement, is_whole};
use crate::parts::shape::Shape;
use crate::value::{Input, Value};

const LENGTH: Type = Type::of(Dimension::LENGTH);

/// The most pairs of cells that parameters may move.
pub(crate) const MOST_PAIRS: usize = 100_000;

/// The lengths that cells of two faces share along one axis, as parameters move them.
struct Moving {
    /// By the cell of the first face along the axis of the second, then by that of the second.
    cells: Vec<Vec<Value>>,
    /// The common length of the faces.
    common: Value,
    /// The expression of the common length.
    text: String,
}

impl NetworkBuilder {
    pub(super) fn placed(
        &mut self,
        (name, item): (&str, Item),
        placement: Placement<Input>,
    ) -> Placement {
        let Placement { offset, axes } = placement;
        let mut typed = |input| self.typed((name, item, Field::Offset), input, LENGTH);
        Placement { offset: offset.map(|both| both.map(&mut typed)), axes }
    }

    /// The area at which two faces touch, for a path whose area is that: of the first face, if they
    /// are equal blocks or cylinders. `None` if a face is not of this builder, or if they do not
    /// touch.
    pub fn common_area(&self, faces: [GridFace; 2], placement: &Placement<Input>) -> Option<Input> {
        let value = |input: &Input| input.value.clone();
        let offset = placement.offset.as_ref().map(|both| [value(&both[0]), value(&both[1])]);
        let placement = Placement { offset, axes: placement.axes };
        let block = |at: &GridFace| {
            let grid = self.parts.grids.get(at.grid.index());
            grid.is_some_and(|grid| matches!(grid.shape, Shape::Block(_)))
        };
        if !faces.iter().all(block) {
            return self.face_area(faces[0]);
        }
        let along = written_along(&self.parts, faces, &placement);
        if is_whole(&along, &placement) {
            return self.face_area(faces[0]);
        }
        let area = match self.is_moving(faces, &placement) {
            false => Value::Constant(Overlap::of(along, &placement)?.area),
            true => {
                let moving = |axis| self.moving((faces, &placement), axis, along[axis]);
                product(vec![moving(0)?.common, moving(1)?.common])
            }
        };
        Some(typed(area, Dimension::AREA))
    }

    /// Finds the cells of two faces of blocks that touch.
    pub(super) fn overlap(
        &mut self,
        path: &mut FacePath,
        item: Item,
        law: &Path,
    ) -> Result<(), BuildErrorKind> {
        let Some(faces) = self.parts.joined_blocks(path) else { return Ok(()) };
        let along = written_along(&self.parts, faces, &path.placement);
        let unknown = along.iter().any(|axis| !axis.common().is_finite());
        if unknown || is_whole(&along, &path.placement) {
            return Ok(());
        }
        let names = faces.map(|at| self.parts.face_name(at));
        let declared = law.formula().declaration();
        if declared.carries == Carries::Radiation || declared.extent == Extent::Whole {
            return Err(unequal(item, faces, names, &along));
        }
        let Some(overlap) = Overlap::of(along, &path.placement) else {
            let most = along.map(|axis| axis.most_offset());
            return Err(BuildErrorKind::FacesApart { item, faces, names, most });
        };
        path.joint = Joint::Fixed(overlap);
        if self.is_moving(faces, &path.placement) {
            let count = along.map(|axis| axis.sides[0].cells * axis.sides[1].cells);
            let moves =
                |axis: usize| self.moving((faces, &path.placement), axis, along[axis]).is_some();
            let divided = matches!(declared.extent, Extent::Divided(_));
            if !divided || count[0] * count[1] > MOST_PAIRS || !moves(0) || !moves(1) {
                return Err(BuildErrorKind::FacesMoving { item, faces, names });
            }
            path.joint = Joint::Moving(all_pairs(&along, &path.placement));
        }
        Ok(())
    }

    /// True if parameters change the lengths or the place of two faces.
    fn is_moving(&self, faces: [GridFace; 2], placement: &Placement) -> bool {
        let sizes = faces.iter().flat_map(|at| {
            let size = self.parts.grids[at.grid.index()].shape.values();
            at.face.along().map(|axis| size[axis])
        });
        let mut values = sizes.chain(placement.offset.iter().flatten());
        values.any(|value| !matches!(value, Value::Constant(_)))
    }

    /// Adds a conductor for each pair of cells.
    pub(super) fn join_pairs(&mut self, mut path: FacePath, (item, law): (Item, &Path)) -> Item {
        let (Terminal::Face(from), Terminal::Face(to)) = (path.from, path.to) else { return item };
        let ends = [path.from, path.to].map(|terminal| self.ends(terminal, None));
        path.first = self.next_conductor();
        let parts = self.parts_of_pairs(&path, [from, to], law);
        let grids = [from, to].map(|at| self.parts.grids[at.grid.index()].clone());
        let named = [from, to]
            .iter()
            .zip(&grids)
            .any(|(at, grid)| grid.face_axes(at.face).next().is_some());
        if named {
            self.register(&path.name, item);
        }
        for (cells, part) in parts {
            let name = format!("{}{}", path.name, indices_of(&grids, [from.face, to.face], cells));
            let end = |side: usize| {
                let second = grids[side].cells[[from, to][side].face.along()[1]];
                ends[side][cells[side][0] * second + cells[side][1]]
            };
            let law = self.shared_law(&path.name, part);
            self.alike(&name, path.kind, (end(0), end(1)), &law);
        }
        path.end = self.next_conductor();
        if named {
            self.inner_conductors(path.first, item);
        }
        self.parts.face_paths.push(path);
        item
    }

    /// The cells of each pair, and the part of the path between them.
    fn parts_of_pairs(
        &self,
        path: &FacePath,
        faces: [GridFace; 2],
        law: &Path,
    ) -> Vec<([[usize; 2]; 2], Path)> {
        let along = || written_along(&self.parts, faces, &path.placement);
        match &path.joint {
            Joint::CellByCell => Vec::new(),
            Joint::Fixed(overlap) => {
                let part = |pair: &crate::parts::overlap::Pair| {
                    (pair.cells, law.clone().shared(pair.share.recip()))
                };
                overlap.pairs.iter().map(part).collect()
            }
            Joint::Moving(cells) => {
                let moving =
                    |axis: usize| self.moving((faces, &path.placement), axis, along()[axis]);
                let (Some(u), Some(v)) = (moving(0), moving(1)) else { return Vec::new() };
                let whole = format!("1 / (({}) * ({}))", u.text, v.text);
                let Ok(whole) = self.expression(&whole, None) else { return Vec::new() };
                let whole = Input::from(whole).value;
                let part = |of: &[[usize; 2]; 2]| {
                    let share = [0, 1].map(|axis| {
                        let moving = [&u, &v][axis];
                        let (on, reversed) = path.placement.on(axis);
                        let first =
                            if reversed { moving.cells.len() - 1 - of[0][on] } else { of[0][on] };
                        moving.cells[first][of[1][axis]].clone()
                    });
                    let factors = share.into_iter().chain([whole.clone()]).collect();
                    (*of, law.clone().times(factors))
                };
                cells.iter().map(part).collect()
            }
        }
    }

    /// The lengths that cells share along an axis of the second face, from the expressions of the
    /// lengths and the offset; `None` if an expression cannot be used here.
    fn moving(
        &self,
        (faces, placement): ([GridFace; 2], &Placement),
        axis: usize,
        along: Along,
    ) -> Option<Moving> {
        let side = |at: GridFace, axis: usize| {
            let values = self.parts.grids[at.grid.index()].shape.values();
            text_of(values[at.face.along()[axis]])
        };
        let (a, b) = (side(faces[0], placement.on(axis).0), side(faces[1], axis));
        let offset = placement.offset.as_ref();
        let offset = offset.map_or("0 [m]".to_owned(), |both| text_of(&both[axis]));
        let start = format!("(0.5 * ({b} - {a}) + {offset})");
        let length =
            |text: &str| Some(Input::from(self.expression(text, Some(LENGTH)).ok()?).value);
        let shared = |from: [f64; 2], to: [f64; 2]| {
            let [f0, f1, t0, t1] = [from[0], from[1], to[0], to[1]].map(format_number);
            format!(
                "max(min({start} + {a} * {f1}, {b} * {t1}) - max({start} + {a} * {f0}, {b} * {t0}), \
                 0 [m])"
            )
        };
        let parts = |side: usize, i: usize| {
            let count = along.sides[side].cells as f64;
            [i as f64 / count, (i + 1) as f64 / count]
        };
        let row = |i: usize| {
            let cells = 0..along.sides[1].cells;
            cells.map(|j| length(&shared(parts(0, i), parts(1, j)))).collect()
        };
        let cells = (0..along.sides[0].cells).map(row).collect::<Option<_>>()?;
        let text = shared([0.0, 1.0], [0.0, 1.0]);
        Some(Moving { cells, common: length(&text)?, text })
    }
}

impl Path {
    /// A part of it, side by side with others, that is its product with these values.
    fn times(self, factors: Vec<Value>) -> Self {
        let Extent::Divided(keys) = self.formula().declaration().extent else { return self };
        let times = |input: Input| {
            let value = product([input.value].into_iter().chain(factors.clone()).collect());
            Input { value, ty: input.ty, deviation: input.deviation, lump: input.lump }
        };
        keys.iter().fold(self, |path, key| path.with(key, times))
    }
}

/// The expression of a length in m.
fn text_of(value: &Value) -> String {
    match value {
        Value::Expression(program) => format!("({})", program.text().trim()),
        Value::Constant(number) => format!("({} [m])", format_number(*number)),
        Value::Product(_) => String::new(),
    }
}

fn all_pairs(along: &[Along; 2], placement: &Placement) -> Vec<[[usize; 2]; 2]> {
    let [u, v] = along.map(|axis| axis.sides.map(|side| side.cells));
    let pairs = places_of([u[0], u[1], v[0]])
        .flat_map(|[i, j, k]| (0..v[1]).map(move |l| [[i, j], [k, l]]));
    let mut cells: Vec<_> = pairs.map(|pair| placement.cells(pair)).collect();
    cells.sort_unstable();
    cells
}

fn indices_of(grids: &[Grid; 2], faces: [Face; 2], cells: [[usize; 2]; 2]) -> String {
    let of = |side: usize| {
        let along = faces[side].along();
        let own = (0..2).filter(move |k| along[*k] < grids[side].axes);
        own.map(move |k| cells[side][k])
    };
    bracketed(of(0).chain(of(1)))
}

/// The error for two faces that have to be equal, but are not.
fn unequal(
    item: Item,
    faces: [GridFace; 2],
    names: [String; 2],
    along: &[Along; 2],
) -> BuildErrorKind {
    let cells = [0, 1].map(|face| along.map(|axis| axis.sides[face].cells));
    if cells[0] != cells[1] {
        return BuildErrorKind::FaceCells { item, faces, names, cells };
    }
    let sides = [0, 1].map(|face| along.map(|axis| axis.sides[face].length));
    BuildErrorKind::FaceSides { item, faces, names, sides }
}
