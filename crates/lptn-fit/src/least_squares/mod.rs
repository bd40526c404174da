//! Nonlinear least squares with bounds and priors.
//!
//! [`minimise`] finds the parameters `p` for which the sum of the squares of the residuals `r(p)`
//! is least, by the method of Levenberg and Marquardt in the form of J. J. Moré (The
//! Levenberg-Marquardt algorithm: implementation and theory, Lecture Notes in Mathematics 630
//! (1978) 105): a trust region in parameters scaled by the norms of the Jacobian's columns, so that
//! the units of the parameters do not matter. Bounds are part of each step: it minimises the linear
//! model inside the box and the region by an active set (P. B. Stark and R. L. Parker,
//! Computational Statistics 10 (1995) 129), so a minimum on a bound is reached and
//! [`LeastSquaresFit::on_bound`] says which.
//!
//! Only the triangular factor of `[J r]` is used; `J^T J` is never formed.
//!
//! ```
//! use lptn_fit::least_squares::{Evaluated, LeastSquaresError, Residuals, Settings, minimise};
//!
//! /// y = a exp(b x) through three points.
//! struct Growth;
//!
//! impl Residuals for Growth {
//!     fn parameters(&self) -> usize {
//!         2
//!     }
//!
//!     fn evaluate(&mut self, p: &[f64], _: bool) -> Evaluated {
//!         let data = [(0.0, 2.0), (1.0, 4.0), (2.0, 8.0)];
//!         let residuals = data.map(|(x, y)| p[0] * f64::exp(p[1] * x) - y);
//!         let by_a = data.map(|(x, _)| f64::exp(p[1] * x));
//!         let by_b = data.map(|(x, _)| p[0] * x * f64::exp(p[1] * x));
//!         Ok((residuals.to_vec(), [by_a, by_b].concat()))
//!     }
//! }
//!
//! let found = minimise(&mut Growth, &[1.0, 1.0], &Settings::default())?;
//! assert!(found.outcome.converged());
//! assert!((found.parameters[1] - 2_f64.ln()).abs() < 1e-9);
//! # Ok::<(), LeastSquaresError>(())
//! ```

mod error;
mod estimate;
mod linear;
mod region;
mod search;

pub use error::LeastSquaresError;
pub use estimate::{LeastSquaresFit, Side, Stop, Termination, Test};
pub use search::minimise;

/// Residuals, and their derivatives or nothing.
pub type Evaluated = Result<(Vec<f64>, Vec<f64>), LeastSquaresError>;

/// A model with data: residuals as functions of parameters.
pub trait Residuals {
    /// The number of parameters, which does not change.
    fn parameters(&self) -> usize;

    /// The residuals (model less data, each over its standard deviation if they differ) at `p`. If
    /// `derivatives` is true also these, one parameter after the other: `d r_i / d p_j` at `j *
    /// residuals.len() + i`.
    ///
    /// The number of residuals does not change. `p` keeps the bounds. If the model has no value at
    /// `p`, a residual that is NaN or infinite asks for a shorter step.
    ///
    /// # Errors
    /// [`LeastSquaresError::Interrupted`] ends the search.
    fn evaluate(&mut self, p: &[f64], derivatives: bool) -> Evaluated;
}

/// Prior knowledge of a parameter: `value ± sigma`. It counts as one more residual, `(p - value) /
/// sigma`, so the others should be in units of their standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Index of the parameter.
    pub parameter: usize,
    /// Its expected value.
    pub value: f64,
    /// One standard deviation, positive.
    pub sigma: f64,
}

/// Settings of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Least and greatest value of every parameter, infinite if there is none; empty if no
    /// parameter has bounds.
    pub bounds: Vec<(f64, f64)>,
    /// Prior knowledge.
    pub priors: Vec<Prior>,
    /// The search ends if the part of the residuals that the free parameters could still remove, to
    /// first order, is this part of all residuals (relative offset: D. M. Bates, D. G. Watts,
    /// Technometrics 23 (1981) 179). With n residuals and k parameters the parameters are then
    /// within `gradient * sqrt(n)` of their standard errors.
    pub gradient: f64,
    /// The search ends if a full step changes no parameter by more than this part of it.
    pub step: f64,
    /// Differences of the sum of squares by less than this part of it count as rounding. A step
    /// with a predicted and actual change below it is judged by `gradient`'s measure instead. While
    /// that falls by a tenth or more the search goes on. It then ends with the parameters within
    /// `sqrt(cost n)` of their standard errors.
    pub cost: f64,
    /// Root of the sum of the squares of the residuals' errors if their model is less precise than
    /// double precision; 0 if it is not. A full step that fails to lower the sum of squares, and
    /// was predicted to change it by less than this error does, is judged like one within `cost`.
    /// The parameters then have the errors that follow from it.
    pub error: f64,
    /// The largest number of steps that lower the sum of squares.
    pub iterations: usize,
    /// The first step moves the scaled parameters by no more than this times their length.
    pub reach: f64,
}

impl Default for Settings {
    /// The limits of double precision: 1e-9, 1e-11 and 1e-12, in 1000 steps of reach 3.
    fn default() -> Self {
        Self {
            bounds: Vec::new(),
            priors: Vec::new(),
            gradient: 1e-9,
            step: 1e-11,
            cost: 1e-12,
            error: 0.0,
            iterations: 1000,
            reach: 3.0,
        }
    }
}
