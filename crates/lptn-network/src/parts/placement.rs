//! Lengths and places of faces that are joined.

use crate::evaluation::Evaluation;
use crate::parts::Parts;
use crate::parts::grid::{FacePath, GridFace};
use crate::parts::overlap::{Along, Placement, Side};
use crate::parts::shape::{Form, Shape};
use crate::value::Value;

impl Parts {
    pub(crate) fn face_name(&self, at: GridFace) -> String {
        self.grids[at.grid.index()].face_name(at.face)
    }

    /// The faces of blocks that a path joins.
    pub(crate) fn joined_blocks(&self, path: &FacePath) -> Option<[GridFace; 2]> {
        let faces: Vec<GridFace> = path.faces().collect();
        let block = |at: &GridFace| {
            self.grids.get(at.grid.index()).is_some_and(|grid| grid.form() == Form::Block)
        };
        match faces[..] {
            [a, b] if block(&a) && block(&b) => Some([a, b]),
            _ => None,
        }
    }

    /// The two faces along each axis of the second one, with the numbers of `scope`; NaN for those
    /// without a value.
    pub(crate) fn along(
        &self,
        faces: [GridFace; 2],
        placement: &Placement,
        scope: &mut Evaluation,
    ) -> [Along; 2] {
        let mut number = |value: &Value| value.at(scope).unwrap_or(f64::NAN);
        let [from, to] = faces.map(|at| self.sides_of(at, &mut number));
        let offset = placement.offset.as_ref();
        let offset = offset.map_or([0.0; 2], |both| [&both[0], &both[1]].map(&mut number));
        [0, 1].map(|axis| {
            let (on, reversed) = placement.on(axis);
            Along { sides: [from[on], to[axis]], offset: offset[axis], reversed }
        })
    }

    fn sides_of(&self, at: GridFace, number: &mut impl FnMut(&Value) -> f64) -> [Side; 2] {
        let grid = &self.grids[at.grid.index()];
        at.face.along().map(|axis| {
            let length = match &grid.shape {
                Shape::Block(size) => number(&size[axis]),
                Shape::Cylinder { .. } => f64::NAN,
            };
            Side { length, cells: grid.cells[axis] }
        })
    }
}
