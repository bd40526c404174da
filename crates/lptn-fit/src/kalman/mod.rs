//! Linear systems with Gaussian noise: a filter that takes one reading after the other (R. E. Kalman,
//! J. Basic Eng. 82 (1960) 35), and a smoother that knows all of them (G. J. Bierman, Fixed interval
//! smoothing with discrete measurements, Int. J. Control 18 (1973) 65), which inverts nothing.
//!
//! States have any unit; a covariance has the product of those of its two states. Matrices stand row
//! by row.

mod filter;
mod smoother;

pub use filter::{Filter, Innovation};
pub use smoother::Smoother;

/// What is known of the states: their mean and covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    /// Mean of each state.
    pub mean: Vec<f64>,
    /// Covariance of every two.
    pub covariance: Vec<f64>,
}

/// How the states go on: `x' = transition x + input + noise`.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What each state becomes of every other.
    pub transition: Vec<f64>,
    /// What comes to each.
    pub input: Vec<f64>,
    /// The covariance of what is not known beforehand.
    pub noise: Vec<f64>,
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

/// `a b a'`, symmetric as `b` is.
fn carried(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let half: Vec<f64> = b.chunks_exact(n).flat_map(|row| multiplied(a, row)).collect();
    // row i of `half` is a b_i; its columns are what rows of `a` meet
    let mut out = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let sum = (0..n).map(|k| a[i * n + k] * half[k * n + j]).sum::<f64>();
            (out[i * n + j], out[j * n + i]) = (sum, sum);
        }
    }
    out
}
