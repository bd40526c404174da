//! Why a simulation does not go on.

use lptn_assembly::{AssemblyError, ChangeError};
use lptn_network::{BuildErrors, NoTangents, UnknownName};
use lptn_solve::{RateSlopesError, Unsolved};

use crate::error::RunError;

lptn_units::errors! {
/// Why a simulation cannot be begun, changed or stepped. It stays as it was.
#[derive(Debug)]
pub enum SimulationError {
    /// The network cannot be assembled.
    Assembly => AssemblyError;
    /// Nothing has this name.
    Unknown => UnknownName;
    /// This is neither a parameter nor a signal.
    NotAnInput(name: String) = "simulation::not_an_input",
        format!("`{name}` is neither a parameter nor a signal"),
        help "write the value as a parameter of [param] and use its name";
    /// A derivative is asked for twice by this input.
    Twice { name: String } = "simulation::twice",
        format!("`{name}` occurs twice among the inputs of a derivative"),
        help "name it once";
    /// The network refuses the value.
    Refused => BuildErrors;
    /// The value changes the enthalpy of this node, whose state it is.
    Melts { node: String } = "simulation::melts",
        format!("the enthalpy of `{node}` is its state, and the value would change it"),
        help "set the value before the first step";
    /// The saved state is of another network.
    Foreign = "simulation::foreign", "the saved state is of another network";
    /// A step failed.
    Run => RunError;
    /// The rates have no value.
    Rates => Unsolved;
    /// The rates have no derivatives by one of the parameters.
    Tangents => NoTangents;
}
}

impl From<RateSlopesError> for SimulationError {
    fn from(error: RateSlopesError) -> Self {
        match error {
            RateSlopesError::Unsolved(error) => Self::Rates(error),
            RateSlopesError::Tangents(error) => Self::Tangents(error),
            RateSlopesError::Melts { node } => Self::Melts { node },
        }
    }
}

impl From<ChangeError> for SimulationError {
    fn from(error: ChangeError) -> Self {
        match error {
            ChangeError::Network(errors) => Self::Refused(errors),
            ChangeError::Assembly(error) => Self::Assembly(error),
        }
    }
}
