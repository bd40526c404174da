//! One error for programs that use the library.

use std::fmt;

use lptn_units::{Class, Problem};

/// Any error of a call of this library: `?` makes one of every error, so that `main` can return
/// `Result<(), Error>`. Its sentence, [`Problem::code`] and [`Problem::help`] are those of the
/// error; [`Error::downcast_ref`] gives the error itself.
///
/// ```
/// fn main() -> Result<(), lptn::Error> {
///     let refused = lptn::parse("heater", "format = 1\n[node]\n");
///     let error = lptn::Error::from(refused.unwrap_err());
///     assert!(error.downcast_ref::<lptn::Rejected>().is_some());
///     Ok(())
/// }
/// ```
pub struct Error(Box<dyn Problem + Send + Sync>);

impl Error {
    /// The error that it was made of, if that is an `E`.
    pub fn downcast_ref<E: std::error::Error + 'static>(&self) -> Option<&E> {
        let problem: &(dyn std::error::Error + 'static) = &*self.0;
        problem.downcast_ref()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The error as `main` prints it: its sentence, its code and its help.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self} [{}]", self.code())?;
        self.help().map_or(Ok(()), |help| write!(f, "\n  help: {help}"))
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.source()
    }
}

impl Problem for Error {
    fn code(&self) -> &'static str {
        self.0.code()
    }

    fn help(&self) -> Option<String> {
        self.0.help()
    }

    fn class(&self) -> Class {
        self.0.class()
    }
}

macro_rules! made_of {
    ($($error:ty),*) => {$(
        impl From<$error> for Error {
            fn from(error: $error) -> Self {
                Self(Box::new(error))
            }
        }
    )*};
}

made_of! {
    lptn_analysis::AnalysisError, lptn_analysis::CycleError, lptn_analysis::RunError,
    lptn_analysis::SimulationError, lptn_answer::failure::Failure,
    lptn_assembly::AssemblyError, lptn_assembly::ChangeError,
    lptn_fit::choice::ChoiceError, lptn_fit::infer::InferError, lptn_fit::law::LawError, lptn_fit::law::RunsError, lptn_fit::least_squares::LeastSquaresError,
    lptn_fit::network::design::DesignError, lptn_fit::network::NetworkFitError, lptn_fit::step::StepError, lptn_fit::step::TermsError,
    lptn_netlist::ReadError, lptn_netlist::Rejected, lptn_netlist::WrittenError,
    lptn_network::BuildError, lptn_network::BuildErrors, lptn_network::InputError,
    lptn_network::LadderError, lptn_network::NoTangents, lptn_network::ParameterError, lptn_network::UnknownName,
    lptn_graph::NoSankey, lptn_graph::NoSlice, lptn_graph::TooMany, lptn_plot::PngError,
    lptn_reduce::FitError, lptn_reduce::ReduceError,
    lptn_solve::AdjointError, lptn_solve::BackwardError, lptn_solve::BentMargin, lptn_solve::DirectionError, lptn_solve::ExactError, lptn_solve::LedgerError,
    lptn_solve::LinearisedError, lptn_solve::ModesError,
    lptn_solve::MarginError, lptn_solve::NearError, lptn_solve::NoTrajectory, lptn_solve::ParameterSlopes,
    lptn_solve::PeriodicError, lptn_solve::RateSlopesError, lptn_solve::ResponseError, lptn_solve::SensitiveError,
    lptn_solve::SettingsError, lptn_solve::SlopesError, lptn_solve::SolutionError, lptn_solve::SteadyError,
    lptn_solve::TransientError, lptn_solve::Unsolved,
    lptn_study::CompareError, lptn_study::CoolingError, lptn_study::GearError, lptn_study::GradientError, lptn_study::RankError,
    lptn_study::SizeError, lptn_study::TrialError,
    lptn_study::sweep::SweepError, lptn_study::uncertainty::UncertaintyError,
    lptn_units::EvalError, lptn_units::Problems<lptn_units::UnitError>, lptn_units::TableError,
    lptn_units::UnitError,
    std::io::Error
}
