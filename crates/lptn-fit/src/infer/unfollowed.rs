//! Rows of a record that no network can follow: an instrument out of its range.
//!
//! The estimates follow every reading. If one is wrong by far, the network has to be heated to it and
//! cooled again within a row, below absolute zero. The run of such estimates names a node and a
//! state that are not in the file, so the rows are named instead.

use lptn_solve::TransientError;

use crate::infer::error::InferError;
use crate::infer::task::InferTask;
use crate::network::MeasuredColumn;

/// Rows on each side of the time at which the run failed, among which the change is searched.
const ROWS: usize = 10;

/// A change counts if it is larger than this multiple of the usual one of its column.
const USUAL: f64 = 20.0;

/// A change of a column from a row to the next.
struct Change<'a> {
    column: &'a MeasuredColumn,
    /// Row after it.
    row: usize,
    /// Its size over the usual one.
    size: f64,
    /// Readings before and after it, in SI units.
    from: f64,
    to: f64,
}

/// The reason why the estimates have no run: the record, if it changes there far more than usual.
pub(crate) fn named(task: &InferTask, error: InferError) -> InferError {
    let InferError::Run(error) = error else { return error };
    let TransientError::Stopped { time, .. } = *error else { return InferError::Run(error) };
    let near = task.run.times.partition_point(|t| *t < time);
    let all = task.run.columns.iter().flat_map(|column| changes(column, near));
    let largest = all.max_by(|a, b| a.size.total_cmp(&b.size)).filter(|it| it.size > USUAL);
    let Some(Change { column, row, from, to, .. }) = largest else {
        return InferError::Run(error);
    };
    let zero = column.zero();
    InferError::Unfollowed {
        column: column.name.clone(),
        time: task.run.times[row],
        values: [from - zero, to - zero],
        unit: if column.ty.absolute { "degC".into() } else { column.ty.dimension.si_unit() },
        error,
    }
}

/// The changes of a column near a row.
fn changes(column: &MeasuredColumn, near: usize) -> Vec<Change<'_>> {
    let read: Vec<(usize, f64)> =
        column.values.iter().copied().enumerate().filter(|(_, value)| !value.is_nan()).collect();
    // rounded readings often do not change
    let sizes = read.windows(2).map(|pair| (pair[1].1 - pair[0].1).abs());
    let mut sizes: Vec<f64> = sizes.filter(|size| *size > 0.0).collect();
    sizes.sort_by(f64::total_cmp);
    let Some(usual) = sizes.get(sizes.len() / 2).copied() else { return Vec::new() };
    let close = read.windows(2).filter(|pair| pair[1].0.abs_diff(near) <= ROWS);
    let change = |pair: &[(usize, f64)]| {
        let ((_, from), (row, to)) = (pair[0], pair[1]);
        Change { column, row, size: (to - from).abs() / usual, from, to }
    };
    close.map(change).collect()
}
