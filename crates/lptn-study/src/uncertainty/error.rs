//! Why the uncertainty of a run cannot be computed.

use lptn_analysis::RunError;
use lptn_assembly::{AssemblyError, ChangeError};
use lptn_network::{BuildErrors, InputError};
use lptn_solve::{MarginError, SensitiveError, TransientError};
use lptn_units::Class;

use crate::uncertainty::lost::Lost;
use crate::uncertainty::points::{LEAST, MOST_DIMENSIONS, MOST_POINTS};

lptn_units::errors! {
/// Why the uncertainty of a run cannot be computed.
#[derive(Debug)]
pub enum UncertaintyError {
    /// No parameter carries `±`.
    NoDeviation = "uncertainty::no_deviation", "no parameter has a `±`, so nothing is uncertain",
        help "give a parameter its standard deviation: `R_skin = \"0.365 K/W ± 20 %\"` in [param]";
    /// The correlations of the parameters contradict each other.
    NotDefinite { parameter: String } = "uncertainty::not_definite",
        format!("correlations that cannot be: those of `{parameter}` with the parameters before it"),
        help "two values that follow a third one closely follow each other too: the matrix of all \
            correlations has to be positive definite";
    /// More parameters carry `±` than sampling has directions for.
    TooManyParameters(count: usize) = "uncertainty::too_many_parameters",
        format!("{count} parameters have a `±`, sampling goes up to {}", MOST_DIMENSIONS / 2),
        help "use `--uncertainty linear`";
    /// More samples, or fewer, than can be taken.
    Samples(samples: usize) = "uncertainty::samples",
        format!("the number of samples must be {LEAST} to {MOST_POINTS}, got {samples}"),
        help "write for example `--samples 512`";
    /// The temperatures of all samples at all rows do not fit into the memory that is allowed, in
    /// bytes.
    TooLarge(bytes: usize) = "uncertainty::too_large",
        format!("the temperatures of all samples at all rows need {} MB", bytes / 1_000_000),
        help "write fewer rows or samples, or fewer columns with `--select 'steel.T'`";
    /// Too few samples have a result; why the others have none.
    TooFew(lost: Vec<Lost>) = "uncertainty::too_few",
        lost.iter().fold("too few samples have a result".to_owned(), |text, lost| {
            format!("{text}; {lost}")
        }),
        help "make the `±` smaller: most values that it allows do not give a network that runs",
        class Class::Numbers;
    /// There is no network for values close to the parameters' values.
    Network(errors: BuildErrors) = "uncertainty::network",
        format!("there is no network next to the values: {errors}"), source errors,
        class Class::Numbers;
    /// The network itself cannot be assembled.
    Assembly => AssemblyError as Class::of_numbers;
    /// The run itself, with every parameter at its value, fails.
    Run => Box<TransientError> as Class::of_numbers;
    /// A limit has no value next to the run.
    Limit => InputError as Class::of_numbers;
    /// It was interrupted.
    Interrupted = "uncertainty::interrupted", "the sampling was interrupted",
        class Class::Interrupted;
}
}

impl From<RunError> for UncertaintyError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Failed(error) => Self::Run(error),
            RunError::Interrupted { .. } => Self::Interrupted,
        }
    }
}

impl From<ChangeError> for UncertaintyError {
    fn from(error: ChangeError) -> Self {
        match error {
            ChangeError::Network(errors) => Self::Network(errors),
            ChangeError::Assembly(error) => Self::Assembly(error),
        }
    }
}

impl From<MarginError> for UncertaintyError {
    fn from(error: MarginError) -> Self {
        match error {
            MarginError::Change(error) => error.into(),
            MarginError::Input(error) => error.into(),
        }
    }
}

impl From<SensitiveError> for UncertaintyError {
    fn from(error: SensitiveError) -> Self {
        match error {
            SensitiveError::Run(error) => Self::Run(Box::new(error)),
            SensitiveError::Change(error) => error.into(),
            SensitiveError::Interrupted => Self::Interrupted,
        }
    }
}
