//! Areas that the cells of a face have in common with a rectangle or a circle.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::id::{GridFace, GridId, GridPatch};
use crate::parts::face::Face;
use crate::parts::grid::Grid;
use crate::parts::patch::{Outline, Patch, PatchParts, PatchProblem};
use crate::parts::rings::Rings;
use crate::parts::shape::Shape;
use crate::value::Value;

/// A patch may extend beyond its face by this share of the length of the face: lengths are rounded.
const ROUNDED: f64 = 1e-6;

/// A face along one of its axes: borders of its cells in m or rad.
struct Borders {
    all: Vec<f64>,
    /// True for radii on an end of a cylinder: cells count by the squares.
    squared: bool,
    /// True around the axis of a full circle.
    closed: bool,
}

impl Borders {
    fn ends(&self) -> [f64; 2] {
        [self.all[0], self.all[self.all.len() - 1]]
    }

    /// Size of an interval; half the difference of squares for radii.
    fn size(&self, [low, high]: [f64; 2]) -> f64 {
        (high - low) * if self.squared { 0.5 * (high + low) } else { 1.0 }
    }

    /// The common size of this interval with each cell.
    fn shared(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let turns: &[f64] = if self.closed { &[-TAU, 0.0, TAU] } else { &[0.0] };
        let with = |cell: &[f64], turn: f64| {
            let common = [cell[0].max(low + turn), cell[1].min(high + turn)];
            if common[1] > common[0] { self.size(common) } else { 0.0 }
        };
        let cell = |cell: &[f64]| turns.iter().map(|turn| with(cell, *turn)).sum();
        self.all.windows(2).map(cell).collect()
    }

    /// An interval by its middle and length, brought into the first turn of a full circle.
    fn interval(&self, middle: f64, length: f64) -> [f64; 2] {
        let middle = if self.closed { middle.rem_euclid(TAU) } else { middle };
        [middle - 0.5 * length, middle + 0.5 * length]
    }

    /// The problem of an interval that does not lie on the face.
    fn outside(&self, along: usize, ends: [f64; 2]) -> Option<PatchProblem> {
        let face = self.ends();
        let tolerance = ROUNDED * (face[1] - face[0]);
        let is_outside = match self.closed {
            true => ends[1] - ends[0] > TAU + tolerance,
            false => ends[0] < face[0] - tolerance || ends[1] > face[1] + tolerance,
        };
        is_outside.then_some(PatchProblem::Outside { along, ends, face })
    }
}

/// Borders of equal cells.
fn equal(length: f64, cells: usize) -> Vec<f64> {
    (0..=cells).map(|i| length * i as f64 / cells as f64).collect()
}

/// Area under a unit circle from -1 to x, above its horizontal diameter.
fn under_arc(x: f64) -> f64 {
    0.5 * (x * (1.0 - x * x).max(0.0).sqrt() + x.asin() + FRAC_PI_2)
}

/// Area of a unit circle to the left of x and below y, which are from -1 to 1.
fn corner(x: f64, y: f64) -> f64 {
    let height = y.abs();
    let reach = (1.0 - height * height).max(0.0).sqrt();
    let mut strip = under_arc(x.min(-reach));
    if x > -reach {
        strip += height * (x.min(reach) + reach);
    }
    if x > reach {
        strip += under_arc(x) - under_arc(reach);
    }
    under_arc(x) + strip.copysign(y)
}

/// Area of a rectangle inside the unit circle around the origin.
fn in_unit_circle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    let at = |x: f64, y: f64| corner(x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0));
    (at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)).max(0.0)
}

impl Grid {
    /// The borders of the cells along the two axes of a face, with lengths in m.
    fn borders(&self, face: Face, number: &mut impl FnMut(&Value) -> f64) -> [Borders; 2] {
        let plain = |all| Borders { all, squared: false, closed: false };
        match (&self.shape, &self.rings) {
            (Shape::Cylinder { r_out, length, angle, .. }, Some(rings)) => {
                let (r_out, length) = (number(r_out), number(length));
                let angle = angle.as_ref().map_or(TAU, number);
                let along = |axis: usize| match axis {
                    0 => Borders { squared: face.axis() == 2, ..plain(radii(rings, r_out)) },
                    1 => Borders {
                        closed: self.form().is_closed(),
                        ..plain(equal(angle, self.cells[1]))
                    },
                    _ => plain(equal(length, self.cells[2])),
                };
                face.along().map(along)
            }
            (shape, _) => {
                let size = shape.values();
                face.along().map(|axis| plain(equal(number(size[axis]), self.cells[axis])))
            }
        }
    }

