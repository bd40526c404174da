//! Why nothing could be minimised.

lptn_units::errors! {
/// Why the sum of squares could not be minimised. A search that ends without a minimum is an
/// [`Termination`](super::Termination) and no error. Parameters are counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum LeastSquaresError {
    /// The model asked for an end.
    Interrupted = "fit::interrupted", "the search was interrupted";
    /// Start values or bounds are not as many as the parameters, or a prior is of none of them.
    Parameters { expected: usize, got: usize } = "fit::parameters",
        format!("there are {expected} parameters, and values or bounds for {got}");
    /// Residuals or derivatives are not as many as they were, or as they have to be.
    Residuals { expected: usize, got: usize } = "fit::residuals",
        format!("the model gave {got} residuals or derivatives instead of {expected}");
    /// The bounds of a parameter do not lie one below the other.
    Bounds { parameter: usize } = "fit::bounds",
        format!("the least value of parameter {parameter} is not below its greatest");
    /// The standard deviation of a prior is not positive, or its value not finite.
    Prior { parameter: usize } = "fit::prior",
        format!("the prior of parameter {parameter} is not a value with a positive deviation");
    /// The singular values of the Jacobian could not be computed.
    Decomposition = "fit::decomposition", "the singular values of the Jacobian do not converge";
}
}
