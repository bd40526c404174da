//! Likely causes of a misfit: instruments that read too high, or that are late.

use faer::MatRef;
use lptn_integrate::dense;

use crate::network::lag::follow;
use crate::network::model::{Block, Evaluated};
use crate::network::task::NetworkFitTask;

/// An error that would explain most residuals of a column if the parameters were fitted with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hint {
    /// The instrument reads this much too high, in the SI unit of its column.
    Offset(f64),
    /// It follows with this time constant in s.
    Lag(f64),
}

/// A misfit above this number of standard deviations is not chance.
pub const FAR: f64 = 3.0;

/// The part of the squares that may be left, in addition to the noise from `sigma`.
const LEFT: f64 = 0.03;

/// The residuals to explain.
pub(crate) struct Missed<'a> {
    pub(crate) task: &'a NetworkFitTask,
    pub(crate) at_end: &'a Evaluated,
    /// The blocks with values.
    pub(crate) blocks: Vec<&'a Block>,
    /// Derivatives of all residuals by the parameters that are free and distinguished.
    pub(crate) slopes: Vec<&'a [f64]>,
}

impl Missed<'_> {
    /// For each column index, the likely cause of its misfit if that is far more than `sigma`. The
    /// change of the parameters is predicted from their derivatives.
    pub(crate) fn hints(&self) -> Vec<Option<Hint>> {
        let columns = self.blocks.iter().map(|block| block.column + 1).max().unwrap_or(0);
        let mut hints = vec![None; columns];
        let far: Vec<usize> = (0..columns).filter(|&column| self.is_far(column)).collect();
        // with as few values as unknowns anything would be explained
        if far.is_empty() || self.at_end.residuals.len() <= self.slopes.len() + far.len() {
            return hints;
        }
        let slow = |block: &Block| self.late(block, None);
        let found = self.explained(&far, &slow);
        let mut lags = vec![None; columns];
        for (&column, found) in far.iter().zip(&found) {
            lags[column] = Some(-found.change).filter(|lag| *lag > 0.0);
        }
        // again with the delay itself, which the slope alone does not give
        let slow = |block: &Block| self.late(block, lags[block.column]);
        for (&column, found) in far.iter().zip(self.explained(&far, &slow)) {
            let lag = lags[column].filter(|_| found.is_most).map(|lag| -found.change * lag);
            hints[column] = lag.filter(|lag| *lag > 0.0).map(Hint::Lag);
        }
        let offset = |block: &Block| vec![1.0; block.range.len()];
        for (&column, found) in far.iter().zip(self.explained(&far, &offset)) {
            let offset = found.is_most.then_some(Hint::Offset(-found.change));
            hints[column] = offset.or(hints[column]);
        }
        hints
    }

    fn of_column(&self, column: usize) -> impl Iterator<Item = &Block> {
        self.blocks.iter().copied().filter(move |block| block.column == column)
    }

    fn is_far(&self, column: usize) -> bool {
        self.of_column(column).any(|block| {
            let squares: f64 =
                self.at_end.residuals[block.range.clone()].iter().map(|r| r * r).sum();
            let given = self.task.runs[block.run].columns[column].sigma.is_some();
            given && squares > FAR * FAR * block.range.len() as f64
        })
    }

    /// The multiples of a change `by` of each column that explain its residuals, all at once.
    fn explained(&self, columns: &[usize], by: &dyn Fn(&Block) -> Vec<f64>) -> Vec<Explained> {
        let rows = self.at_end.residuals.len();
        let mut all: Vec<f64> =
            self.slopes.iter().flat_map(|column| column.iter()).copied().collect();
        for &column in columns {
            let mut change = vec![0.0; rows];
            for block in self.of_column(column) {
                let weight = self.task.runs[block.run].columns[column].weight();
                let places = change[block.range.clone()].iter_mut().zip(by(block));
                places.for_each(|(at, x)| *at = x / weight);
            }
            all.extend(change);
        }
        let count = self.slopes.len() + columns.len();
        let norms: Vec<f64> =
            all.chunks(rows).map(|c| c.iter().map(|x| x * x).sum::<f64>().sqrt()).collect();
        for (column, norm) in all.chunks_mut(rows).zip(&norms) {
            column.iter_mut().for_each(|x| *x /= norm);
        }
        let missed = MatRef::from_column_major_slice(&self.at_end.residuals, rows, 1);
        let matrix = MatRef::from_column_major_slice(&all, rows, count);
        let found = dense::least_squares(matrix, missed);
        let left = |i: usize| -> f64 {
            self.at_end.residuals[i]
                - (0..count).map(|j| all[j * rows + i] * found[(j, 0)]).sum::<f64>()
        };
        let answer = |(k, &column): (usize, &usize)| {
            let sum = |of: &dyn Fn(usize) -> f64| -> f64 {
                let places = self.of_column(column).flat_map(|block| block.range.clone());
                places.map(|i| of(i) * of(i)).sum()
            };
            let noise = sum(&|_| 1.0);
            let is_most = sum(&left) < LEFT * sum(&|i| self.at_end.residuals[i]) + noise;
            let at = self.slopes.len() + k;
            Explained { change: found[(at, 0)] / norms[at], is_most }
        };
        columns.iter().enumerate().map(answer).collect()
    }

    /// Change by a delay: by this lag, or without one by a second.
    fn late(&self, block: &Block, lag: Option<f64>) -> Vec<f64> {
        let run = &self.task.runs[block.run];
        let now = &self.at_end.modelled[block.rows.clone()];
        let end = now.len() - 1;
        let slope = |row: usize| {
            let (from, to) = (row.saturating_sub(1), (row + 1).min(end));
            (now[from] - now[to]) / (run.times[to] - run.times[from])
        };
        let change: Vec<f64> = match lag {
            Some(lag) => {
                let late = follow(&run.times, now, lag).course;
                late.iter().zip(now).map(|(late, now)| late - now).collect()
            }
            None => (0..now.len()).map(slope).collect(),
        };
        let values = run.columns[block.column].values.iter();
        change.into_iter().zip(values).filter(|(_, v)| !v.is_nan()).map(|(x, _)| x).collect()
    }
}

/// Explanation of residuals by a change of a column.
struct Explained {
    /// Multiple of the change.
    change: f64,
    /// True if all but [`LEFT`] and noise is explained.
    is_most: bool,
}
