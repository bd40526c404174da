//! Why a measurement cannot be planned.

use lptn_solve::SensitiveError;
use lptn_units::{Class, EvalError};

use crate::network::error::NetworkFitError;

lptn_units::errors! {
/// Why a measurement cannot be planned. That nothing reaches what shall be known is an answer and
/// not an error.
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
    /// The records of a fit that are there already cannot be fitted.
    Given { fit: String, error: Box<NetworkFitError> } = error.code(),
        format!("fit `{fit}`: {error}"),
        source error.as_ref(),
        class error.class();
    /// They can, but no minimum is found.
    NotConverged { fit: String } = "plan::given",
        format!("fit `{fit}`, whose records exist already, does not converge"),
        help format!("`lptn fit network` reports more; without it, leave `{fit}` out of `given`");
    /// What is sought, by the plan or by a fit whose records are there already, is set by one of the
    /// runs or records.
    Set { parameter: String, by: String } = "plan::given_set",
        format!("`{parameter}` is to be estimated, but {by} sets it"),
        help format!(
            "one name has one value in all records and runs: rename the value that is set, or do \
             not estimate `{parameter}`"
        );
    /// A number of the study has no value.
    Numbers => EvalError;
    /// What is measured at a place cannot be.
    Place => NetworkFitError;
    /// It was interrupted.
    Interrupted = "run::interrupted", "the plan was interrupted", class Class::Interrupted;
}
}
