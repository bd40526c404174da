//! A symmetric pattern as rows of its strict lower triangle, in an order in which neighbours are
//! near.

use crate::Pattern;

/// The strict lower triangle of a symmetric pattern by rows, in an order of its own.
///
/// The order is that of a breadth-first search (E. Cuthill and J. McKee, Proc. 24th Nat. Conf. ACM
/// (1969) 157). In a body of cells the rows of one level are not linked, so that the processor
/// works at several rows of a triangular sweep at a time, and what a row reads is near. In a level
/// rows with the same number of entries stand together.
#[derive(Debug)]
pub(super) struct Shape {
    /// The row of the pattern at each place.
    pub(super) order: Vec<u32>,
    /// Rows with the same number of entries together.
    pub(super) runs: Vec<Run>,
    /// The place of the column of each entry, below that of its row.
    pub(super) columns: Vec<u32>,
    /// The slot of each entry in the lower triangle of the pattern.
    pub(super) source: Vec<u32>,
    /// The slot of the diagonal entry at each place.
    pub(super) diagonal: Vec<u32>,
    /// Number of slots of the pattern.
    pub(super) slots: usize,
}

/// Rows of a triangle that follow each other and have the same number of entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// The first of them.
    pub(super) first: u32,
    /// How many.
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

/// Appends a row with so many entries.
pub(super) fn push_row(runs: &mut Vec<Run>, width: u32) {
    let (first, begin) = runs
        .last()
        .map_or((0, 0), |last| (last.first + last.rows, last.begin + last.rows * last.width));
    match runs.last_mut() {
        Some(last) if last.width == width => last.rows += 1,
        _ => runs.push(Run { first, rows: 1, begin, width }),
    }
}

impl Shape {
    /// # Panics
    /// If the pattern has 2^32 slots or more, which no memory holds.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let order = breadth_first(pattern);
        let mut place = vec![0; order.len()];
        (0..).zip(&order).for_each(|(at, &row)| place[row as usize] = at);
        let entries = (pattern.len() - pattern.size()) / 2;
        let (mut columns, mut source) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
        let mut runs = Vec::new();
        for (at, &row) in (0..).zip(&order) {
            let (row, before) = (row as usize, columns.len());
            for slot in pattern.column(row) {
                let other = pattern.row_indices()[slot];
                if place[other] < at {
                    columns.push(place[other]);
                    source.push(lower(pattern, row, other, slot));
                }
            }
            push_row(&mut runs, short(columns.len() - before));
        }
        let diagonal = order.iter().map(|&row| short(pattern.diagonal_slot(row as usize)));
        let diagonal = diagonal.collect();
        Self { order, runs, columns, source, diagonal, slots: pattern.len() }
    }
}

/// The slot of the lower triangle for the link of two rows, of which `slot` is one.
fn lower(pattern: &Pattern, column: usize, row: usize, slot: usize) -> u32 {
    let slot = if row > column { Some(slot) } else { pattern.slot(column, row) };
    short(slot.expect("a pattern is symmetric"))
}

/// All rows, each part of the network from a row with few neighbours on.
fn breadth_first(pattern: &Pattern) -> Vec<u32> {
    let neighbours = |row: u32| &pattern.row_indices()[pattern.column(row as usize)];
    let mut starts: Vec<u32> = (0..short(pattern.size())).collect();
    starts.sort_by_key(|&row| neighbours(row).len());
    // for each row how many of its neighbours stand in levels before its own, once it is found
    let mut behind = vec![0_u32; starts.len()];
    let mut order = Vec::with_capacity(starts.len());
    for start in starts {
        if behind[start as usize] > 0 {
            continue;
        }
        behind[start as usize] = 1;
        let mut level = order.len();
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
            level = end;
        }
    }
    order
}

pub(super) fn short(index: usize) -> u32 {
    u32::try_from(index).expect("a matrix has fewer than 2^32 entries")
}
