//! Why a network cannot be fitted.

use std::fmt;

use lptn_units::EvalError;

use crate::SensitiveError;
use crate::fit::least_squares::LeastSquaresError;
use crate::fit::network::task::FitStage;

/// Why a network cannot be fitted. That the search does not converge is an answer and no error.
#[derive(Debug)]
pub enum NetworkFitError {
    /// Nothing is varied.
    NoParameter,
    /// The records hold no value.
    NoData,
    /// A record begins before its run, or has no row behind the start.
    Times {
        /// The name of the record.
        record: String,
        /// The first and the last time in s.
        span: (f64, f64),
        /// Start of the run in s.
        start: f64,
    },
    /// There are fewer values and priors than parameters.
    TooFew {
        /// Values and priors.
        values: usize,
        /// Varied parameters.
        parameters: usize,
    },
    /// The own value of a parameter is outside its bounds.
    StartOutside {
        /// Place among the varied parameters.
        parameter: usize,
    },
    /// The run of a record fails with the own values of the parameters.
    Start {
        /// The name of the record.
        record: String,
        /// Why.
        error: Box<SensitiveError>,
    },
    /// A column measures something that is neither the temperature of a node nor a mean of some.
    Observed {
        /// The column.
        column: String,
        /// The result it measures, as it is written.
        result: String,
    },
    /// A number of the study has no value.
    Plan(EvalError),
    /// The sum of squares cannot be minimised.
    Search(LeastSquaresError<Interrupted>),
    /// It was interrupted.
    Interrupted {
        /// How far it was.
        stage: FitStage,
        /// The values in SI units that describe the records best among those that were tried.
        best: Option<Vec<f64>>,
    },
}

/// That a search was interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the search was interrupted")
    }
}

impl NetworkFitError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoParameter => "fit::no_parameter",
            Self::NoData => "fit::no_data",
            Self::Times { .. } => "fit::record_times",
            Self::TooFew { .. } => "fit::too_few_values",
            Self::StartOutside { .. } => "fit::start_outside",
            Self::Start { error, .. } => match &**error {
                SensitiveError::Run(error) => error.code(),
                SensitiveError::Build(_) => "fit::network",
                SensitiveError::Assembly(error) => error.code(),
                SensitiveError::Interrupted => "fit::interrupted",
            },
            Self::Interrupted { .. } => "fit::interrupted",
            Self::Observed { .. } => "fit::observed",
            Self::Plan(error) => error.code(),
            Self::Search(error) => error.code().unwrap_or("fit::search"),
        }
    }
}

impl fmt::Display for NetworkFitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoParameter => f.write_str("nothing is varied, so nothing can be fitted"),
            Self::NoData => f.write_str("the records hold no value of a column that is fitted"),
            Self::Times { record, span: (first, last), start } => write!(
                f,
                "{record}: rows from {first} s to {last} s do not fit a run that starts at {start} s"
            ),
            Self::TooFew { values, parameters } => {
                write!(f, "{values} values cannot determine {parameters} parameters")
            }
            Self::StartOutside { parameter } => {
                write!(f, "the own value of varied parameter {parameter} is outside its bounds")
            }
            Self::Start { record, error } => {
                write!(f, "{record}: there is no run with the parameters' own values: {error}")
            }
            Self::Observed { column, result } => write!(
                f,
                "column `{column}` measures `{result}`, which is not a temperature of a node or a mean of some"
            ),
            Self::Plan(error) => error.fmt(f),
            Self::Search(error) => error.fmt(f),
            Self::Interrupted { stage, .. } => write!(f, "the fit was interrupted in {stage}"),
        }
    }
}

impl std::error::Error for NetworkFitError {}
