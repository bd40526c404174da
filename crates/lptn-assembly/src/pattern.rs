//! The pattern of the Jacobian and where each value goes in it.

use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

/// Compressed columns of a structurally symmetric matrix: sorted, without duplicates, with its full
/// diagonal. It never changes; values are written through slots only.
#[derive(Clone, Debug)]
pub struct JacobianPattern {
    symbolic: SymbolicSparseColMat<usize>,
    /// Slot of each diagonal entry.
    diagonal: Vec<usize>,
}

impl JacobianPattern {
    /// The pattern of `size` unknowns of which these pairs meet; pairs may repeat and come in any
    /// order.
    pub(crate) fn new(size: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.iter_mut().for_each(|(a, b)| (*a, *b) = ((*a).min(*b), (*a).max(*b)));
        pairs.retain(|(a, b)| a != b);
        pairs.sort_unstable();
        pairs.dedup();
        let mut counts = vec![1_usize; size]; // the diagonal
        for &(a, b) in &pairs {
            counts[a as usize] += 1;
            counts[b as usize] += 1;
        }
        let mut columns = vec![0_usize; size + 1];
        for i in 0..size {
            columns[i + 1] = columns[i] + counts[i];
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
        // diagonal are the `a` of earlier pairs, then the diagonal, then the `b` of its own pairs
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
        let symbolic = SymbolicSparseColMat::new_checked(size, size, columns, None, rows);
        Self { symbolic, diagonal }
    }

    /// The compressed columns.
    pub fn symbolic(&self) -> SymbolicSparseColMatRef<'_, usize> {
        self.symbolic.as_ref()
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.symbolic.row_idx().len()
    }

    pub(crate) fn diagonal_slot(&self, unknown: usize) -> usize {
        self.diagonal[unknown]
    }

    /// The slot of an entry, which has to be one of the pattern.
    pub(crate) fn slot(&self, row: u32, column: u32) -> usize {
        let columns = self.symbolic.col_ptr();
        let (first, last) = (columns[column as usize], columns[column as usize + 1]);
        let offset = self.symbolic.row_idx()[first..last].partition_point(|&r| r < row as usize);
        first + offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pattern_is_sorted_symmetric_and_has_its_diagonal() {
        let pattern = JacobianPattern::new(4, vec![(1, 3), (0, 3), (2, 1), (1, 3)]);
        let (columns, rows) = (pattern.symbolic().col_ptr(), pattern.symbolic().row_idx());
        assert_eq!(columns, &[0, 2, 5, 7, 10]);
        assert_eq!(rows, &[0, 3, 1, 2, 3, 1, 2, 0, 1, 3]);
        let (ab, ba) = (pattern.slot(3, 1), pattern.slot(1, 3));
        assert_eq!((rows[ab], rows[ba]), (3, 1));
    }
}
