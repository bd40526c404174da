//! Sweeps through the strict lower triangle of a symmetric matrix, row by row.

use super::shape::{Run, Triangle};

/// A strict lower triangle by rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lower<'a> {
    runs: &'a [Run],
    columns: &'a [u32],
    entries: &'a [f64],
}

/// Runs `$body` on the columns and entries of the rows of a run. Rows of cells have one, two or
/// three entries: their loops are unrolled, which halves the instructions of a sweep.
macro_rules! unrolled {
    ($lower:ident, $run:ident, $rows:ident => $body:expr) => {{
        let (columns, entries) = $lower.run($run);
        unrolled!(@ $run, columns, entries, $rows => $body; 1, 2, 3, 4, 5, 6)
    }};
    (@ $run:ident, $columns:ident, $entries:ident, $rows:ident => $body:expr;
     $($few:literal),+) => {
        match $run.width as usize {
            0 => {
                let none: (&[u32], &[f64]) = (&[], &[]);
                let $rows = std::iter::repeat_n(none, $run.rows as usize);
                $body
            }
            $($few => {
                let $rows = $columns.chunks_exact($few).zip($entries.chunks_exact($few));
                $body
            })+
            many => {
                // chunks of an unknown length need a division
                let own = |row: usize| row * many..row * many + many;
                let $rows = (0..$run.rows as usize)
                    .map(|row| (&$columns[own(row)], &$entries[own(row)]));
                $body
            }
        }
    };
}

impl<'a> Lower<'a> {
    pub(super) fn new(triangle: &'a Triangle, entries: &'a [f64]) -> Self {
        Self { runs: &triangle.runs, columns: &triangle.columns, entries }
    }

    fn run(self, run: &Run) -> (&'a [u32], &'a [f64]) {
        let begin = run.begin as usize;
        let own = begin..begin + run.rows as usize * run.width as usize;
        (&self.columns[own.clone()], &self.entries[own])
    }

    /// Replaces `z` by the solution of `(I + L) y = z`.
    pub(super) fn forward(self, z: &mut [f64]) {
        for run in self.runs {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows) {
                    z[row] -= product(columns, entries, z);
                }
            });
        }
    }

    /// Replaces `z` by the solution of `(I + L') y = z`.
    pub(super) fn backward(self, z: &mut [f64]) {
        for run in self.runs.iter().rev() {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows).rev() {
                    let value = z[row];
                    for (&column, entry) in columns.iter().zip(entries) {
                        z[column as usize] -= entry * value;
                    }
                }
            });
        }
    }

    /// Passes each component of `L x` to `with`.
    pub(super) fn times(self, x: &[f64], mut with: impl FnMut(f64)) {
        for run in self.runs {
            unrolled!(self, run, rows => {
                rows.for_each(|(columns, entries)| with(product(columns, entries, x)));
            });
        }
    }

    /// Adds `L' x` to `y`.
    pub(super) fn add_transposed(self, x: &[f64], y: &mut [f64]) {
        for run in self.runs {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows) {
                    let value = x[row];
                    for (&column, entry) in columns.iter().zip(entries) {
                        y[column as usize] += entry * value;
                    }
                }
            });
        }
    }

    /// Writes `y = (I + L + L') x`.
    pub(super) fn multiply(self, x: &[f64], y: &mut [f64]) {
        for run in self.runs {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows) {
                    let value = x[row];
                    let mut sum = value;
                    for (&column, entry) in columns.iter().zip(entries) {
                        sum += entry * x[column as usize];
                        y[column as usize] += entry * value;
                    }
                    y[row] = sum; // later rows add to it
                }
            });
        }
    }

    /// Writes `x = (I + L)^-1 b` and `y = -L' x`.
    pub(super) fn descend(self, b: &[f64], x: &mut [f64], y: &mut [f64]) {
        for run in self.runs {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows) {
                    let value = b[row] - product(columns, entries, x);
                    x[row] = value;
                    y[row] = 0.0; // later rows subtract from it
                    for (&column, entry) in columns.iter().zip(entries) {
                        y[column as usize] -= entry * value;
                    }
                }
            });
        }
    }

    /// Replaces `x` by `(I + L')^-1 (b - L x)`; `b` is overwritten.
    pub(super) fn ascend(self, x: &mut [f64], b: &mut [f64]) {
        for run in self.runs.iter().rev() {
            unrolled!(self, run, rows => {
                for (row, (columns, entries)) in run.places().zip(rows).rev() {
                    let value = b[row] - product(columns, entries, x);
                    x[row] = value;
                    for (&column, entry) in columns.iter().zip(entries) {
                        b[column as usize] -= entry * value;
                    }
                }
            });
        }
    }
}

fn product(columns: &[u32], entries: &[f64], x: &[f64]) -> f64 {
    columns.iter().zip(entries).map(|(&column, entry)| entry * x[column as usize]).sum()
}
