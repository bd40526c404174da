//! Why a record has no exponential.

use std::fmt;

use lptn_reduce::{FitError, ReduceError};

/// Why a record does not tell its time constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lack {
    /// `T_i`, `T_f` and `t_RC` have the same effect on it.
    Alike,
    /// The 95 % interval reaches to 0.
    Interval {
        /// Half its width in s.
        half_width: f64,
    },
    /// What the curve misses slowly is more than what it changes: the record has another shape.
    Shape {
        /// Root of the mean square of what it misses, in means of twelfths of the record, in K.
        missed: f64,
        /// The same of what the curve departs from its mean, in K.
        changed: f64,
    },
    /// The curve has settled before the second sample.
    Spacing {
        /// From the first sample to the second, in s.
        spacing: f64,
    },
}

/// Why a column could not be fitted, or a fit not compared with a model.
#[derive(Debug)]
pub enum StepError {
    /// Times and values are not as many.
    Length {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Too few samples, no record, a constant column, or one without curvature.
    Fit(FitError),
    /// The record stands still at its least or greatest value while it changes beside.
    Saturated {
        /// That value, in K.
        value: f64,
        /// From this time of the record in s ..
        from: f64,
        /// .. to this one.
        to: f64,
        /// Number of samples.
        samples: usize,
    },
    /// The record does not tell `T_i`, `T_f` and `t_RC`.
    Undetermined {
        /// The time constant in s at which it does not.
        tau: f64,
        /// What is missing.
        lack: Lack,
    },
    /// The reference column has no samples.
    Reference,
    /// The capacity or its deviation is no positive number.
    Capacity(f64),
    /// The model has no equivalent at the port, or its run failed.
    Model(ReduceError),
}

impl StepError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Length { .. } => "fit::not_a_record",
            Self::Fit(error) => error.code(),
            Self::Saturated { .. } => "fit::saturated",
            Self::Undetermined { .. } => "fit::undetermined",
            Self::Reference => "fit::no_reference",
            Self::Capacity(_) => "fit::capacity",
            Self::Model(error) => error.code(),
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Undetermined { lack: Lack::Spacing { .. }, .. } => {
                Some("take samples more often, several in each time constant".into())
            }
            Self::Undetermined { lack: Lack::Interval { .. } | Lack::Shape { .. }, .. } => Some(
                "is there a step in it? one that begins at the first row and lasts, with less noise or for longer, \
                 tells t_RC"
                    .into(),
            ),
            Self::Fit(FitError::NoCurvature { .. }) | Self::Undetermined { .. } => Some(
                "a longer record, until the temperature bends towards its end, tells T_f and t_RC apart"
                    .into(),
            ),
            Self::Saturated { from, to, .. } => Some(format!("leave {from} s to {to} s out of the record")),
            Self::Capacity(_) => Some("write for example --capacity \"2659 J/K ± 5 %\"".into()),
            Self::Model(error) => error.help(),
            _ => None,
        }
    }
}

impl Lack {
    fn explain(self, tau: f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Alike => {
                write!(f, "T_i, T_f and t_RC cannot be told apart at a time constant of {tau:.3e} s")
            }
            Self::Interval { half_width } => write!(
                f,
                "the record does not tell t_RC: its 95 % interval is {tau:.3e} s ± {half_width:.3e} s, which holds 0"
            ),
            Self::Shape { missed, changed } => write!(
                f,
                "the record does not tell t_RC: one exponential misses {missed:.3e} K of it slowly and changes by \
                 {changed:.3e} K itself"
            ),
            Self::Spacing { spacing } => write!(
                f,
                "the record does not tell t_RC: at {tau:.3e} s it is shorter than the distance of the samples, \
                 {spacing:.3e} s"
            ),
        }
    }
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { times, values } => write!(f, "there are {times} times and {values} values"),
            Self::Fit(error) => error.fmt(f),
            Self::Saturated { from, to, samples, .. } => write!(
                f,
                "the record stands still at its extreme value from {from} s to {to} s ({samples} samples) while it \
                 changes beside: the instrument was at the end of its range, or the step began later"
            ),
            Self::Undetermined { tau, lack } => lack.explain(*tau, f),
            Self::Reference => f.write_str("the reference column has no samples"),
            Self::Capacity(value) => write!(f, "the capacity has to be positive, got {value} J/K"),
            Self::Model(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StepError {}
