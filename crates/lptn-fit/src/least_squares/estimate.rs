//! Results of a search.

use crate::{Covariance, Spectrum};

/// A bound that a parameter is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Its least value.
    Lower,
    /// Its greatest value.
    Upper,
}

/// The test that ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// The part of the residuals that the free parameters could still remove is negligible.
    Gradient,
    /// A full step would change no parameter.
    Step,
    /// Steps change the sum of squares by no more than rounding, as was predicted.
    Cost,
}

/// Reasons why a search ended without a minimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The largest number of steps was made.
    Iterations,
    /// No step lowers the sum of squares, however short, although its derivative predicts it. The
    /// derivatives are wrong, or the model is noisier than
    /// [`Settings::error`](super::Settings::error).
    Stalled,
    /// The sum of squares falls towards parameters at which the model has no value.
    Edge,
    /// The residuals or derivatives at the start are not finite.
    StartNotFinite,
    /// The derivatives at the last point are not finite.
    DerivativeNotFinite,
}

impl Stop {
    /// Text for a sentence that begins with "the fit did not converge:".
    pub fn text(self) -> &'static str {
        match self {
            Self::Iterations => "the largest number of steps was made",
            Self::Stalled => {
                "no shorter step lowers the misfit, although its derivatives predict \
                it"
            }
            Self::Edge => "the misfit keeps falling towards values for which there is no run",
            Self::StartNotFinite => "the model has no finite value at the start",
            Self::DerivativeNotFinite => {
                "the model has no finite derivative at the end of the search"
            }
        }
    }
}

/// End of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Termination {
    /// At a minimum.
    Converged(Test),
    /// Elsewhere: the parameters are those of the lowest sum of squares up to now, and not a result.
    NotConverged(Stop),
}

impl Termination {
    /// True if it ended at a minimum.
    pub fn converged(self) -> bool {
        matches!(self, Self::Converged(_))
    }
}

/// End of a search. Residuals of priors follow those of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquaresFit {
    /// The parameters, in their order.
    pub parameters: Vec<f64>,
    /// Outcome of the search.
    pub outcome: Termination,
    /// The bound that each parameter is on. There the data ask for a value beyond the bound, or for
    /// none at all.
    pub on_bound: Vec<Option<Side>>,
    /// Sum of the squares of the residuals, priors included.
    pub squares: f64,
    /// The residuals at `parameters`, those of the data first.
    pub residuals: Vec<f64>,
    /// Their derivatives by the parameters, one parameter after the other.
    pub jacobian: Vec<f64>,
    /// Number of residuals that are data.
    pub data: usize,
    /// The part of the residuals that the free parameters could still remove, to first order; 0 at
    /// a minimum.
    pub offset: f64,
    /// Steps that lowered the sum of squares.
    pub iterations: usize,
    /// Evaluations of the residuals.
    pub evaluations: usize,
}

impl LeastSquaresFit {
    /// The parameters that are not on a bound.
    pub fn free(&self) -> Vec<usize> {
        (0..self.parameters.len()).filter(|&j| self.on_bound[j].is_none()).collect()
    }

    /// Residuals less free parameters, at least 0.
    pub fn degrees_of_freedom(&self) -> usize {
        self.residuals.len().saturating_sub(self.free().len())
    }

    /// `(J^T J)^-1` of the free parameters: their covariance if every residual is in units of its
    /// own standard deviation and independent of the others. It is multiplied by `squares /
    /// degrees_of_freedom` if only the ratios of the deviations are known. `None` if the rank of J
    /// is less than the number of free parameters.
    pub fn covariance(&self) -> Option<Covariance> {
        Covariance::inverse(&self.jacobian, self.residuals.len(), &self.free())
    }

    /// Spectrum of the parameters: [`Spectrum::new`] of the Jacobian with parameter j in units of
    /// `scales[j]`, all parameters included. With `scales` their values it is about their
    /// logarithms.
    pub fn spectrum(&self, scales: &[f64], threshold: f64) -> Option<Spectrum> {
        Spectrum::new(&self.jacobian, scales, threshold)
    }
}
