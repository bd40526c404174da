//! Statistics of many numbers: means, quantiles and probabilities of the normal distribution, of
//! Student's t and of chi-square.

mod normal;
mod quantile;
mod significance;

pub use normal::{quantile, share_below};
pub use quantile::{chi_square_999, degrees_of, mixed_95, student_95};
pub use significance::two_sided;

/// Standard deviations on each side of the mean that contain 95 % of a normal distribution.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// The mean; NaN without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The sum of the squares of the distances from the mean.
pub fn squares_about_mean(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|value| (value - mean) * (value - mean)).sum()
}

/// The standard error of a number from its `values` with each part of the data left out in turn
/// (jackknife: B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, Chapman & Hall 1993,
/// chapter 11).
pub fn jackknife(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    ((n - 1.0) / n * squares_about_mean(values)).sqrt()
}
