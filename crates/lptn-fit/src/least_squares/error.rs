//! Reasons why nothing could be minimised.

lptn_units::errors! {
/// Reasons why the sum of squares could not be minimised. A search that ends without a minimum is a
/// [`Termination`](super::Termination) and not an error. Parameters are counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum LeastSquaresError {
    /// The model asked for an end.
    Interrupted = "fit::interrupted", "the search was interrupted";
    /// Start values or bounds differ in number from the parameters, or a prior has no parameter.
    Parameters { expected: usize, got: usize } = "fit::parameters",
        format!("there are {expected} parameters, and values or bounds for {got}");
    /// The number of residuals or derivatives has changed, or is not the required one.
    Residuals { expected: usize, got: usize } = "fit::residuals",
        format!("the model gave {got} residuals or derivatives instead of {expected}");
    /// The bounds of a parameter are not in ascending order.
    Bounds { parameter: usize } = "fit::bounds",
        format!("the least value of parameter {parameter} is not below its greatest");
    /// The standard deviation of a prior is not positive, or its value not finite.
    Prior { parameter: usize } = "fit::prior",
        format!("the prior of parameter {parameter} is not a value with a positive deviation");
    /// The singular values of the Jacobian could not be computed.
    Decomposition = "fit::decomposition", "the singular values of the Jacobian do not converge";
}
}
