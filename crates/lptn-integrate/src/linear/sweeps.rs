//! Sweeps through the strict lower triangle of a symmetric matrix, row by row.

/// A strict lower triangle by rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lower<'a> {
    /// Where each row ends and the next one begins; 0 at first.
    pub(super) begins: &'a [u32],
    /// The column of each entry.
    pub(super) columns: &'a [u32],
    /// The entries.
    pub(super) entries: &'a [f64],
}

impl<'a> Lower<'a> {
    /// Columns and entries of each row, from the first to the last or back.
    fn rows(self) -> impl DoubleEndedIterator<Item = (&'a [u32], &'a [f64])> + ExactSizeIterator {
        self.begins.windows(2).map(move |ends| {
            let row = ends[0] as usize..ends[1] as usize;
            (&self.columns[row.clone()], &self.entries[row])
        })
    }

    /// Replaces `z` by the solution of `(I + L) y = z`, and tells each component to `with`.
    pub(super) fn forward(self, z: &mut [f64], mut with: impl FnMut(usize, f64)) {
        for (row, (columns, entries)) in self.rows().enumerate() {
            let value = z[row] - product(columns, entries, z);
            z[row] = value;
            with(row, value);
        }
    }

    /// Replaces `z` by the solution of `(I + L') y = z`.
    pub(super) fn backward(self, z: &mut [f64]) {
        for (row, (columns, entries)) in self.rows().enumerate().rev() {
            let value = z[row];
            for (&column, entry) in columns.iter().zip(entries) {
                z[column as usize] -= entry * value;
            }
        }
    }

    /// The components of `L x`, from the first on.
    pub(super) fn times(self, x: &'a [f64]) -> impl Iterator<Item = f64> {
        self.rows().map(move |(columns, entries)| product(columns, entries, x))
    }

    /// Writes `y = (L + D + L') x`, `D` given by its diagonal.
    pub(super) fn multiply(self, diagonal: &[f64], x: &[f64], y: &mut [f64]) {
        for (row, ((columns, entries), diagonal)) in self.rows().zip(diagonal).enumerate() {
            let value = x[row];
            let mut sum = diagonal * value;
            for (&column, entry) in columns.iter().zip(entries) {
                sum += entry * x[column as usize];
                y[column as usize] += entry * value;
            }
            y[row] = sum; // later rows add to it
        }
    }
}

fn product(columns: &[u32], entries: &[f64], x: &[f64]) -> f64 {
    columns.iter().zip(entries).map(|(&column, entry)| entry * x[column as usize]).sum()
}
