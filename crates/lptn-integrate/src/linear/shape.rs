//! A symmetric pattern as rows of its strict lower triangle, in an order in which neighbours are
//! near.

use crate::Pattern;

/// The strict lower triangle of a symmetric pattern by rows, in an order of its own.
///
/// The order is that of a breadth-first search (E. Cuthill and J. McKee, Proc. 24th Nat. Conf. ACM
/// (1969) 157). In a body of cells the rows of one level are not linked, so that the processor
/// works at several rows of a triangular sweep at a time, and what a row reads is near.
#[derive(Debug)]
pub(super) struct Shape {
    /// The row of the pattern at each place.
    pub(super) order: Vec<u32>,
    /// Where each row ends and the next one begins; 0 at first.
    pub(super) begins: Vec<u32>,
    /// The place of the column of each entry, below that of its row.
    pub(super) columns: Vec<u32>,
    /// The slot of each entry in the lower triangle of the pattern.
    pub(super) source: Vec<u32>,
    /// The slot of the diagonal entry at each place.
    pub(super) diagonal: Vec<u32>,
    /// Number of slots of the pattern.
    pub(super) slots: usize,
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
        let mut begins = vec![0];
        for (at, &row) in (0..).zip(&order) {
            let row = row as usize;
            for slot in pattern.column(row) {
                let other = pattern.row_indices()[slot];
                if place[other] < at {
                    columns.push(place[other]);
                    source.push(lower(pattern, row, other, slot));
                }
            }
            begins.push(short(columns.len()));
        }
        let diagonal = order.iter().map(|&row| short(pattern.diagonal_slot(row as usize)));
        let diagonal = diagonal.collect();
        Self { order, begins, columns, source, diagonal, slots: pattern.len() }
    }
}

/// The slot of the lower triangle for the link of two rows, of which `slot` is one.
fn lower(pattern: &Pattern, column: usize, row: usize, slot: usize) -> u32 {
    let slot = if row > column { Some(slot) } else { pattern.slot(column, row) };
    short(slot.expect("a pattern is symmetric"))
}

/// All rows, each part of the network from a row with few neighbours on.
fn breadth_first(pattern: &Pattern) -> Vec<u32> {
    let degree = |row: &u32| pattern.column(*row as usize).len();
    let mut starts: Vec<u32> = (0..short(pattern.size())).collect();
    starts.sort_by_key(degree);
    let mut seen = vec![false; starts.len()];
    let mut order = Vec::with_capacity(starts.len());
    for start in starts {
        if std::mem::replace(&mut seen[start as usize], true) {
            continue;
        }
        let mut next = order.len();
        order.push(start);
        while let Some(&row) = order.get(next) {
            next += 1;
            for &other in &pattern.row_indices()[pattern.column(row as usize)] {
                if !std::mem::replace(&mut seen[other], true) {
                    order.push(short(other));
                }
            }
        }
    }
    order
}

pub(super) fn short(index: usize) -> u32 {
    u32::try_from(index).expect("a matrix has fewer than 2^32 entries")
}
