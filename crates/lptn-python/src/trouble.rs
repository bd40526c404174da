//! Refusals and failures as exceptions of Python.

use lptn::{Diagnostic, Exit, Failure, problems_as_json};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// A failure of lptn, or a mistake in the call.
#[derive(Debug)]
pub(crate) enum Trouble {
    /// Problems with code, place and help: `lptn.Error`.
    Failure(Box<Failure>),
    /// An argument that Python refuses itself, or Ctrl-C.
    Python(PyErr),
}

impl Trouble {
    /// An argument of a wrong type or name.
    pub(crate) fn of_type(message: String) -> Self {
        Self::Python(PyTypeError::new_err(message))
    }

    /// An argument with a wrong value.
    pub(crate) fn of_value(message: String) -> Self {
        Self::Python(PyValueError::new_err(message))
    }

    /// A fault of lptn itself.
    pub(crate) fn fault(what: &str) -> Self {
        let message =
            format!("lptn has stopped because of a fault in lptn, not in your input: {what}");
        Failure::new(Exit::Failed, Diagnostic::error("program::fault", message)).into()
    }
}

impl From<Failure> for Trouble {
    fn from(failure: Failure) -> Self {
        Self::Failure(Box::new(failure))
    }
}

impl From<PyErr> for Trouble {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<Trouble> for PyErr {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::Python(error) => error,
            Trouble::Failure(failure) => Python::attach(|py| raised(py, &failure, "[]")),
        }
    }
}

/// The exception of a failure, with the doubts that were known before it.
pub(crate) fn raised(py: Python<'_>, failure: &Failure, doubts: &str) -> PyErr {
    let errors = problems_as_json(&failure.files, &failure.diagnostics).to_string();
    let made = || {
        let class = py.import("lptn._messages")?.getattr("Error")?;
        class.call_method1("_of", (errors, failure.exit as u8, doubts))
    };
    made().map_or_else(|error| error, PyErr::from_value)
}
