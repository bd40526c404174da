//! Positions of the cells of grids.

use std::f64::consts::TAU;

use crate::id::GridId;
use crate::network::Network;
use crate::parts::grid::Grid;
use crate::parts::shape::Shape;
use crate::value::Value;

/// The cells of a grid along one axis: in m, along phi in rad.
#[derive(Clone, Debug, PartialEq)]
pub struct GridAxis {
    /// Ends of the cells, ascending: one more than cells.
    pub borders: Vec<f64>,
    /// The position of the node of each cell.
    pub nodes: Vec<f64>,
}

impl GridAxis {
    /// `count` equal cells on a length.
    pub fn even(length: f64, count: usize) -> Self {
        let step = length / count as f64;
        let borders = (0..count).map(|i| step * i as f64).chain([length]).collect();
        Self { borders, nodes: (0..count).map(|i| step * (i as f64 + 0.5)).collect() }
    }
}

impl Network {
    /// The positions of the cells of a grid along x, y and z, or r, phi and z; NaN where a length
    /// is not known.
    pub fn grid_axes(&self, id: GridId) -> [GridAxis; 3] {
        let grid = &self.grids()[id.index()];
        let mut scope = self.evaluation();
        let mut number = |value: &Value| value.at(&mut scope).unwrap_or(f64::NAN);
        match &grid.shape {
            Shape::Block(size) => {
                [0, 1, 2].map(|axis| GridAxis::even(number(&size[axis]), grid.cells[axis]))
            }
            Shape::Cylinder { r_out, length, angle, .. } => [
                radial(grid, number(r_out)),
                GridAxis::even(angle.as_ref().map_or(TAU, &mut number), grid.cells[1]),
                GridAxis::even(number(length), grid.cells[2]),
            ],
        }
    }
}

fn radial(grid: &Grid, r_out: f64) -> GridAxis {
    let Some(rings) = &grid.rings else { return GridAxis::even(r_out, grid.cells[0]) };
    let count = grid.cells[0];
    let outer = (0..count).map(|i| rings.borders(i)[1] * r_out);
    let borders = [rings.hole * r_out].into_iter().chain(outer).collect();
    GridAxis { borders, nodes: (0..count).map(|i| rings.node(i) * r_out).collect() }
}
