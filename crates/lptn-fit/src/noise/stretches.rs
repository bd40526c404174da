//! Means of stretches of a record.
//!
//! A fit responds to slow noise only, and rounding misleads the rest, so the means of some 100
//! stretches get the model. With 400 stretches the fast noise inside them was fitted, and drift of
//! 300 s was covered in half of all records.

use crate::noise::likelihood::orthonormal;

/// A record of fewer samples is not cut.
const LONG: usize = 400;

/// Minimum number of stretches of a longer record. More would follow the fast noise, which no fit
/// feels, and the slow noise would be taken for faster than it is.
const STRETCHES: usize = 100;

/// The part of the derivatives' squares that the means have to keep.
const KEPT: f64 = 0.9995;

/// The number of samples of one stretch: as many as leave [`STRETCHES`] of them, but so few that
/// the derivatives hardly change inside one.
pub(super) fn size(rows: usize, jacobian: &[f64]) -> usize {
    let basis = orthonormal(jacobian, rows);
    let mut size = longest(rows);
    while size > 1 && !basis.iter().all(|column| keeps(column, size)) {
        size /= 2;
    }
    size
}

/// The number of samples that leaves [`STRETCHES`]: in those the fast noise is white, so that only
/// slow noise is left to estimate.
pub(crate) fn longest(rows: usize) -> usize {
    if rows < LONG { 1 } else { rows / STRETCHES }
}

fn keeps(column: &[f64], size: usize) -> bool {
    let whole: f64 = column[..column.len() / size * size].iter().map(|x| x * x).sum();
    let kept: f64 = means(column, size).iter().map(|x| x * x).sum::<f64>() * size as f64;
    kept >= KEPT * whole
}

/// The mean of every whole stretch.
pub(crate) fn means(values: &[f64], size: usize) -> Vec<f64> {
    values.chunks_exact(size).map(|stretch| stretch.iter().sum::<f64>() / size as f64).collect()
}

/// The same for every column of `rows` rows.
pub(super) fn means_of_columns(columns: &[f64], rows: usize, size: usize) -> Vec<f64> {
    columns.chunks(rows.max(1)).flat_map(|column| means(column, size)).collect()
}
