//! The Python package `lptn`.
//!
//! Python calls one function for every question of the command line: [`asking::ask`]. It finds the
//! declaration of the question ([`verbs`]), sorts keyword arguments into options and parameters
//! ([`words`]), and computes without Python's lock. The answer keeps everything; Python asks it for
//! JSON, columns and pictures when it needs them. Classes for users are in `python/lptn`. The
//! program of the wheel is one call ([`program`]).

mod answer;
mod asking;
mod declaration;
mod gradient;
mod memory;
mod netlist;
mod program;
mod questions;
mod sections;
mod simulation;
mod subject;
mod trouble;
mod verbs;
mod watching;
mod words;

/// The part of the package that is compiled.
#[pyo3::pymodule(name = "_lptn")]
mod module {
    #[pymodule_export]
    use super::answer::Answer;
    #[pymodule_export]
    use super::asking::{ask, questions};
    #[pymodule_export]
    use super::gradient::Gradient;
    #[pymodule_export]
    use super::memory::csv;
    #[pymodule_export]
    use super::netlist::{Netlist, quantity_text, unit};
    #[pymodule_export]
    use super::program::program;
    #[pymodule_export]
    use super::sections::sections;
    #[pymodule_export]
    use super::simulation::Simulation;

    /// The version of lptn.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name of it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
