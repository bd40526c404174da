//! A symmetric pattern as rows of its strict lower triangle, in an order in which neighbours are
//! near.

use std::sync::Arc;

use crate::Pattern;

/// The strict lower triangle of a symmetric pattern by rows, in its own order.
///
/// The order is that of a breadth-first search (E. Cuthill and J. McKee, Proc. 24th Nat. Conf. ACM
/// (1969) 157). In a body of cells the rows of one level are not linked, so that the processor
/// works at several rows of a triangular sweep at a time, and the values that a row reads are near.
/// In a level rows with the same number of entries are adjacent.
#[derive(Debug)]
pub(super) struct Shape {
    /// The row of the pattern at each place.
    pub(super) order: Vec<u32>,
    /// The entries.
    pub(super) triangle: Arc<Triangle>,
    /// The slot of each entry in the lower triangle of the pattern.
    pub(super) source: Vec<u32>,
    /// The slot of its mirror image, for matrices that are not symmetric; else none.
    pub(super) mirror: Vec<u32>,
    /// The slot of the diagonal entry at each place.
    pub(super) diagonal: Vec<u32>,
    /// Number of slots of the pattern.
    pub(super) slots: usize,
    /// Rows of the largest level.
    pub(super) width: usize,
    /// Levels of the deepest part.
    pub(super) depth: usize,
}

/// Positions of the entries of a strict lower triangle.
#[derive(Debug, Default)]
pub(super) struct Triangle {
    /// Rows with the same number of entries together.
    pub(super) runs: Vec<Run>,
    /// The column of each entry, below its row.
    pub(super) columns: Vec<u32>,
}

/// Rows of a triangle that follow each other and have the same number of entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// The first of them.
    pub(super) first: u32,
    /// Number of rows.
    pub(super) rows: u32,
    /// The first entry.
    pub(super) begin: u32,
    /// The entries of each row.
    pub(super) width: u32,
}

impl Run {
    /// The rows.
    pub(super) fn places(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.rows) as usize
    }

    /// The entries of a row.
    pub(super) fn entries(&self, row: usize) -> std::ops::Range<usize> {
        let width = self.width as usize;
        let begin = self.begin as usize + (row - self.first as usize) * width;
        begin..begin + width
    }
}

impl Triangle {
    /// Ends a row with the columns that were appended since the last one.
    pub(super) fn end_row(&mut self) {
        let last = self.runs.last();
        let (first, begin) = last
            .map_or((0, 0), |last| (last.first + last.rows, last.begin + last.rows * last.width));
        let width = short(self.columns.len()) - begin;
        match self.runs.last_mut() {
            Some(last) if last.width == width => last.rows += 1,
            _ => self.runs.push(Run { first, rows: 1, begin, width }),
        }
    }

    /// Each row with its entries.
    pub(super) fn rows(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> {
        self.runs.iter().flat_map(|run| run.places().map(|row| (row, run.entries(row))))
    }
}

impl Shape {
    /// # Panics
    /// If the pattern has 2^32 slots or more, which no memory can store.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let (order, [width, depth]) = breadth_first(pattern);
        let mut place = vec![0; order.len()];
        (0..).zip(&order).for_each(|(at, &row)| place[row as usize] = at);
        let entries = (pattern.len() - pattern.size()) / 2;
        let (columns, mut source) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
        let mut triangle = Triangle { runs: Vec::new(), columns };
        for (at, &row) in (0..).zip(&order) {
            let row = row as usize;
            for slot in pattern.column(row) {
                let other = pattern.row_indices()[slot];
                if place[other] < at {
                    triangle.columns.push(place[other]);
                    source.push(lower(pattern, row, other, slot));
                }
            }
            triangle.end_row();
        }
        let slot = |&row: &u32| short(pattern.diagonal_slot(row as usize));
        let diagonal = order.iter().map(slot).collect();

        Self {
            order,
            triangle: Arc::new(triangle),
            source,
            mirror: Vec::new(),
            diagonal,
            slots: pattern.len(),
            width,
            depth,
        }
    }

    /// Products of a Cholesky decomposition, at least: bodies of cells take 12 to 19 times the cube
    /// of the width, in the plane and in space.
    pub(super) fn products(&self) -> f64 {
        10.0 * (self.width as f64).powi(3)
    }

    /// The same with the slots that matrices which are not symmetric need: `source` is then that of
    /// the entry itself, and `mirror` that of its mirror image.
    pub(super) fn with_mirror(mut self, pattern: &Pattern) -> Self {
        let Triangle { columns, .. } = &*self.triangle;
        self.mirror = vec![0; columns.len()];
        for (at, own) in self.triangle.rows() {
            let row = self.order[at] as usize;
            for entry in own {
                let column = self.order[columns[entry] as usize] as usize;
                let slot =
                    |row, column| short(pattern.slot(row, column).expect("a pattern is symmetric"));
                self.source[entry] = slot(row, column);
                self.mirror[entry] = slot(column, row);
            }
        }
        self
    }

    /// The pattern that it is the shape of.
    pub(super) fn pattern(&self) -> Pattern {
        let Triangle { columns, .. } = &*self.triangle;
        let row = |at: usize| self.order[at] as usize;
        let links = self.triangle.rows().flat_map(|(at, own)| {
            columns[own].iter().map(move |&column| (row(at), row(column as usize)))
        });
        Pattern::new(self.order.len(), links)
    }
}

/// The slot of the lower triangle for the link of two rows, of which `slot` is one.
fn lower(pattern: &Pattern, column: usize, row: usize, slot: usize) -> u32 {
    let slot = if row > column { Some(slot) } else { pattern.slot(column, row) };
    short(slot.expect("a pattern is symmetric"))
}

/// All rows, each part of the network from a row with few neighbours on, the size of the
/// largest level and the number of levels of the deepest part.
fn breadth_first(pattern: &Pattern) -> (Vec<u32>, [usize; 2]) {
    let neighbours = |row: u32| &pattern.row_indices()[pattern.column(row as usize)];
    let mut starts: Vec<u32> = (0..short(pattern.size())).collect();
    starts.sort_by_key(|&row| neighbours(row).len());
    // for each row, once it is found, the number of its neighbours in earlier levels
    let mut behind = vec![0_u32; starts.len()];
    let mut order = Vec::with_capacity(starts.len());
    let (mut width, mut depth) = (0, 0);
    for start in starts {
        if behind[start as usize] > 0 {
            continue;
        }
        behind[start as usize] = 1;
        let (mut level, mut levels) = (order.len(), 0);
        order.push(start);
        while level < order.len() {
            let end = order.len();
            for at in level..end {
                for &other in neighbours(order[at]) {
                    if behind[other] == 0 {
                        order.push(short(other));
                    }
                    behind[other] += 1;
                }
            }
            order[end..].sort_by_key(|&row| behind[row as usize]);
            width = width.max(end - level);
            levels += 1;
            level = end;
        }
        depth = depth.max(levels);
    }
    (order, [width, depth])
}

pub(super) fn short(index: usize) -> u32 {
    u32::try_from(index).expect("a matrix has fewer than 2^32 entries")
}
