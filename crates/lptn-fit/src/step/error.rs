//! Reasons why a record has no exponential.

use lptn_reduce::{FitError, ReduceError};
use lptn_units::Class;

/// Reasons why a record does not determine its time constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lack {
    /// `T_i`, `T_f` and `t_RC` have the same effect on it.
    Alike,
    /// The 95 % interval reaches to 0.
    Interval {
        /// Half its width in s.
        half_width: f64,
    },
    /// The slow residuals of the curve exceed its change: the record has another shape.
    Shape {
        /// Root mean square of the residuals, in means of twelfths of the record, in K.
        missed: f64,
        /// The same of the curve's distances from its mean, in K.
        changed: f64,
    },
    /// The curve has settled before the second sample.
    Spacing {
        /// From the first sample to the second, in s.
        spacing: f64,
    },
}

lptn_units::errors! {
/// Reasons why a column could not be fitted, or a fit not compared with a model.
#[derive(Debug)]
pub enum StepError {
    /// Times and values differ in number.
    Length { times: usize, values: usize } = "fit::not_a_record",
        format!("there are {times} times and {values} values");
    /// Too few samples, not a record, a constant column, or one without curvature.
    Fit(error: FitError) = error.code(), error, source error,
        help match error {
            FitError::NoCurvature { .. } => Some(LONGER.to_owned()),
            error => error.help(),
        }, class error.class();
    /// The record is constant at its least or greatest value in K, between these times in s, but
    /// changes elsewhere.
    Saturated { value: f64, from: f64, to: f64, samples: usize } = "fit::saturated",
        format!(
            "the record is constant at its extreme value from {from} s to {to} s ({samples} \
             samples) but changes elsewhere: the instrument was at the end of its range, or the \
             step began later"
        ),
        help format!("leave {from} s to {to} s out of the record");
    /// The record does not determine `T_i`, `T_f` and `t_RC`: the time constant in s at which it
    /// does not, and the reason.
    Undetermined { tau: f64, lack: Lack } = "fit::undetermined", lack.explain(*tau),
        help lack.help(), class Class::Numbers;
    /// The reference column has no samples.
    Reference = "fit::no_reference", "the reference column has no samples";
    /// The capacity in J/K or its deviation is not a positive number.
    Capacity(value: f64) = "fit::capacity",
        format!("the capacity has to be positive, got {value} J/K"),
        help "write for example --capacity \"2659 J/K ± 5 %\"";
    /// The model has no equivalent at the port, or its run failed.
    Model => ReduceError;
}
}

impl Lack {
    fn explain(self, tau: f64) -> String {
        match self {
            Self::Alike => {
                format!(
                    "T_i, T_f and t_RC cannot be distinguished at a time constant of {tau:.3e} \
                    s"
                )
            }
            Self::Interval { half_width } => format!(
                "the record does not determine t_RC: its 95 % interval is {tau:.3e} s ± \
                 {half_width:.3e} s, which contains 0"
            ),
            Self::Shape { missed, changed } => format!(
                "the record does not determine t_RC: one exponential has a slow misfit of \
                 {missed:.3e} K and changes by {changed:.3e} K"
            ),
            Self::Spacing { spacing } => format!(
                "the record does not determine t_RC: at {tau:.3e} s it is shorter than the \
                 distance of the samples, {spacing:.3e} s"
            ),
        }
    }

    fn help(self) -> &'static str {
        match self {
            Self::Spacing { .. } => "take samples more often, several in each time constant",
            Self::Interval { .. } | Self::Shape { .. } => {
                "is there a step in it? a step that begins at the first row and lasts, with less \
                 noise or for longer, determines t_RC"
            }
            Self::Alike => LONGER,
        }
    }
}

const LONGER: &str =
    "a longer record, until the temperature bends towards its end, distinguishes T_f from t_RC";
