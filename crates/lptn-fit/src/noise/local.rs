//! Noise whose strength changes within the record: next to a part that starts to rattle, or with
//! the temperature.
//!
//! Blocks of means of the residual, not of its square, determine the strength; their scatter gives
//! their error. The residual of a wrong curve grows in one part of the record too, so changes from
//! row to row have to differ as well. They have to differ clearly, because a strength found by
//! chance makes errors smaller.

use std::borrow::Cow;

use lptn_integrate::vectors::dot;
use lptn_units::statistics::chi_square_999;

use super::stretches;

/// Largest number of blocks of the record whose strengths are compared, and the least.
const BLOCKS: usize = 8;
const LEAST_BLOCKS: usize = 2;

/// Minimum number of independent values in a block.
const ENOUGH: f64 = 16.0;

/// Largest number of values; longer records use means of stretches.
const LONG: usize = 2000;

/// Factor by which an uneven noise has to exceed the chance of one in 1000 records. The number of
/// independent values is an estimate too, and a rough one for few blocks.
const CLEARLY: f64 = 2.0;

/// Correlations below this part no longer count.
const ALIKE: f64 = 0.05;

/// The standard deviation of the noise at each sample over the root of the mean square of all;
/// empty if chance explains the differences between blocks.
/// Changes between neighbours have to differ too: a curve that the model does not follow makes the
/// residual larger in one part of the record, and is not noise.
///
/// Strengths are means of the residual, not of its square. The error of such a mean is taken from
/// its own scatter, so heavy tails and rounding look no more uneven than they are. They change
/// along straight lines in the logarithm from the middle of a block to that of the next.
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

/// Residuals and their derivatives as if the noise had one strength.
pub(super) fn even<'a>(strengths: &[f64], values: &'a [f64]) -> Cow<'a, [f64]> {
    if strengths.is_empty() {
        return Cow::Borrowed(values);
    }
    let even = |column: &[f64]| column.iter().zip(strengths).map(|(x, s)| x / s).collect();
    let columns: Vec<Vec<f64>> = values.chunks(strengths.len()).map(even).collect();
    Cow::Owned(columns.concat())
}

/// The inverse of `even`.
pub(super) fn uneven<'a>(strengths: &[f64], values: &'a [f64]) -> Cow<'a, [f64]> {
    let back: Vec<f64> = strengths.iter().map(|s| 1.0 / s).collect();
    even(&back, values)
}

/// Distances of values from 0, in blocks that follow each other.
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

    /// Distance of each value from the mean of its block, over that mean.
    fn beyond(&self) -> Vec<f64> {
        let mean = |i: usize| self.means[self.block(i)].max(f64::MIN_POSITIVE);
        self.sizes.iter().enumerate().map(|(i, size)| size / mean(i) - 1.0).collect()
    }

    /// Number of independent values that give the mean as well; 0 if all values are the same.
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

    /// True if means differ by more than chance explains.
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
