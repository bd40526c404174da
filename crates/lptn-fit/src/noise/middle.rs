//! The middle of the sandwich.

use lptn_units::statistics::{NORMAL_95, degrees_of, mixed_95, student_95};

use super::likelihood::{Possible, Shape};
use super::{Noise, stretches};
use crate::Covariance;

/// `J^T Omega J` of the samples of one record, and its uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct Middle {
    /// Row by row; the number of parameters squared.
    pub values: Vec<f64>,
    /// Derivatives by the two numbers that maximise the likelihood.
    slopes: [Vec<f64>; 2],
    spread: [[f64; 2]; 2],
    /// Means less fitted parameters.
    free: f64,
    /// If several shapes of the noise are possible: the probability of each, and its values.
    possible: Vec<(f64, Vec<f64>)>,
}

impl Middle {
    pub(super) fn new(noise: &Noise, times: &[f64], jacobian: &[f64]) -> Self {
        let means = noise.means;
        let columns = stretches::means_of_columns(jacobian, times.len(), noise.stretch);
        let times = stretches::means(times, noise.stretch);
        let of = |shape: Shape, deviation: f64| -> Vec<f64> {
            let scale = deviation * noise.stretch as f64;
            product(&times, &columns, shape).into_iter().map(|x| x * scale * scale).collect()
        };
        let scaled = |shape: Shape| of(shape, means.deviation);
        let values = scaled(Shape { correlated: means.correlated, time: means.time });
        let free = times.len().saturating_sub(noise.rank).max(1) as f64;
        let one = |p: &Possible| (p.weight, of(p.shape, p.deviation));
        let possible: Vec<(f64, Vec<f64>)> = noise.possible.iter().map(one).collect();
        if means.time <= 0.0 || !possible.is_empty() {
            let none = vec![0.0; values.len()];
            let slopes = [none.clone(), none];
            return Self { values, slopes, spread: noise.spread, free, possible };
        }
        let slope = |by: [f64; 2]| {
            const STEP: f64 = 0.05;
            let place = |sign: f64| std::array::from_fn(|k| noise.place[k] + sign * STEP * by[k]);
            let to = |sign: f64| scaled(Shape::at(place(sign), noise.spacing));
            to(1.0).iter().zip(to(-1.0)).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
        };
        let slopes = [slope([1.0, 0.0]), slope([0.0, 1.0])];
        Self { values, slopes, spread: noise.spread, free, possible }
    }

    /// The degrees of freedom of the variance of a quantity with these derivatives by all
    /// parameters of the fit; `inverse` is `(J^T J)^-1`.
    pub fn degrees_of_freedom(&self, inverse: &Covariance, gradient: &[f64]) -> f64 {
        self.variance(inverse, gradient).1
    }

    /// The variance, followed by its degrees of freedom.
    pub(crate) fn variance(&self, inverse: &Covariance, gradient: &[f64]) -> (f64, f64) {
        let n = inverse.parameters.len();
        let weight = |i: usize| {
            (0..n).map(|j| inverse.values[i * n + j] * gradient[inverse.parameters[j]]).sum()
        };
        let weights: Vec<f64> = (0..n).map(weight).collect();
        let form =
            |m: &[f64]| (0..n * n).map(|at| weights[at / n] * m[at] * weights[at % n]).sum::<f64>();
        let variance = form(&self.values);
        if variance <= 0.0 {
            return (0.0, self.free);
        }
        if !self.possible.is_empty() {
            let one = |(weight, m): &(f64, Vec<f64>)| (*weight, form(m).max(0.0).sqrt());
            let errors: Vec<(f64, f64)> = self.possible.iter().map(one).collect();
            let known = student_95(self.free);
            let half = known / NORMAL_95 * mixed_95(&errors);
            return (variance, degrees_of(half / variance.sqrt()).min(self.free));
        }
        let relative = [form(&self.slopes[0]) / variance, form(&self.slopes[1]) / variance];
        let term = |i: usize, j: usize| relative[i] * self.spread[i][j] * relative[j];
        let uncertain = 2.0 / self.free + term(0, 0) + term(0, 1) + term(1, 0) + term(1, 1);
        (variance, (2.0 / uncertain).clamp(1.0, self.free))
    }
}

/// `J^T V J` with V of unit variance, row by row.
pub(super) fn product(times: &[f64], jacobian: &[f64], shape: Shape) -> Vec<f64> {
    let rows = times.len();
    let n = jacobian.len() / rows.max(1);
    let (mut values, mut x) = (vec![0.0; n * n], vec![0.0; n]);
    let mut tied = Tied::new(n, shape.correlated);
    let (mut apart, mut decay) = (f64::NAN, 0.0);
    for i in 0..rows {
        if i > 0 && shape.time > 0.0 {
            let next = times[i] - times[i - 1];
            if (next - apart).abs() > 1e-9 * next || apart.is_nan() {
                (apart, decay) = (next, (-next / shape.time).exp());
            }
            tied.pass(&x, decay);
        }
        x.iter_mut().enumerate().for_each(|(j, x)| *x = jacobian[j * rows + i]);
        tied.add(&x, 1.0, &mut values);
    }
    values
}

/// Rows of derivatives whose errors share a part with those before: exponential correlations add up
/// from row to row.
#[derive(Clone, Debug)]
pub(crate) struct Tied {
    /// The correlated part of the variance.
    correlated: f64,
    /// Decayed sum of the derivatives of earlier rows, one value a column.
    before: Vec<f64>,
}

impl Tied {
    /// The state before the first row.
    pub(crate) fn new(count: usize, correlated: f64) -> Self {
        Self { correlated, before: vec![0.0; count] }
    }

    /// Adds the contribution of a row to `variance J^T V J` to a matrix, row by row.
    pub(crate) fn add(&self, x: &[f64], variance: f64, sum: &mut [f64]) {
        let before = &self.before;
        for (i, a) in x.iter().enumerate() {
            for (j, b) in x.iter().enumerate() {
                let tied = self.correlated * (a * before[j] + before[i] * b);
                sum[i * x.len() + j] += variance * (a * b + tied);
            }
        }
    }

    /// Goes on to the row after this one, at which `decay` is left of their common part.
    pub(crate) fn pass(&mut self, x: &[f64], decay: f64) {
        self.before.iter_mut().zip(x).for_each(|(b, x)| *b = decay * (*b + x));
    }
}
