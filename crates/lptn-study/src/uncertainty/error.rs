//! Why the uncertainty of a run cannot be had.

use std::fmt;

use lptn_assembly::AssemblyError;
use lptn_network::{BuildErrors, InputError};
use lptn_solve::TransientError;

use crate::uncertainty::points::{MOST_DIMENSIONS, MOST_POINTS};
use crate::uncertainty::result::Lost;

/// Why the uncertainty of a run cannot be had.
#[derive(Debug)]
pub enum UncertaintyError {
    /// No parameter carries `±`.
    NoDeviation,
    /// More parameters carry `±` than sampling has directions for.
    TooManyParameters(usize),
    /// More samples, or fewer, than can be taken.
    Samples(usize),
    /// The temperatures of all samples at all rows do not fit into the memory that is allowed, in bytes.
    TooLarge(usize),
    /// So few samples have a result that nothing can be said; why the others have none.
    TooFew(Vec<Lost>),
    /// There is no network a little beside the parameters' values.
    Network(BuildErrors),
    /// The network itself cannot be assembled.
    Assembly(AssemblyError),
    /// The run itself, with every parameter at its value, fails.
    Run(Box<TransientError>),
    /// A limit has no value beside the run.
    Limit(InputError),
    /// It was interrupted.
    Interrupted,
}

impl UncertaintyError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoDeviation => "uncertainty::no_deviation",
            Self::TooManyParameters(_) => "uncertainty::too_many_parameters",
            Self::Samples(_) => "uncertainty::samples",
            Self::TooLarge(_) => "uncertainty::too_large",
            Self::TooFew(_) => "uncertainty::too_few",
            Self::Network(_) => "uncertainty::network",
            Self::Assembly(error) => error.code(),
            Self::Run(error) => error.code(),
            Self::Limit(_) => "solve::input",
            Self::Interrupted => "uncertainty::interrupted",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NoDeviation => Some(
                "give a parameter its standard deviation: `R_skin = \"0.365 K/W ± 20 %\"` in [param]".into(),
            ),
            Self::TooManyParameters(_) => Some("use `--uncertainty linear`".into()),
            Self::Samples(_) => Some("write for example `--samples 512`".into()),
            Self::TooLarge(_) => {
                Some("write fewer rows or samples, or fewer columns with `--select 'steel.T'`".into())
            }
            Self::TooFew(_) => {
                Some("make the `±` smaller: most of what it allows is no network that runs".into())
            }
            Self::Network(_) | Self::Assembly(_) | Self::Limit(_) | Self::Interrupted => None,
            Self::Run(error) => error.help(),
        }
    }
}

impl fmt::Display for UncertaintyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDeviation => f.write_str("no parameter has a `±`, so nothing is uncertain"),
            Self::TooManyParameters(count) => {
                let most = MOST_DIMENSIONS / 2;
                write!(f, "{count} parameters have a `±`, sampling goes up to {most}")
            }
            Self::Samples(samples) => {
                let least = super::sobol::LEAST;
                write!(f, "the number of samples must be {least} to {MOST_POINTS}, got {samples}")
            }
            Self::TooLarge(bytes) => {
                write!(f, "the temperatures of all samples at all rows need {} MB", bytes / 1_000_000)
            }
            Self::TooFew(lost) => {
                f.write_str("too few samples have a result")?;
                lost.iter().try_for_each(|lost| write!(f, "; {lost}"))
            }
            Self::Network(errors) => write!(f, "there is no network beside the values: {errors}"),
            Self::Assembly(error) => error.fmt(f),
            Self::Run(error) => error.fmt(f),
            Self::Limit(error) => error.fmt(f),
            Self::Interrupted => f.write_str("the sampling was interrupted"),
        }
    }
}

impl std::error::Error for UncertaintyError {}
