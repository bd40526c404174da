//! The program `lptn` in the module, so that a wheel has one copy of everything.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Does what a command line says, the name of the program first, and gives its exit code. Python's
/// own handler of Ctrl-C has to be gone; a process calls it once.
#[pyfunction]
pub(crate) fn program(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| lptn_cli::run(words))
}
