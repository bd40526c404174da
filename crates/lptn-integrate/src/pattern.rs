//! Possible nonzeros of a square sparse matrix.

use std::sync::Arc;

/// Structurally symmetric pattern in compressed columns: rows ascending within a column, no
/// duplicates, the whole diagonal present. A *slot* is a position in the array of values that goes
/// with the pattern. Copies share their memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    column_pointers: Arc<Vec<usize>>,
    row_indices: Arc<Vec<usize>>,
    diagonal: Arc<Vec<usize>>,
}

impl Pattern {
    /// The pattern of an `n` by `n` matrix with nonzeros at the given `(row, column)` pairs, at
    /// their mirror images and on the diagonal. Pairs may repeat and come in any order without
    /// changing the result.
    ///
    /// # Panics
    /// If an index is not below `n`: that is a mistake of the calling program, never of its input.
    #[must_use]
    pub fn new(n: usize, edges: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut rows_of: Vec<Vec<usize>> = (0..n).map(|i| vec![i]).collect();
        for (row, column) in edges {
            assert!(
                row < n && column < n,
                "entry ({row}, {column}) is outside a matrix of size {n}"
            );
            rows_of[column].push(row);
            rows_of[row].push(column);
        }
        let (mut pointers, mut indices, mut diagonal) =
            (vec![0], Vec::new(), Vec::with_capacity(n));
        for (column, mut rows) in rows_of.into_iter().enumerate() {
            rows.sort_unstable();
            rows.dedup();
            let offset = rows.partition_point(|&row| row < column);
            diagonal.push(indices.len() + offset);
            indices.append(&mut rows);
            pointers.push(indices.len());
        }
        Self::from_symbolic([pointers, indices, diagonal].map(Arc::new))
    }

    /// A pattern from shared arrays: the slot at which each column begins and then the number of
    /// all slots, the row of each slot, the slot of each diagonal entry.
    #[must_use]
    pub fn from_symbolic([column_pointers, row_indices, diagonal]: [Arc<Vec<usize>>; 3]) -> Self {
        Self { column_pointers, row_indices, diagonal }
    }

    /// Number of rows and of columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.diagonal.len()
    }

    /// Number of slots.
    #[must_use]
    pub fn len(&self) -> usize {
        self.row_indices.len()
    }

    /// True if the matrix is 0 by 0.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.row_indices.is_empty()
    }

    /// `size() + 1` ascending slots: column `j` occupies
    /// `column_pointers()[j]..column_pointers()[j + 1]`.
    #[must_use]
    pub fn column_pointers(&self) -> &[usize] {
        &self.column_pointers
    }

    /// The row of every slot.
    #[must_use]
    pub fn row_indices(&self) -> &[usize] {
        &self.row_indices
    }

    /// The slots of one column.
    #[must_use]
    pub fn column(&self, column: usize) -> std::ops::Range<usize> {
        self.column_pointers[column]..self.column_pointers[column + 1]
    }

    /// The slot of an entry, or `None` if the matrix is zero by structure or the indices are out
    /// of range.
    #[must_use]
    pub fn slot(&self, row: usize, column: usize) -> Option<usize> {
        if column >= self.size() {
            return None;
        }
        let range = self.column(column);
        self.row_indices[range.clone()].binary_search(&row).ok().map(|offset| range.start + offset)
    }

    /// The slot of diagonal entry `i`, for `i` below [`size`](Self::size).
    #[must_use]
    pub fn diagonal_slot(&self, i: usize) -> usize {
        self.diagonal[i]
    }

    /// The slots of the diagonal, in order.
    #[must_use]
    pub fn diagonal(&self) -> &[usize] {
        &self.diagonal
    }

    /// Writes `y = A x` for the matrix `A` with these values. `values` has a value per slot, `x`
    /// and `y` one per row.
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for (column, &factor) in x.iter().enumerate() {
            for slot in self.column(column) {
                y[self.row_indices[slot]] += values[slot] * factor;
            }
        }
    }
}
