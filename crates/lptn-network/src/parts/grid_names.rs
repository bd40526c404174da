//! Names of the cells and inner paths of a grid. They follow from its name and their indices, so
//! they are neither stored nor indexed: a body of a million cells has three million paths.

use crate::id::ConductorId;
use crate::parts::grid::{Grid, bracketed, number, place};

/// The inner paths of a grid along one axis.
#[derive(Clone, Debug)]
pub(crate) struct PathNames {
    /// Their name before the indices: `block.x`.
    head: String,
    /// Number of paths along x, y and z.
    counts: [usize; 3],
    /// Number of indices.
    axes: usize,
}

impl PathNames {
    pub(crate) fn new(grid: &Grid, axis: usize) -> Self {
        let head = format!("{}.{}", grid.name, grid.form().directions()[axis]);
        Self { head, counts: grid.paths_along(axis), axes: grid.axes }
    }

    /// The name of a path by its place, counted with the last index running fastest.
    pub(crate) fn name(&self, place: u32) -> String {
        let [_, y, z] = self.counts;
        let place = place as usize;
        let at = [place / (y * z), place / z % y, place % z];
        format!("{}{}", self.head, bracketed(at.into_iter().take(self.axes)))
    }
}

impl Grid {
    /// Number of inner paths along each axis that run along one of them. Around an axis, the last
    /// one leads back to the first cell.
    pub(crate) fn paths_along(&self, axis: usize) -> [usize; 3] {
        let mut counts = self.cells;
        if !(axis == 1 && self.form().is_closed()) {
            counts[axis] -= 1;
        }
        counts
    }

    /// The inner path along an axis that begins at the cell with these indices from 1.
    pub(crate) fn path_at(&self, axis: usize, indices: &[usize]) -> Option<ConductorId> {
        let (first, counts) = (self.paths[axis]?, self.paths_along(axis));
        let at = place(indices, self.axes, counts)?;
        Some(ConductorId::from_len(first as usize + number(at, counts)))
    }
}
