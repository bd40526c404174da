//! Shares of the variance for correlated parameters: straight lines through the base runs.

use crate::uncertainty::answer::Contribution;
use crate::uncertainty::estimate::Estimate;
use crate::uncertainty::sobol::{Blocks, Design, GROUPS};

/// The plane through the answers of all base runs over the parameters in standard deviations, and
/// the same without the runs of each group.
pub(super) struct Regression<'a> {
    blocks: &'a Blocks,
    /// For each run of [`Blocks::base`] its group, and the parameters in standard deviations.
    points: Vec<(usize, Vec<f64>)>,
    /// The plane of all runs, then the planes without each group.
    planes: Vec<Plane>,
}

/// The part of a plane that depends on the points alone.
struct Plane {
    left_out: Option<usize>,
    mean: Vec<f64>,
    /// The lower triangle of the squares and products about the mean; empty if they are not
    /// independent.
    factor: Vec<f64>,
}

impl<'a> Regression<'a> {
    pub(super) fn of(blocks: &'a Blocks, design: &Design<'_>) -> Self {
        let points: Vec<(usize, Vec<f64>)> = blocks
            .numbered()
            .map(|(number, which)| (number / blocks.per_group, design.standard(number, which)))
            .collect();
        let groups = std::iter::once(None).chain((0..GROUPS).map(Some));
        let planes = groups.map(|left_out| Plane::of(&points, left_out)).collect();
        Self { blocks, points, planes }
    }

    /// Every parameter's part in an answer: the slope of the plane, and the slope times the
    /// covariance with the answer over the answer's variance.
    pub(super) fn contributions(&self, place: usize) -> Vec<Contribution> {
        let answers: Vec<f64> =
            self.blocks.base().map(|(_, sample)| sample.answers[place]).collect();
        let found: Vec<Vec<[f64; 2]>> =
            self.planes.iter().map(|plane| plane.slopes(&self.points, &answers)).collect();
        let share = |input: usize| {
            Estimate::jackknife(GROUPS, |group| found[group.map_or(0, |group| group + 1)][input][1])
        };
        let count = found.first().map_or(0, Vec::len);
        let one = |input: usize| Contribution {
            input,
            effect: found[0][input][0],
            share: share(input),
            total: None,
        };
        (0..count).map(one).collect()
    }
}

impl Plane {
    fn of(points: &[(usize, Vec<f64>)], left_out: Option<usize>) -> Self {
        let count = points.first().map_or(0, |(_, x)| x.len());
        let kept = || points.iter().filter(|(group, _)| Some(*group) != left_out);
        let n = kept().count() as f64;
        let mut mean = vec![0.0; count];
        for (_, x) in kept() {
            mean.iter_mut().zip(x).for_each(|(sum, x)| *sum += x / n);
        }
        let mut squares = vec![0.0; count * count];
        for (_, x) in kept() {
            for i in 0..count {
                for j in 0..=i {
                    squares[i * count + j] += (x[i] - mean[i]) * (x[j] - mean[j]);
                }
            }
        }
        let factor = lower_triangle(&squares, count).unwrap_or_default();
        Self { left_out, mean, factor }
    }

    /// For each parameter the slope of the answers, and its share of their variance.
    fn slopes(&self, points: &[(usize, Vec<f64>)], answers: &[f64]) -> Vec<[f64; 2]> {
        let count = self.mean.len();
        let kept =
            || points.iter().zip(answers).filter(|((group, _), _)| Some(*group) != self.left_out);
        let n = kept().count() as f64;
        let mean = kept().map(|(_, y)| y).sum::<f64>() / n;
        let variance: f64 = kept().map(|(_, y)| (y - mean) * (y - mean)).sum();
        let mut products = vec![0.0; count];
        for ((_, x), y) in kept() {
            for i in 0..count {
                products[i] += (x[i] - self.mean[i]) * (y - mean);
            }
        }
        if variance <= 0.0 || self.factor.is_empty() {
            return vec![[0.0; 2]; count];
        }
        let slopes = solved(&self.factor, products.clone());
        slopes.into_iter().zip(products).map(|(b, c)| [b, b * c / variance]).collect()
    }
}

/// The lower triangle L with `L L^T` equal to a matrix of which the lower half is given.
fn lower_triangle(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let mut l = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
            let left = matrix[i * n + j] - known;
            if i != j {
                l[i * n + j] = left / l[j * n + j];
            } else if left > 0.0 {
                l[i * n + i] = left.sqrt();
            } else {
                return None;
            }
        }
    }
    Some(l)
}

/// The solution of `L L^T x = right`.
fn solved(l: &[f64], mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for i in 0..n {
        let known: f64 = (0..i).map(|k| l[i * n + k] * right[k]).sum();
        right[i] = (right[i] - known) / l[i * n + i];
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| l[k * n + i] * right[k]).sum();
        right[i] = (right[i] - known) / l[i * n + i];
    }
    right
}
