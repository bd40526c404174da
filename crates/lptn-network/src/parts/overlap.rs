//! Areas that the cells of two faces have in common.
//!
//! Two blocks may touch with faces of different size and different cells. Each cell of the one face
//! exchanges heat with every cell of the other one that it covers in part, over their common area.
//! Both cells keep their one surface, which has one temperature. The error of a cell that is cut
//! shrinks with the cell, and the sum of all areas is exact.

use crate::value::Value;

/// Overlaps shorter than this share of the smaller cell are rounding.
const ROUNDED: f64 = 1e-9;

/// Two lengths of faces that touch are the same if they differ by this share at most: numbers are
/// rounded to a few digits.
pub(crate) const SAME: f64 = 1e-3;

/// The place of the face that a path starts at on the face that it ends at.
#[derive(Clone, Debug)]
pub struct Placement<T = Value> {
    /// From the middle of the second face to that of the first in m, along the two axes of the
    /// second; `None` for faces with one middle.
    pub offset: Option<[T; 2]>,
    /// For each axis along the first face the axis along the second that it lies on, 0 or 1, and
    /// true if it runs against that.
    pub axes: [(usize, bool); 2],
}

impl<T> Default for Placement<T> {
    fn default() -> Self {
        Self { offset: None, axes: [(0, false), (1, false)] }
    }
}

impl<T> Placement<T> {
    /// True for faces with one middle whose axes lie along each other in their order.
    pub fn is_plain(&self) -> bool {
        self.offset.is_none() && self.axes == [(0, false), (1, false)]
    }

    /// The indices along the axes of each face of two cells that touch, from those along the axes
    /// of the second face.
    pub(crate) fn cells(&self, [u, v]: [[usize; 2]; 2]) -> [[usize; 2]; 2] {
        [self.axes.map(|(axis, _)| [u[0], v[0]][axis]), [u[1], v[1]]]
    }

    /// The axis along the first face that lies on one of the second, and true if it is reversed.
    pub(crate) fn on(&self, axis: usize) -> (usize, bool) {
        let on = self.axes.iter().position(|(to, _)| *to == axis).unwrap_or(axis);
        (on, self.axes[on].1)
    }
}

/// A face along one of its axes: length in m and number of cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) length: f64,
    pub(crate) cells: usize,
}

/// Two faces along one axis of the second one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along {
    pub(crate) sides: [Side; 2],
    /// Distance in m from the middle of the second face to that of the first.
    pub(crate) offset: f64,
    /// True if the cells of the first face are counted against the axis of the second.
    pub(crate) reversed: bool,
}

/// A cell of each face, and the length in m that they share along one axis.
#[derive(Clone, Copy, Debug)]
struct Shared {
    cells: [usize; 2],
    length: f64,
}

/// A pair of cells that touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    /// Indices of both along the axes of their faces.
    pub(crate) cells: [[usize; 2]; 2],
    /// Share of the common area of the faces.
    pub(crate) share: f64,
}

/// The cells of two faces that touch.
#[derive(Clone, Debug)]
pub(crate) struct Overlap {
    /// Pairs of cells in the order of the cells of the first face.
    pub(crate) pairs: Vec<Pair>,
    /// Common area in m^2.
    pub(crate) area: f64,
    /// Shares of both faces that it is.
    pub(crate) shares: [f64; 2],
}

impl Along {
    /// Start of the first face, from the start of the second.
    fn start(&self) -> f64 {
        0.5 * (self.sides[1].length - self.sides[0].length) + self.offset
    }

    /// The common length in m; not positive if the faces do not overlap.
    pub(crate) fn common(&self) -> f64 {
        let [from, to] = self.sides.map(|side| side.length);
        (self.start() + from).min(to) - self.start().max(0.0)
    }

    /// The offset from which on the faces do not overlap, in m.
    pub(crate) fn most_offset(&self) -> f64 {
        0.5 * (self.sides[0].length + self.sides[1].length)
    }

    /// The cells that overlap, in the order of the axis of the second face.
    fn shared(&self) -> Vec<Shared> {
        let [a, b] = self.sides;
        let least = ROUNDED * self.sides.map(Side::cell).into_iter().fold(f64::INFINITY, f64::min);
        let borders = |[i, j]: [usize; 2]| [self.start() + a.border(i), b.border(j)];
        let (mut all, mut at) = (Vec::new(), [0, 0]);
        while at[0] < a.cells && at[1] < b.cells {
            let (starts, ends) = (borders(at), borders(at.map(|cell| cell + 1)));
            let length = ends[0].min(ends[1]) - starts[0].max(starts[1]);
            if length > least {
                let first = if self.reversed { a.cells - 1 - at[0] } else { at[0] };
                all.push(Shared { cells: [first, at[1]], length });
            }
            at[usize::from(ends[1] < ends[0])] += 1;
        }
        all
    }
}

impl Side {
    fn cell(self) -> f64 {
        self.length / self.cells as f64
    }

    fn border(self, cell: usize) -> f64 {
        self.length * cell as f64 / self.cells as f64
    }
}

impl Overlap {
    /// The common part of two faces along the two axes of the second one; `None` without any.
    pub(crate) fn of(along: [Along; 2], placement: &Placement) -> Option<Self> {
        let [u, v] = along.map(|axis| axis.shared());
        let sum = |list: &[Shared]| list.iter().map(|part| part.length).sum::<f64>();
        let whole = sum(&u) * sum(&v);
        let mut pairs = Vec::with_capacity(u.len() * v.len());
        for a in &u {
            let share = |b: &Shared| a.length * b.length / whole;
            let pair =
                |b: &Shared| Pair { cells: placement.cells([a.cells, b.cells]), share: share(b) };
            pairs.extend(v.iter().map(pair));
        }
        pairs.sort_unstable_by_key(|pair| pair.cells);
        let area = along[0].common() * along[1].common();
        let shares = [0, 1].map(|face| {
            let [a, b] = along.map(|axis| axis.sides[face].length);
            area / (a * b)
        });
        (!pairs.is_empty()).then_some(Self { pairs, area, shares })
    }
}

/// The conductors of a path between two faces of blocks.
#[derive(Clone, Debug)]
pub(crate) enum Joint {
    /// One for each cell of two equal faces.
    CellByCell,
    /// One for each pair of cells that touch.
    Fixed(Overlap),
    /// One for each pair of cells, with the cells of both: parameters move the faces. Those of pairs
    /// that do not touch conduct nothing.
    Moving(Vec<[[usize; 2]; 2]>),
}

/// True if two faces are joined cell by cell: they have the same lengths and the same cells.
pub(crate) fn is_whole(along: &[Along; 2], placement: &Placement) -> bool {
    let alike = along.iter().all(|axis| {
        let [from, to] = axis.sides;
        let differ = (from.length - to.length).abs() > SAME * from.length.max(to.length);
        from.cells == to.cells && !differ
    });
    alike && placement.is_plain()
}
