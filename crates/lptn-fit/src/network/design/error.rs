//! Reasons why a measurement cannot be planned.

use lptn_solve::SensitiveError;
use lptn_units::{Class, EvalError};

use crate::network::error::NetworkFitError;

lptn_units::errors! {
/// Reasons why a measurement cannot be planned. If nothing reaches the targets, that is an answer
/// and not an error.
#[derive(Debug)]
pub enum DesignError {
    /// A run that could be measured fails.
    Run { run: String, error: Box<SensitiveError> } = error.code(),
        format!("run `{run}`: {error}"),
        source error.as_ref(),
        class match &**error {
            SensitiveError::Run(_) => Class::Numbers,
            _ => Class::Input,
        };
    /// The existing records of a fit cannot be fitted.
    Given { fit: String, error: Box<NetworkFitError> } = error.code(),
        format!("fit `{fit}`: {error}"),
        source error.as_ref(),
        class error.class();
    /// The fit of existing records finds no minimum.
    NotConverged { fit: String } = "plan::given",
        format!("fit `{fit}`, whose records exist already, does not converge"),
        help format!("`lptn fit network` reports more; without it, leave `{fit}` out of `given`");
    /// A parameter to be estimated, by the plan or by a fit of existing records, is set by one of
    /// the runs or records.
    Set { parameter: String, by: String } = "plan::given_set",
        format!("`{parameter}` is to be estimated, but {by} sets it"),
        help format!(
            "one name has one value in all records and runs: rename the value that is set, or do \
             not estimate `{parameter}`"
        );
    /// A number of the study has no value.
    Numbers => EvalError;
    /// The result at a place cannot be measured.
    Place => NetworkFitError;
    /// The plan was interrupted.
    Interrupted = "run::interrupted", "the plan was interrupted", class Class::Interrupted;
}
}
