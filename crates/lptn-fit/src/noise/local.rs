//! Noise whose strength changes within the record: beside a part that starts to rattle, or with the
//! temperature.
//!
//! Blocks of means of the residual, not of its square, determine the strength; their scatter gives
//! their error. The residual of a wrong curve grows in one part of the record too, so changes from
//! row to row have to differ as well. They have to differ clearly, because a strength found by
//! chance makes errors smaller.

use std::borrow::Cow;

use lptn_integrate::vectors::dot;
use lptn_units::statistics::chi_square_999;

use super::stretches;

/// Blocks of the record whose strengths are compared, at most, and the least.
const BLOCKS: usize = 8;
const LEAST_BLOCKS: usize = 2;

/// A block has to hold as many independent values.
const ENOUGH: f64 = 16.0;

/// Of longer records means of stretches are looked at, so many.
const LONG: usize = 2000;

/// How far an uneven noise has to lie beyond what chance brings about in one of 1000 records: how
/// many values are independent is an estimate too, and of few blocks a rough one.
const CLEARLY: f64 = 2.0;

/// Correlations below this part no longer count.
const ALIKE: f64 = 0.05;

/// The standard deviation of the noise at each sample over the root of the mean square of all;
/// empty where chance explains how it differs from block to block.
/// Neighbours have to differ more or less too: a curve that the model does not follow makes what is
/// missed larger in one part of the record, and is not noise.
///
/// Strengths are means of what is missed, not of its square, and how far such a mean may be off is
/// taken from its own scatter: so heavy tails and rounding look no more uneven than they are. They
/// change along straight lines in the logarithm from the middle of a block to that of the next.
pub(super) fn strengths(residuals: &[f64]) -> Vec<f64> {
    let size = residuals.len().div_ceil(LONG).max(1);
    let means = |values: Vec<f64>| stretches::means(&values, size);
    let sizes = means(residuals.iter().map(|r| r.abs()).collect());
    let changes = means(residuals.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect());
    let independent = Blocks::of(&sizes, BLOCKS).independent();
    let count = ((independent / ENOUGH) as usize).min(BLOCKS);
    if count < LEAST_BLOCKS {
        return Vec::new();
    }
    let blocks = Blocks::of(&sizes, count);
    if blocks.differ() && Blocks::of(&changes, count).differ() {
        blocks.strengths(residuals.len())
    } else {
        Vec::new()
    }
}

/// Residuals and their derivatives as they would be if the noise had one strength.
pub(super) fn even<'a>(strengths: &[f64], values: &'a [f64]) -> Cow<'a, [f64]> {
    if strengths.is_empty() {
        return Cow::Borrowed(values);
    }
    let even = |column: &[f64]| column.iter().zip(strengths).map(|(x, s)| x / s).collect();
    let columns: Vec<Vec<f64>> = values.chunks(strengths.len()).map(even).collect();
    Cow::Owned(columns.concat())
}

/// The same the other way round.
pub(super) fn uneven<'a>(strengths: &[f64], values: &'a [f64]) -> Cow<'a, [f64]> {
    let back: Vec<f64> = strengths.iter().map(|s| 1.0 / s).collect();
    even(&back, values)
}

/// How far values are off from 0, in blocks that follow each other.
struct Blocks<'a> {
    sizes: &'a [f64],
    count: usize,
    /// The mean of each block.
    means: Vec<f64>,
}

impl<'a> Blocks<'a> {
    fn of(sizes: &'a [f64], count: usize) -> Self {
        let mut sums = vec![(0.0, 0.0_f64); count];
        for (i, size) in sizes.iter().enumerate() {
            let (sum, number) = &mut sums[i * count / sizes.len()];
            (*sum, *number) = (*sum + size, *number + 1.0);
        }
        let means = sums.iter().map(|(sum, number)| sum / number.max(1.0)).collect();
        Self { sizes, count, means }
    }

    fn block(&self, i: usize) -> usize {
        i * self.count / self.sizes.len()
    }

    /// What each value is beyond the mean of its block, over that.
    fn beyond(&self) -> Vec<f64> {
        let mean = |i: usize| self.means[self.block(i)].max(f64::MIN_POSITIVE);
        self.sizes.iter().enumerate().map(|(i, size)| size / mean(i) - 1.0).collect()
    }

    /// How many independent values would tell the mean as well; 0 where all values are the same.
    fn independent(&self) -> f64 {
        let beyond = self.beyond();
        let n = beyond.len();
        let product = |lag: usize| -> f64 { dot(&beyond, &beyond[lag..]) };
        let own = product(0);
        if own <= 0.0 || !own.is_finite() {
            return 0.0;
        }
        let alike = (1..n / 4).map(|lag| product(lag) / own).take_while(|r| *r > ALIKE);
        n as f64 / (1.0 + 2.0 * alike.sum::<f64>())
    }

    /// Whether means differ by more than chance explains.
    fn differ(&self) -> bool {
        if self.means.iter().any(|mean| *mean <= 0.0) {
            return false;
        }
        let beyond = self.beyond();
        let variance = beyond.iter().map(|b| b * b).sum::<f64>() / beyond.len() as f64;
        let of_mean = variance * self.count as f64 / self.independent().max(1.0);
        let logarithms: Vec<f64> = self.means.iter().map(|mean| mean.ln()).collect();
        let middle = logarithms.iter().sum::<f64>() / self.count as f64;
        let squares: f64 = logarithms.iter().map(|l| (l - middle).powi(2)).sum();
        squares / of_mean > CLEARLY * chi_square_999(self.count as f64 - 1.0)
    }

    fn strengths(&self, rows: usize) -> Vec<f64> {
        let n = rows as f64;
        let last = self.count - 1;
        let at = |i: usize| {
            let place = ((i as f64 + 0.5) / n * self.count as f64 - 0.5).clamp(0.0, last as f64);
            let below = (place as usize).min(last.saturating_sub(1));
            let part = place - below as f64;
            let [a, b] = [below, below + 1].map(|block| self.means[block].ln());
            (a + part * (b - a)).exp()
        };
        let mut all: Vec<f64> = (0..rows).map(at).collect();
        let whole = (all.iter().map(|s| s * s).sum::<f64>() / n).sqrt();
        all.iter_mut().for_each(|s| *s /= whole);
        all
    }
}
