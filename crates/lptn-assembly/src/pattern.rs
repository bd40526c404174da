//! The pattern of the Jacobian and where each link's value goes in it.

use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use crate::eliminate::Link;

/// Compressed columns of a symmetric matrix: sorted, without duplicates, with its full diagonal. It never
/// changes; values are written through slots only.
#[derive(Clone, Debug)]
pub struct JacobianPattern {
    symbolic: SymbolicSparseColMat<usize>,
    /// Slot of each diagonal entry.
    diagonal: Vec<usize>,
    /// Slots of (a, b) and (b, a) for every link.
    links: Vec<[usize; 2]>,
}

impl JacobianPattern {
    /// The pattern of `size` states that `links` (sorted, without duplicates, `a < b`) join.
    pub(crate) fn new(size: usize, links: &[Link]) -> Self {
        let mut counts = vec![1_usize; size]; // the diagonal
        for link in links {
            counts[link.a as usize] += 1;
            counts[link.b as usize] += 1;
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
        // links are sorted by (a, b), so each column gets its rows in order: those above the diagonal are the
        // `a` of earlier links, then the diagonal, then the `b` of its own links
        let mut diagonal = vec![0; size];
        let mut slots = vec![[0; 2]; links.len()];
        let mut k = 0;
        for (column, slot) in diagonal.iter_mut().enumerate() {
            *slot = put(column, column);
            while k < links.len() && links[k].a as usize == column {
                let b = links[k].b as usize;
                slots[k] = [put(column, b), put(b, column)];
                k += 1;
            }
        }
        let symbolic = SymbolicSparseColMat::new_checked(size, size, columns, None, rows);
        Self { symbolic, diagonal, links: slots }
    }

    /// The compressed columns.
    pub fn symbolic(&self) -> SymbolicSparseColMatRef<'_, usize> {
        self.symbolic.as_ref()
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.symbolic.row_idx().len()
    }

    pub(crate) fn diagonal_slot(&self, state: usize) -> usize {
        self.diagonal[state]
    }

    pub(crate) fn link_slots(&self, link: usize) -> [usize; 2] {
        self.links[link]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pattern_is_sorted_symmetric_and_has_its_diagonal() {
        let link = |a, b| Link { a, b, g: 1.0 };
        let pattern = JacobianPattern::new(4, &[link(0, 3), link(1, 2), link(1, 3)]);
        let (columns, rows) = (pattern.symbolic().col_ptr(), pattern.symbolic().row_idx());
        assert_eq!(columns, &[0, 2, 5, 7, 10]);
        assert_eq!(rows, &[0, 3, 1, 2, 3, 1, 2, 0, 1, 3]);
        let [ab, ba] = pattern.link_slots(2);
        assert_eq!((rows[ab], rows[ba]), (1, 3));
    }
}
