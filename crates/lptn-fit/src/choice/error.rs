//! Reasons why networks cannot be compared on their records.

use lptn_solve::SensitiveError;
use lptn_units::Class;

use crate::network::NetworkFitError;

lptn_units::errors! {
/// Reasons why networks cannot be compared on their records. If the records cannot distinguish
/// them, that is an answer and not an error.
#[derive(Debug)]
pub enum ChoiceError {
    /// There are fewer than two networks.
    Alone = "fit::one_candidate",
        "one candidate alone cannot be compared",
        help "name several netlists with a [fit.NAME], or one with several; `--set NAME=A,B` makes \
            a candidate of each value";
    /// Two networks are not fitted to the same records.
    Records { one: String, other: String, record: String } = "fit::other_records",
        format!("`{one}` is fitted to {record}, and `{other}` is not"),
        help "likelihoods of different records cannot be compared: name the same records in `data` \
            of each [fit.NAME]; their order does not matter";
    /// Two networks are not fitted to the same columns of a record, or to other values of them.
    Columns { one: String, other: String, record: String, column: String } = "fit::other_columns",
        format!("of {record} `{one}` reads column `{column}`, and `{other}` {}",
            "does not, or not the same values of it"),
        help "name the same columns in `column` of each [fit.NAME]; `outliers` and `time` change \
            values too";
    /// Two networks weight a column differently, with these standard deviations in its SI unit.
    Sigma { one: String, other: String, column: String, sigmas: [f64; 2], unit: String } = "fit::other_sigma",
        format!(
            "a value of column `{column}` counts as known to {} {unit} with `{one}` and to {} {unit} \
             with `{other}`", sigmas[0], sigmas[1]
        ),
        help "write the same `sigma` in each [fit.NAME], and the same `resolution` of its sensor";
    /// The last third of a single record has too few values.
    Nothing { record: String, values: usize } = "fit::nothing_unseen",
        format!("{record} is a single record, and its last third has {values} values: no part can \
            be held out of the fit and predicted"),
        help "name several records in `data`, or a longer one";
    /// The offset of a sensor is free in each record and has no prior.
    Offset { contender: String, sensor: String } = "fit::unseen_offset",
        format!("`{contender}` cannot predict a held-out record: the offset of sensor `{sensor}` \
            is `\"free\"` in each"),
        help "write its prior, such as \"0 ± 2 K\", or share it between the records";
    /// No fit has a minimum: the best network, and why its search ended.
    NotConverged { contender: String, why: String } = "fit::not_converged",
        format!("no candidate has a fit that converged: that of `{contender}` ended because {why}"),
        help "`lptn fit network` reports more; give the parameters start values nearer to the \
            expected ones, and bounds with `from` and `to`",
        class Class::Numbers;
    /// A network cannot be fitted to all records, or to all but one.
    Fit { contender: String, without: Option<String>, error: Box<NetworkFitError> } = error.code(),
        match without {
            Some(record) => format!("`{contender}` without {record}: {error}"),
            None => format!("`{contender}`: {error}"),
        },
        source error.as_ref(),
        class error.class();
    /// The run of a held-out record fails with the values fitted to the others.
    Unseen { contender: String, record: String, error: Box<SensitiveError> } = error.code(),
        format!("`{contender}` cannot predict {record}, which is held out: {error}"),
        source error.as_ref(),
        class match &**error {
            SensitiveError::Run(_) => Class::Numbers,
            _ => Class::Input,
        };
    /// The comparison was interrupted.
    Interrupted = "run::interrupted", "the comparison was interrupted", class Class::Interrupted;
}
}

impl ChoiceError {
    pub(crate) fn of_fit(contender: &str, without: Option<&str>, error: NetworkFitError) -> Self {
        match error {
            NetworkFitError::Interrupted { .. } => Self::Interrupted,
            error => Self::Fit {
                contender: contender.to_owned(),
                without: without.map(ToOwned::to_owned),
                error: Box::new(error),
            },
        }
    }

    /// The network that is at fault.
    pub fn contender(&self) -> Option<&str> {
        match self {
            Self::Alone | Self::Nothing { .. } | Self::Interrupted => None,
            Self::Records { other, .. }
            | Self::Columns { other, .. }
            | Self::Sigma { other, .. } => Some(other),
            Self::Offset { contender, .. }
            | Self::NotConverged { contender, .. }
            | Self::Fit { contender, .. }
            | Self::Unseen { contender, .. } => Some(contender),
        }
    }
}
