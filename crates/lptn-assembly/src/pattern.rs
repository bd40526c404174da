//! The pattern of the Jacobian, with a slot for each value.

use std::sync::Arc;

/// Compressed columns of a structurally symmetric matrix: sorted, without duplicates, with its full
/// diagonal. It never changes, so that copies share it; values are written through slots only.
#[derive(Clone, Debug)]
pub struct JacobianPattern {
    /// Slot at which each column begins, and the number of all slots.
    columns: Arc<Vec<usize>>,
    /// Row of each slot.
    rows: Arc<Vec<usize>>,
    /// Slot of each diagonal entry.
    diagonal: Arc<Vec<usize>>,
}

impl JacobianPattern {
    /// The pattern of `size` unknowns of which these pairs meet; pairs may repeat and come in any
    /// order.
    pub(crate) fn new(size: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.iter_mut().for_each(|(a, b)| (*a, *b) = ((*a).min(*b), (*a).max(*b)));
        pairs.retain(|(a, b)| a != b);
        pairs.sort_unstable();
        pairs.dedup();
        let mut columns = vec![0_usize; size + 1];
        for &(a, b) in &pairs {
            columns[a as usize + 1] += 1;
            columns[b as usize + 1] += 1;
        }
        for i in 0..size {
            columns[i + 1] += columns[i] + 1; // the diagonal
        }
        let mut rows = vec![0_usize; columns[size]];
        let mut next = columns[..size].to_vec();
        let mut put = |row: usize, column: usize| {
            let at = next[column];
            rows[at] = row;
            next[column] += 1;
            at
        };
        // pairs are sorted by (a, b), so each column gets its rows in order: those above the
        // diagonal are the `a` of earlier pairs, then the diagonal, then the `b` of this column
        let mut diagonal = vec![0; size];
        let mut k = 0;
        for (column, slot) in diagonal.iter_mut().enumerate() {
            *slot = put(column, column);
            while k < pairs.len() && pairs[k].0 as usize == column {
                let b = pairs[k].1 as usize;
                put(column, b);
                put(b, column);
                k += 1;
            }
        }
        Self { columns: columns.into(), rows: rows.into(), diagonal: diagonal.into() }
    }

    /// The slot at which each column begins and the number of all slots, the row of each slot, the
    /// slot of each diagonal entry.
    pub fn symbolic(&self) -> [Arc<Vec<usize>>; 3] {
        [&self.columns, &self.rows, &self.diagonal].map(Arc::clone)
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// The slots of a row.
    pub(crate) fn row(&self, row: usize) -> Vec<usize> {
        (0..self.rows.len()).filter(|slot| self.rows[*slot] == row).collect()
    }

    /// The slot of an entry of the diagonal.
    pub fn diagonal_slot(&self, unknown: usize) -> usize {
        self.diagonal[unknown]
    }

    /// The slot of an entry, which has to be one of the pattern.
    pub(crate) fn slot(&self, row: u32, column: u32) -> usize {
        let (first, last) = (self.columns[column as usize], self.columns[column as usize + 1]);
        let offset = self.rows[first..last].partition_point(|&r| r < row as usize);
        first + offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pattern_is_sorted_symmetric_and_has_its_diagonal() {
        let pattern = JacobianPattern::new(4, vec![(1, 3), (0, 3), (2, 1), (1, 3)]);
        let [columns, rows, diagonal] = pattern.symbolic();
        assert_eq!(*columns, [0, 2, 5, 7, 10]);
        assert_eq!(*rows, [0, 3, 1, 2, 3, 1, 2, 0, 1, 3]);
        assert_eq!(*diagonal, [0, 2, 6, 9]);
        let (ab, ba) = (pattern.slot(3, 1), pattern.slot(1, 3));
        assert_eq!((rows[ab], rows[ba]), (3, 1));
    }
}