    /// The cells that a patch covers, with the numbers of `number`.
    pub(crate) fn parts_of_patch(
        &self,
        patch: &Patch,
        number: &mut impl FnMut(&Value) -> f64,
    ) -> Result<PatchParts, PatchProblem> {
        let borders = self.borders(patch.face, number);
        let middle = patch.centre.as_ref().map(|both| [number(&both[0]), number(&both[1])]);
        let lengths = match &patch.outline {
            Outline::Rectangle([a, b]) => [number(a), number(b)],
            Outline::Circle(radius) => [2.0 * number(radius); 2],
        };
        let given = lengths.into_iter().chain(middle.into_iter().flatten());
        let all = given.chain(borders.iter().flat_map(|axis| axis.all.iter().copied()));
        if !all.into_iter().all(f64::is_finite) || lengths.iter().any(|length| *length <= 0.0) {
            return Err(PatchProblem::Unknown);
        }
        let is_circle = matches!(patch.outline, Outline::Circle(_));
        let interval = |axis: usize| {
            let [low, high] = borders[axis].ends();
            borders[axis].interval(middle.map_or(0.5 * (low + high), |m| m[axis]), lengths[axis])
        };
        let mut ends = [interval(0), interval(1)];
        if is_circle && self.rings.is_some() && patch.face.axis() == 0 {
            return Err(PatchProblem::CurvedFace);
        }
        let disc = is_circle && borders[0].squared;
        if disc {
            let hole = self.rings.as_ref().is_some_and(|rings| rings.hole > 0.0);
            if hole || middle.is_some() {
                return Err(PatchProblem::NotADisc);
            }
            ends = [[0.0, 0.5 * lengths[0]], borders[1].ends()];
        }
        for (along, (axis, ends)) in borders.iter().zip(ends).enumerate() {
            axis.outside(along, ends).map_or(Ok(()), Err)?;
        }
        let areas = match is_circle && !disc {
            true => circle(&borders, ends),
            false => rectangle(&borders, ends),
        };
        let face: f64 = borders.iter().map(|axis| axis.size(axis.ends())).product();
        Ok(PatchParts::of(&areas, face))
    }

    /// A patch of this grid.
    pub(crate) fn patch(&self, patch: GridPatch) -> &Patch {
        &self.patches[patch.index as usize]
    }

    /// Its patches, as those of the grid with this id.
    pub(crate) fn patch_ids(&self, grid: GridId) -> impl Iterator<Item = GridPatch> + '_ {
        let faces = (0..).zip(&self.patches);
        faces
            .map(move |(index, patch)| GridPatch { at: GridFace { grid, face: patch.face }, index })
    }

    /// The patch of this name.
    pub(crate) fn patch_named(&self, grid: GridId, name: &str) -> Option<GridPatch> {
        self.patch_ids(grid).find(|patch| self.patch(*patch).name == name)
    }

    /// The name of a patch: `board.chip`.
    pub(crate) fn patch_name(&self, patch: GridPatch) -> String {
        format!("{}.{}", self.name, self.patch(patch).name)
    }
}

/// Radii of the borders of rings in m.
fn radii(rings: &Rings, r_out: f64) -> Vec<f64> {
    let all = (0..rings.count()).map(|ring| rings.borders(ring)[0]).chain([1.0]);
    all.map(|share| share * r_out).collect()
}

/// Areas of a rectangle on the cells of a face.
fn rectangle(borders: &[Borders; 2], ends: [[f64; 2]; 2]) -> Vec<f64> {
    let [u, v] = [borders[0].shared(ends[0]), borders[1].shared(ends[1])];
    u.iter().flat_map(|a| v.iter().map(move |b| a * b)).collect()
}

/// Areas of a circle on the cells of a flat face.
fn circle(borders: &[Borders; 2], ends: [[f64; 2]; 2]) -> Vec<f64> {
    let radius = 0.5 * (ends[0][1] - ends[0][0]);
    let unit = |axis: usize, cell: &[f64]| {
        let middle = 0.5 * (ends[axis][0] + ends[axis][1]);
        [(cell[0] - middle) / radius, (cell[1] - middle) / radius]
    };
    let [rows, columns] =
        [0, 1].map(|axis| borders[axis].all.windows(2).map(move |cell| unit(axis, cell)));
    let columns: Vec<[f64; 2]> = columns.collect();
    let whole = radius * radius;
    rows.flat_map(|row| {
        columns.iter().map(move |column| whole * in_unit_circle(row, *column)).collect::<Vec<_>>()
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Areas of a unit circle: a quadrant, a half, a segment of height 1/2, and the square of a
    /// corner with an arc (all by elementary geometry).
    #[test]
    fn areas_of_a_circle_inside_rectangles() {
        let near = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-15, "{found}");
        near(in_unit_circle([0.0, 2.0], [0.0, 2.0]), PI / 4.0);
        near(in_unit_circle([-3.0, 3.0], [-3.0, 0.0]), PI / 2.0);
        let segment = PI / 3.0 - 3f64.sqrt() / 4.0;
        near(in_unit_circle([-3.0, 3.0], [0.5, 3.0]), segment);
        near(in_unit_circle([-3.0, -0.5], [-3.0, 3.0]), segment);
        // x and y above 1/2: the sector of pi/6 without two triangles
        near(in_unit_circle([0.5, 2.0], [0.5, 2.0]), PI / 12.0 + 0.25 - 3f64.sqrt() / 4.0);
        near(in_unit_circle([-0.5, 0.5], [-0.5, 0.5]), 1.0);
        near(in_unit_circle([0.8, 2.0], [0.8, 2.0]), 0.0);
    }
}
