//! Why a parameter cannot be sized.

use std::sync::Arc;

use lptn_analysis::{AnalysisError, RunError};
use lptn_assembly::AssemblyError;
use lptn_netlist::Diagnostic;
use lptn_network::{BuildErrors, Changing, ParameterId};
use lptn_solve::{PeriodicError, SteadyError, TransientError, Unsolved};
use lptn_units::{Class, EvalError, format_six};

const LEAVE_OUT: &str = "`vary` has to leave this value out: let its range begin or end elsewhere";

lptn_units::errors! {
/// Why a parameter cannot be sized. That no value keeps the requirements is an answer and not an
/// error. Values are in SI units.
#[derive(Clone, Debug)]
pub enum SizeError {
    /// The range does not begin before it ends, or an end is not finite.
    Range { from: f64, to: f64 } = "size::range",
        format!("the range has to begin before it ends, got {from} to {to}");
    /// Nothing is required.
    NoRequirement = "size::no_requirement", "nothing is required, so nothing can be sized";
    /// A probability is requested, and no parameter has a `±`.
    NoDeviation = "size::no_deviation",
        "`probability` counts the `±` of parameters, and none has any",
        help "give a parameter its uncertainty: `P = \"100 ± 5 W\"`, or with `--set`";
    /// The requirements depend on inputs that change with time (at least one), so there is no
    /// single steady state to judge.
    Changing(inputs: Vec<Changing>) = "size::inputs_change",
        "the requirements depend on inputs that change with time, but a steady state is one moment \
         of them";
    /// The catalogues have more combinations than can be judged.
    TooMany { most: usize } = "size::too_many",
        format!("the catalogues have more than {most} combinations"),
        help "choose from one catalogue first, or shorten them";
    /// A design cannot be judged: its values, and the load case, with an empty name if there is
    /// none.
    Trial { values: Vec<f64>, case: String, error: Box<TrialError> } = error.code(),
        format!("{}: {error}", place(values, case)),
        source error.as_ref(), help error.help(), class error.class();
}
}

impl SizeError {
    pub(crate) fn trial(design: &[(ParameterId, f64)], case: &str, error: TrialError) -> Self {
        let values = design.iter().map(|(_, value)| *value).collect();
        Self::Trial { values, case: case.to_owned(), error: Box::new(error) }
    }

    /// True if no steady state was found, which is not an answer about the network.
    pub(crate) fn is_not_found(&self) -> bool {
        let Self::Trial { error, .. } = self else { return false };
        matches!(
            error.as_ref(),
            TrialError::Steady(SteadyError::Unsolved(
                Unsolved::NotFound { .. } | Unsolved::Undetermined { .. }
            ))
        )
    }
}

fn place(values: &[f64], case: &str) -> String {
    let values: Vec<String> = values.iter().map(|value| format_six(*value)).collect();
    let of_case = if case.is_empty() { String::new() } else { format!(" in case `{case}`") };
    format!("at {}{of_case}", values.join(", "))
}

lptn_units::errors! {
/// Why a design cannot be judged.
#[derive(Clone, Debug)]
pub enum TrialError {
    /// The network does not exist for values inside the ranges.
    Network(errors: BuildErrors) = "size::network", format!("there is no network: {errors}"),
        source errors, help LEAVE_OUT;
    /// The gears do not mesh.
    Gears(problem: Box<Diagnostic>) = problem.code, problem.message.clone(),
        help problem.help.clone();
    /// The network cannot be assembled.
    Assembly => AssemblyError;
    /// The network has no steady state.
    Steady(error: SteadyError) = error.code(), format!("there is no steady state: {error}"),
        source error,
        help match error {
            SteadyError::BelowAbsoluteZero { .. } | SteadyError::Cycles { .. } => {
                Some(LEAVE_OUT.to_owned())
            }
            error => error.help(),
        }, class not_an_answer(error.class());
    /// The run does not exist for these values.
    Settings(says: String) = "size::run", format!("there is no run: {says}"), help LEAVE_OUT;
    /// Its run failed.
    Run(error: Arc<TransientError>) = error.code(), format!("the run failed: {error}"),
        source error.as_ref(), help error.help(), class not_an_answer(error.class());
    /// It has no periodic steady state.
    Periodic(error: Arc<PeriodicError>) = error.code(),
        format!("there is no periodic steady state: {error}"),
        source error.as_ref(), help error.help(), class not_an_answer(error.class());
    /// A requirement, as it was written, has no value; why not, or `None` if it gave no finite
    /// number.
    Requirement { text: String, error: Option<EvalError> } = "size::requirement",
        match error {
            Some(error) => format!("`{text}` has no value: {error}"),
            None => format!("`{text}` has no finite value"),
        };
    /// The objective has no value; why not, or `None` if it gave no finite number.
    Objective(error: Option<EvalError>) = "size::objective",
        match error {
            Some(error) => format!("the objective has no value: {error}"),
            None => "the objective has no finite value".to_owned(),
        };
    /// It was interrupted.
    Interrupted = "run::interrupted", "interrupted before there was an answer",
        class Class::Interrupted;
}
}

impl From<AnalysisError> for TrialError {
    fn from(error: AnalysisError) -> Self {
        match error {
            AnalysisError::Steady(error) => Self::Steady(error),
            AnalysisError::Run(RunError::Failed(error)) => Self::Run(Arc::from(error)),
            AnalysisError::Run(RunError::Interrupted { .. }) => Self::Interrupted,
            AnalysisError::Cycle(error) => Self::Periodic(Arc::from(error)),
        }
    }
}

/// A network without an answer is an error of the input here.
fn not_an_answer(class: Class) -> Class {
    match class {
        Class::No => Class::Input,
        class => class,
    }
}
