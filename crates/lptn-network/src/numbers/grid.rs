//! Checks the numbers of grids and of the paths that end at their faces.

use std::f64::consts::TAU;

use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{FacePathId, Field, GridId, Item};
use crate::numbers::Work;
use crate::parts::Parts;
use crate::parts::grid::{FacePath, Grid, GridFace, Substance};
use crate::parts::overlap::{Along, Joint, Overlap, Placement, SAME, is_whole};
use crate::parts::shape::Shape;
use crate::value::Value;
use lptn_laws::Range;

/// An angle this close to the full circle, as a share of it, is the full circle.
const CLOSED: f64 = 1e-12;

/// Rounding of a ratio of radii that is computed twice.
const RATIO: f64 = 1e-12;

/// The radii in m for which the rings of a round body are made, by the parameters as they are
/// written; stand-ins if these are not the radii of a body, which is reported later. `None` for a
/// block.
pub(crate) fn ring_radii(parts: &Parts, shape: &Shape) -> Option<[f64; 2]> {
    let Shape::Cylinder { r_in, r_out, .. } = shape else { return None };
    let Some(r_in) = r_in else { return Some([0.0, 1.0]) };
    let mut scope = as_written(parts, &[r_in, r_out]);
    let [inner, outer] = [r_in, r_out].map(|r| r.at(&mut scope).unwrap_or(f64::NAN));
    let sound = inner > 0.0 && inner < outer && outer.is_finite();
    Some(if sound { [inner, outer] } else { [0.5, 1.0] })
}

/// An evaluation of these values by the parameters as they are written.
pub(super) fn as_written(parts: &Parts, values: &[&Value]) -> Evaluation {
    let scope = Evaluation::new(&parts.layout, &[]);
    let mut work = Work { parts, scope, errors: Vec::new() };
    if values.iter().any(|value| !matches!(value, Value::Constant(_))) {
        work.parameters(&[]);
    }
    work.scope
}

/// Two faces of blocks along each axis of the second one, by the parameters as they are written.
pub(crate) fn written_along(
    parts: &Parts,
    faces: [GridFace; 2],
    placement: &Placement,
) -> [Along; 2] {
    let sizes = faces.iter().flat_map(|at| parts.grids[at.grid.index()].shape.values());
    let values: Vec<&Value> = sizes.chain(placement.offset.iter().flatten()).collect();
    parts.along(faces, placement, &mut as_written(parts, &values))
}

fn differ(a: f64, b: f64) -> bool {
    (a - b).abs() > SAME * a.abs().max(b.abs())
}

