//! Why a parameter cannot be sized.

use lptn_assembly::AssemblyError;
use lptn_network::{BuildErrors, Changing};
use lptn_solve::SteadyError;
use lptn_units::{Class, EvalError};

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
    /// What is required depends on inputs that change with time: there is no one steady state to
    /// judge. At least one.
    Changing(inputs: Vec<Changing>) = "size::inputs_change",
        "what is required depends on inputs that change with time, and a steady state knows only \
         one moment of them";
    /// The network does not exist for a value inside the range.
    Network { value: f64, errors: BuildErrors } = "size::network",
        format!("there is no network at {value}: {errors}"),
        source errors, help LEAVE_OUT;
    /// The network cannot be assembled.
    Assembly => AssemblyError;
    /// The network has no steady state for a value inside the range.
    Steady { value: f64, error: SteadyError } = error.code(),
        format!("there is no steady state at {value}: {error}"),
        source error,
        help match error {
            SteadyError::BelowAbsoluteZero { .. } | SteadyError::Cycles { .. } => {
                Some(LEAVE_OUT.to_owned())
            }
            error => error.help(),
        }, class match error.class() {
            Class::No => Class::Input,
            class => class,
        };
    /// A requirement, as it was written, has no value; why not, or `None` if it gave no finite
    /// number.
    Requirement { text: String, error: Option<EvalError> } = "size::requirement",
        match error {
            Some(error) => format!("`{text}` has no value: {error}"),
            None => format!("`{text}` has no finite value"),
        };
}
}
