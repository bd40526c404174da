//! Linear systems with Gaussian noise: a filter that takes one reading after the other (R. E. Kalman,
//! J. Basic Eng. 82 (1960) 35), and a smoother that knows all of them (G. J. Bierman, Fixed interval
//! smoothing with discrete measurements, Int. J. Control 18 (1973) 65), which inverts nothing.
//!
//! States have any unit; a covariance has the product of those of its two states. Matrices are
//! stored row by row.

mod augmented;
mod filter;
mod smoother;
mod transition;

use std::rc::Rc;

use lptn_integrate::vectors::{add, dot};

pub use augmented::{Augmented, Estimate, Part, Unknowns};
pub use filter::{Filter, Innovation};
pub use smoother::{Later, Smoother, Told};
pub use transition::{Fade, Transition};

/// A sum of states: the index of each, and its weight.
pub type Weights = [(usize, f64)];

/// Distribution of the states: their mean and covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    /// Mean of each state.
    pub mean: Vec<f64>,
    /// Covariance of every two.
    pub covariance: Vec<f64>,
}

/// Transition of the states to the next moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Matrix of the first states.
    pub transition: Rc<Transition>,
    /// Input to each of them.
    pub input: Rc<Vec<f64>>,
    /// Covariance of the noise that is added to them.
    pub noise: Rc<Vec<f64>>,
    /// Transitions of the states after them; further states stay as they are.
    pub fades: Rc<Vec<Fade>>,
}

/// A number that was read: `value = of x + noise`.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Weights of the states in it.
    pub of: Rc<Weights>,
    /// Measured value.
    pub value: f64,
    /// The variance of its noise, above 0.
    pub variance: f64,
}

impl Gaussian {
    /// The mean of a sum of states and its standard deviation.
    pub fn of(&self, weights: &Weights) -> (f64, f64) {
        let spread = self.spread(weights);
        (weighed(weights, &self.mean), weighed(weights, &spread).max(0.0).sqrt())
    }

    /// The covariance of a sum of states with each state.
    fn spread(&self, weights: &Weights) -> Vec<f64> {
        let mut spread = vec![0.0; self.mean.len()];
        self.spread_to(weights, &mut spread);
        spread
    }

    fn spread_to(&self, weights: &Weights, spread: &mut [f64]) {
        let n = spread.len();
        spread.fill(0.0);
        for &(place, weight) in weights {
            add(spread, weight, &self.covariance[place * n..][..n]);
        }
    }
}

fn weighed(weights: &Weights, x: &[f64]) -> f64 {
    weights.iter().map(|(place, weight)| weight * x[*place]).sum()
}

/// A matrix times a vector.
pub(crate) fn multiplied(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(x.len().max(1)).map(|row| dot(row, x)).collect()
}
