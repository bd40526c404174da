//! Rectangles and circles of a face of a grid, by their place.
//!
//! A patch is divided among the cells of its face by the exact area that each of them shares with
//! it: heat and paths reach a cell by that share. Each cell keeps its one surface temperature, so
//! the error of a cell that is cut shrinks with the cell; the sum of all shares is 1.
//!
//! Parameters may scale a patch together with its face. One that changes the shares is refused:
//! shares of heat are numbers of the network, not functions of parameters.

use crate::parts::face::Face;
use crate::value::Value;

/// A cell with a smaller share of the largest common area is not covered: it is rounding.
const LEAST: f64 = 1e-12;

/// Shares and ratios of areas that differ by less are the same.
const SAME: f64 = 1e-9;

/// A rectangle or a circle of a face.
#[derive(Clone, Debug)]
pub enum Outline<T = Value> {
    /// Its lengths along the two axes of the face; an angle around the axis of a cylinder.
    Rectangle([T; 2]),
    /// Its radius in m. On the end of a cylinder it is a disc around the axis.
    Circle(T),
}

/// A rectangle or circle of a face, by its place.
#[derive(Clone, Debug)]
pub struct Patch<T = Value> {
    /// Its name after that of the grid: `chip` of `board.chip`.
    pub name: String,
    /// The face.
    pub face: Face,
    /// Its outline.
    pub outline: Outline<T>,
    /// Its middle along the two axes of the face, in m from where they begin, an angle around the
    /// axis of a cylinder, a radius from the axis; `None` for the middle of the face.
    pub centre: Option<[T; 2]>,
    /// Its parts, as the values in the file give them.
    pub(crate) parts: PatchParts,
}

/// The cells that a patch covers.
#[derive(Clone, Debug, Default)]
pub(crate) struct PatchParts {
    /// Numbers of the cells of its face, the last index running fastest, with the share of the patch
    /// that lies on each. The shares sum to 1.
    pub(crate) shares: Vec<(u32, f64)>,
    /// Its area as a share of that of the face.
    pub(crate) portion: f64,
}

/// The reason why a patch has no cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PatchProblem {
    /// It extends beyond the face along an axis, 0 or 1: its ends and those of the face.
    Outside {
        /// The axis along the face, 0 or 1.
        along: usize,
        /// Its ends in m or rad.
        ends: [f64; 2],
        /// The ends of the face in m or rad.
        face: [f64; 2],
    },
    /// A circle on a mantle, which is curved.
    CurvedFace,
    /// A circle on an end of a cylinder that is not a disc around the axis.
    NotADisc,
    /// Parameters move it over the cells of its face.
    Moved,
    /// A value is not a number.
    Unknown,
}

impl PatchParts {
    /// Shares of the cells of a face by the areas that they have in common with a patch.
    pub(crate) fn of(areas: &[f64], face: f64) -> Self {
        let largest = areas.iter().copied().fold(0.0, f64::max);
        let covered = areas.iter().enumerate().filter(|(_, area)| **area > LEAST * largest);
        let whole: f64 = covered.clone().map(|(_, area)| area).sum();
        let number = |cell: usize| u32::try_from(cell).unwrap_or(u32::MAX);
        let shares = covered.map(|(cell, area)| (number(cell), area / whole)).collect();
        Self { shares, portion: whole / face }
    }

    /// True if both divide a patch in the same way.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME;
        let share = |parts: &Self, cell: u32| {
            let at = parts.shares.binary_search_by_key(&cell, |(cell, _)| *cell);
            at.map_or(0.0, |at| parts.shares[at].1)
        };
        let cells = self.shares.iter().chain(&other.shares).map(|(cell, _)| *cell);
        cells.into_iter().all(|cell| near(share(self, cell), share(other, cell)))
            && (self.portion - other.portion).abs() <= SAME * self.portion
    }
}

impl<T> Outline<T> {
    /// Its lengths.
    pub fn values(&self) -> Vec<&T> {
        match self {
            Self::Rectangle(size) => size.iter().collect(),
            Self::Circle(radius) => vec![radius],
        }
    }
}
