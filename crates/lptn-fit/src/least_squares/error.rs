//! Why nothing could be minimised.

use std::fmt;

/// Why the sum of squares could not be minimised. A search that ends without a minimum is an
/// [`Outcome`](super::Outcome) and no error.
#[derive(Clone, Debug, PartialEq)]
pub enum LeastSquaresError<E> {
    /// The model could not be computed.
    Problem(E),
    /// Start values or bounds are not as many as the parameters, or a prior is of none of them.
    Parameters {
        /// Number of parameters.
        expected: usize,
        /// What was given.
        got: usize,
    },
    /// Residuals or derivatives are not as many as they were, or as they have to be.
    Residuals {
        /// How many there have to be.
        expected: usize,
        /// How many there were.
        got: usize,
    },
    /// The bounds of a parameter do not lie one below the other.
    Bounds {
        /// Which parameter.
        parameter: usize,
    },
    /// The standard deviation of a prior is not positive, or its value not finite.
    Prior {
        /// Which parameter.
        parameter: usize,
    },
    /// The singular values of the Jacobian could not be computed.
    Decomposition,
}

impl<E> LeastSquaresError<E> {
    /// The stable code, as diagnostics print it; `None` where the model failed, which has its own.
    pub fn code(&self) -> Option<&'static str> {
        match self {
            Self::Problem(_) => None,
            Self::Parameters { .. } => Some("fit::parameters"),
            Self::Residuals { .. } => Some("fit::residuals"),
            Self::Bounds { .. } => Some("fit::bounds"),
            Self::Prior { .. } => Some("fit::prior"),
            Self::Decomposition => Some("fit::decomposition"),
        }
    }
}

impl<E: fmt::Display> fmt::Display for LeastSquaresError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Problem(error) => error.fmt(f),
            Self::Parameters { expected, got } => {
                write!(f, "there are {expected} parameters, and values or bounds for {got}")
            }
            Self::Residuals { expected, got } => {
                write!(f, "the model gave {got} residuals or derivatives in place of {expected}")
            }
            Self::Bounds { parameter } => {
                write!(f, "the least value of parameter {parameter} is not below its greatest")
            }
            Self::Prior { parameter } => {
                write!(f, "the prior of parameter {parameter} is no value with a positive deviation")
            }
            Self::Decomposition => f.write_str("the singular values of the Jacobian do not converge"),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> std::error::Error for LeastSquaresError<E> {}
