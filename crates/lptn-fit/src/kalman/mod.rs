//! Linear systems with Gaussian noise: a filter that takes one reading after the other (R. E. Kalman,
//! J. Basic Eng. 82 (1960) 35), and a smoother that knows all of them (G. J. Bierman, Fixed interval
//! smoothing with discrete measurements, Int. J. Control 18 (1973) 65), which inverts nothing.
//!
//! States have any unit; a covariance has the product of those of its two states. Matrices stand row
//! by row.

mod filter;
mod smoother;

use std::rc::Rc;

pub use filter::{Filter, Innovation};
pub use smoother::{Later, Smoother};

/// What is known of the states: their mean and covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    /// Mean of each state.
    pub mean: Vec<f64>,
    /// Covariance of every two.
    pub covariance: Vec<f64>,
}

/// How the first states go on, `x' = transition x + input + noise`; those behind them stay as they
/// are.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What each state becomes of every other.
    pub transition: Rc<Vec<f64>>,
    /// What comes to each.
    pub input: Vec<f64>,
    /// The covariance of what is not known beforehand.
    pub noise: Rc<Vec<f64>>,
}

/// A number that was read: `value = of x + noise`.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What each state brings to it.
    pub of: Vec<f64>,
    /// What was read.
    pub value: f64,
    /// The variance of its noise, above 0.
    pub variance: f64,
}

impl Gaussian {
    /// The mean of a sum of states and its standard deviation.
    pub fn of(&self, weights: &[f64]) -> (f64, f64) {
        let spread = multiplied(&self.covariance, weights);
        (dot(weights, &self.mean), dot(weights, &spread).max(0.0).sqrt())
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// A matrix times a vector.
fn multiplied(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(x.len()).map(|row| dot(row, x)).collect()
}

/// `T b T'`, symmetric as `b` is, where T is `a` for the first states and nothing but 1 behind them.
fn carried(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let d = side(a);
    // row i of `half` is T b_i; its columns are what rows of T meet
    let half: Vec<f64> = b.chunks_exact(n).flat_map(|row| advanced(a, row)).collect();
    let mut out = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let sum = match i < d {
                true => (0..d).map(|k| a[i * d + k] * half[k * n + j]).sum::<f64>(),
                false => half[i * n + j],
            };
            (out[i * n + j], out[j * n + i]) = (sum, sum);
        }
    }
    out
}

/// `T x`
fn advanced(a: &[f64], x: &[f64]) -> Vec<f64> {
    let (first, rest) = x.split_at(side(a));
    let mut all = multiplied(a, first);
    all.extend_from_slice(rest);
    all
}

/// The number of rows of a square matrix.
fn side(a: &[f64]) -> usize {
    a.len().isqrt()
}
