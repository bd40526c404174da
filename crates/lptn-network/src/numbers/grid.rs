//! Checks the numbers of grids and of the paths that end at their faces.

use crate::error::BuildErrorKind;
use crate::id::{FacePathId, Field, GridId, Item};
use crate::numbers::Work;
use crate::parts::grid::{GridFace, Substance};
use lptn_laws::Range;

/// Largest relative difference of two areas that are meant to be the same: numbers are rounded to a
/// few digits.
const SAME: f64 = 1e-3;

fn differ(a: f64, b: f64) -> bool {
    (a - b).abs() > SAME * a.abs().max(b.abs())
}

impl Work<'_> {
    /// Checks the shared values of the cells of each grid once.
    pub(crate) fn check_grids(&mut self) {
        let parts = self.parts;
        for (i, grid) in parts.grids.iter().enumerate() {
            let item = Item::Grid(GridId::from_len(i));
            for length in &grid.size {
                self.constant(item, Field::Size, length, Range::Positive);
            }
            for k in &grid.conductivity {
                self.property(item, Field::Conductivity, k);
            }
            if let Substance::Properties { density, cp } = &grid.substance {
                self.constant(item, Field::Density, density, Range::Positive);
                self.property(item, Field::SpecificHeat, cp);
            }
            if let Some(initial) = &grid.initial {
                self.constant(item, Field::Initial, initial, Range::Temperature);
            }
        }
    }

    /// Checks that a path has the area of the face it ends at, and that two faces that are joined
    /// are of the same size.
    pub(crate) fn check_face_paths(&mut self) {
        let parts = self.parts;
        for (i, face_path) in parts.face_paths.iter().enumerate() {
            let item = Item::FacePath(FacePathId::from_len(i));
            let faces: Vec<GridFace> = face_path.faces().collect();
            if let ([a, b], true) = (&faces[..], face_path.conductors().len() > 0) {
                self.check_sides(item, [*a, *b]);
            }
            let constant = face_path.area.as_ref().filter(|area| parts.reads(area).is_constant());
            if let (Some(area), Some(&face)) = (constant, faces.first()) {
                let given = area.at(&mut self.scope).unwrap_or(f64::NAN);
                let [u, v] = self.sides(face);
                if differ(given, u * v) {
                    let name = parts.grids[face.grid.index()].face_name(face.face);
                    self.error(
                        item,
                        BuildErrorKind::FaceArea { item, given, face, name, area: u * v },
                    );
                }
            }
        }
    }

    fn check_sides(&mut self, item: Item, faces: [GridFace; 2]) {
        let sides = faces.map(|face| self.sides(face));
        if (0..2).any(|side| differ(sides[0][side], sides[1][side])) {
            let names = faces.map(|at| self.parts.grids[at.grid.index()].face_name(at.face));
            self.error(item, BuildErrorKind::FaceSides { item, faces, names, sides });
        }
    }

    /// The two lengths of a face in m.
    fn sides(&mut self, at: GridFace) -> [f64; 2] {
        let grid = &self.parts.grids[at.grid.index()];
        at.face.along().map(|axis| grid.size[axis].at(&mut self.scope).unwrap_or(f64::NAN))
    }
}
