//! The laws of the inner paths of grids, and the volumes of their cells.

use std::f64::consts::TAU;

use lptn_laws::Formula;
use lptn_units::Dimension;

use crate::builder::Path;
use crate::builder::grid::{product, scaled, typed};
use crate::parts::grid::{Face, Grid};
use crate::parts::rings::Rings;
use crate::parts::shape::Shape;
use crate::value::{Input, Value};

/// A cylinder that is cut into rings.
struct Round<'a> {
    grid: &'a Grid,
    rings: &'a Rings,
    r_out: &'a Value,
    length: &'a Value,
    /// In rad.
    angle: Value,
}

impl Grid {
    fn round(&self) -> Option<Round<'_>> {
        let Shape::Cylinder { r_out, length, angle, .. } = &self.shape else { return None };
        let angle = angle.clone().unwrap_or(Value::Constant(TAU));
        Some(Round { grid: self, rings: self.rings.as_ref()?, r_out, length, angle })
    }

    /// The volume of a cell in m^3, of a ring of a round body.
    pub(crate) fn volume(&self, ring: usize) -> Value {
        if let Some(round) = self.round() {
            return round.volume(ring);
        }
        let share = Value::Constant(1.0 / self.count() as f64);
        product(self.size().into_iter().chain([share]).collect())
    }

    /// Conduction from a cell to the next one along an axis.
    pub(crate) fn path(&self, axis: usize, ring: usize) -> Path {
        match self.round() {
            Some(round) if axis == 0 => round.radial([ring, ring + 1].map(|i| round.radius(i))),
            Some(round) => round.across(axis, ring, 1.0),
            None => self.straight(axis, 1.0),
        }
    }

    /// Conduction from a cell to its surface on a face.
    pub(crate) fn path_to(&self, face: Face, ring: usize) -> Path {
        match self.round() {
            Some(round) if face == Face::INNER => {
                round.radial([scaled(round.r_out, round.rings.hole), round.radius(ring)])
            }
            Some(round) if face == Face::OUTER => {
                round.radial([round.radius(ring), round.r_out.clone()])
            }
            Some(round) => round.across(face.axis(), ring, 0.5),
            None => self.straight(face.axis(), 0.5),
        }
    }

    /// The area of a face in m^2.
    pub(crate) fn area(&self, face: Face) -> Value {
        let Some(round) = self.round() else {
            let size = self.size();
            return product(face.along().map(|axis| size[axis].clone()).to_vec());
        };
        let (r_out, hole) = (round.r_out.clone(), round.rings.hole);
        match face.axis() {
            0 => {
                let radius = if face.is_far() { r_out } else { scaled(&r_out, hole) };
                product(vec![radius, round.angle, round.length.clone()])
            }
            1 => product(vec![r_out, round.length.clone(), Value::Constant(1.0 - hole)]),
            _ => {
                let whole = Value::Constant(round.rings.whole());
                product(vec![r_out.clone(), r_out, round.angle, whole])
            }
        }
    }

    /// The lengths of a block.
    fn size(&self) -> Vec<Value> {
        match &self.shape {
            Shape::Block(size) => size.to_vec(),
            Shape::Cylinder { .. } => Vec::new(),
        }
    }

    /// Conduction along an axis of a block through this part of a cell.
    fn straight(&self, axis: usize, part: f64) -> Path {
        let size = self.size();
        let across = [0, 1, 2].into_iter().filter(|other| *other != axis);
        let (sides, counts): (Vec<Value>, Vec<f64>) =
            across.map(|other| (size[other].clone(), self.cells[other] as f64)).unzip();
        let share = counts.iter().product::<f64>().recip();
        let area = product(sides.into_iter().chain([Value::Constant(share)]).collect());
        slab(self, axis, area, scaled(&size[axis], part / self.cells[axis] as f64))
    }
}

impl Round<'_> {
    /// The radius of the node of a ring in m.
    fn radius(&self, ring: usize) -> Value {
        scaled(self.r_out, self.rings.node(ring))
    }

    fn volume(&self, ring: usize) -> Value {
        let share = self.rings.area(ring) / (self.grid.cells[1] * self.grid.cells[2]) as f64;
        let [r_out, length] = [self.r_out, self.length].map(Clone::clone);
        product(vec![r_out.clone(), r_out, length, self.angle.clone(), Value::Constant(share)])
    }

    /// Conduction between two radii in m through the angle and the length of a cell.
    fn radial(&self, radii: [Value; 2]) -> Path {
        let share = 1.0 / (TAU * (self.grid.cells[1] * self.grid.cells[2]) as f64);
        let length = product(vec![self.length.clone(), self.angle.clone(), Value::Constant(share)]);
        let [inner, outer, length] =
            [radii[0].clone(), radii[1].clone(), length].map(|l| typed(l, Dimension::LENGTH));
        Path::new(Formula::Cylinder, [conductivity(self.grid, 0), inner, outer, length])
    }

    /// Conduction along phi or z through this part of a cell.
    fn across(&self, axis: usize, ring: usize, part: f64) -> Path {
        let (rings, cells) = (self.rings, self.grid.cells.map(|count| count as f64));
        let [r_out, length] = [self.r_out, self.length].map(Clone::clone);
        let angle = self.angle.clone();
        let (area, thickness) = if axis == 1 {
            let (width, arc) = (rings.width(ring) / cells[2], rings.node(ring) * part / cells[1]);
            (
                vec![r_out.clone(), length, Value::Constant(width)],
                vec![r_out, angle, Value::Constant(arc)],
            )
        } else {
            let area = Value::Constant(rings.area(ring) / cells[1]);
            (
                vec![r_out.clone(), r_out, angle, area],
                vec![length, Value::Constant(part / cells[2])],
            )
        };
        slab(self.grid, axis, product(area), product(thickness))
    }
}

fn conductivity(grid: &Grid, axis: usize) -> Input {
    typed(grid.conductivity[axis].clone(), Dimension::CONDUCTIVITY)
}

fn slab(grid: &Grid, axis: usize, area: Value, thickness: Value) -> Path {
    let (area, thickness) = (typed(area, Dimension::AREA), typed(thickness, Dimension::LENGTH));
    Path::new(Formula::Slab, [conductivity(grid, axis), area, thickness])
}