impl Work<'_> {
    /// Checks the shared values of the cells of each grid once.
    pub(crate) fn check_grids(&mut self) {
        let parts = self.parts;
        for (i, grid) in parts.grids.iter().enumerate() {
            let item = Item::Grid(GridId::from_len(i));
            match &grid.shape {
                Shape::Block(size) => size.iter().for_each(|length| {
                    self.constant(item, Field::Size, length, Range::Positive);
                }),
                Shape::Cylinder { .. } => self.check_cylinder(GridId::from_len(i), grid),
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
    /// touch at the cells for which they are.
    pub(crate) fn check_face_paths(&mut self) {
        let parts = self.parts;
        for (i, face_path) in parts.face_paths.iter().enumerate() {
            let item = Item::FacePath(FacePathId::from_len(i));
            let faces: Vec<GridFace> = face_path.faces().collect();
            let (mut common, before) = (None, self.errors.len());
            if let ([a, b], true) = (&faces[..], face_path.conductors().len() > 0) {
                match parts.joined_blocks(face_path) {
                    Some(faces) => common = self.check_overlap(item, faces, face_path),
                    None => self.check_sides(item, [*a, *b]),
                }
            }
            if self.errors.len() == before && face_path.conductors().len() > 0 {
                self.check_area(item, face_path, common);
            }
        }
    }

    /// Checks the area that is given: that of the face, or the common one of two.
    fn check_area(&mut self, item: Item, face_path: &FacePath, common: Option<f64>) {
        let parts = self.parts;
        let constant = face_path.area.as_ref().filter(|area| parts.reads(area).is_constant());
        let (Some(area), Some(face)) = (constant, face_path.faces().next()) else { return };
        let given = area.at(&mut self.scope).unwrap_or(f64::NAN);
        let names: Vec<String> = face_path.faces().map(|at| parts.face_name(at)).collect();
        let whole = self.sides(face).into_iter().product::<f64>();
        let (name, area) = match common {
            _ if let Some(patch) = face_path.patch() => {
                let grid = &parts.grids[face.grid.index()];
                let portion = grid.patch(patch).parts.portion;
                (format!("the patch `{}`", grid.patch_name(patch)), portion * whole)
            }
            Some(area) => (format!("the overlap of `{}`", names.join("` and `")), area),
            None => (format!("the face `{}`", names[0]), whole),
        };
        if differ(given, area) {
            self.error(item, BuildErrorKind::FaceArea { item, given, face, name, area });
        }
    }

    /// Checks that two faces of blocks touch, cell by cell if they are joined so; the area that they
    /// have in common otherwise.
    fn check_overlap(
        &mut self,
        item: Item,
        faces: [GridFace; 2],
        face_path: &FacePath,
    ) -> Option<f64> {
        let (parts, placement) = (self.parts, &face_path.placement);
        for value in placement.offset.iter().flatten() {
            self.constant(item, Field::Offset, value, Range::Finite);
        }
        let along = parts.along(faces, placement, &mut self.scope);
        let names = faces.map(|at| parts.face_name(at));
        match (&face_path.joint, Overlap::of(along, placement)) {
            (Joint::CellByCell, _) if !is_whole(&along, placement) => {
                self.error(item, BuildErrorKind::FacesMoved { item, faces, names });
                None
            }
            (Joint::CellByCell, _) => None,
            (_, Some(overlap)) => Some(overlap.area),
            (_, None) => {
                let most = along.map(|axis| axis.most_offset());
                self.error(item, BuildErrorKind::FacesApart { item, faces, names, most });
                None
            }
        }
    }

    /// Checks radii, length and angle. Rings were made for one ratio of the radii.
    fn check_cylinder(&mut self, id: GridId, grid: &Grid) {
        let Shape::Cylinder { r_in, r_out, length, angle } = &grid.shape else { return };
        let (item, of) = (Item::Grid(id), |key| Field::of_law(key).unwrap_or(Field::Size));
        let before = self.errors.len();
        let outer = self.constant(item, of("r_out"), r_out, Range::Positive);
        self.constant(item, of("length"), length, Range::Positive);
        let angle = angle.as_ref().map(|a| self.constant(item, Field::Sector, a, Range::Positive));
        if let Some(angle) = angle.filter(|angle| *angle > TAU * (1.0 - CLOSED)) {
            self.error(item, BuildErrorKind::GridAngle { grid: id, angle });
        }
        let Some(r_in) = r_in else { return };
        let inner = self.constant(item, of("r_in"), r_in, Range::Positive);
        if self.errors.len() > before {
            return;
        }
        if inner >= outer {
            let fields = ["r_in", "r_out"].map(of);
            return self.error(item, BuildErrorKind::Radii { item, fields, inner, outer });
        }
        let hole = grid.rings.as_ref().map_or(f64::NAN, |rings| rings.hole);
        if (inner / outer - hole).abs() > RATIO {
            let ratios = [hole, inner / outer];
            self.error(item, BuildErrorKind::GridRatio { grid: id, ratios });
        }
    }

    fn check_sides(&mut self, item: Item, faces: [GridFace; 2]) {
        let radii = faces.map(|face| self.outer_radius(face));
        if faces.iter().any(|at| at.face.axis() != 0) && differ(radii[0], radii[1]) {
            let names = faces.map(|at| self.parts.face_name(at));
            return self.error(item, BuildErrorKind::FaceShapes { item, faces, names });
        }
        let sides = faces.map(|face| self.sides(face));
        if (0..2).any(|side| differ(sides[0][side], sides[1][side])) {
            let names = faces.map(|at| self.parts.face_name(at));
            self.error(item, BuildErrorKind::FaceSides { item, faces, names, sides });
        }
    }

    /// The two lengths of a face in m.
    fn sides(&mut self, at: GridFace) -> [f64; 2] {
        let parts = self.parts;
        let mut number = |value: &Value| value.at(&mut self.scope).unwrap_or(f64::NAN);
        match &parts.grids[at.grid.index()].shape {
            Shape::Block(size) => at.face.along().map(|axis| number(&size[axis])),
            Shape::Cylinder { r_in, r_out, length, angle } => {
                let [r_out, length] = [r_out, length].map(&mut number);
                let r_in = r_in.as_ref().map_or(0.0, &mut number);
                let angle = angle.as_ref().map_or(TAU, number);
                match at.face.axis() {
                    0 => [angle * if at.face.is_far() { r_out } else { r_in }, length],
                    1 => [r_out - r_in, length],
                    _ => [r_out - r_in, 0.5 * angle * (r_out + r_in)],
                }
            }
        }
    }

    /// The outer radius of a round body in m; 0 of a block.
    fn outer_radius(&mut self, at: GridFace) -> f64 {
        match &self.parts.grids[at.grid.index()].shape {
            Shape::Block(_) => 0.0,
            Shape::Cylinder { r_out, .. } => r_out.at(&mut self.scope).unwrap_or(f64::NAN),
        }
    }
}
