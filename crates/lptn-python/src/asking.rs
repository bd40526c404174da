//! One way from Python to every question.

use std::path::PathBuf;

use lptn::{Failure, Loaded};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::Answer;
use crate::declaration::{About, Declaration};
use crate::memory::Files;
use crate::subject::Asked;
use crate::trouble::{Trouble, raised};
use crate::verbs::{VERBS, Verb, named};
use crate::watching::{Hearing, soon};
use crate::words::Words;

/// Asks a question of this name, and gives its answer.
///
/// # Errors
/// `lptn.Error` with all problems; `TypeError` and `ValueError` for arguments.
pub(crate) fn answered(
    py: Python<'_>,
    verb: &'static Verb,
    (net, files, memory): (Option<&Loaded>, Vec<PathBuf>, Files),
    given: &Bound<'_, PyDict>,
) -> PyResult<Answer> {
    let is_parameter = |name: &str| net.is_some_and(|net| is_parameter(net, name));
    let told = given.get_item("progress")?.filter(|told| !told.is_none());
    let words = Words::sorted(&verb.declared, given, &is_parameter)?;
    let hearing = Hearing::telling(told.map(Bound::unbind));
    let asked = Asked { net, files, memory, listener: &hearing };
    let work = || (verb.ask)(&asked, &words);
    let is_soon = verb.declared.name == "steady" && !words.flag("periodic");
    let outcome = if is_soon { soon(py, work) } else { hearing.watch(py, work) };
    outcome.map(Answer::of).map_err(|trouble| raised_by(py, trouble, &hearing))
}

/// The exception of a trouble, with the doubts that were heard before it.
pub(crate) fn raised_by(py: Python<'_>, trouble: Trouble, hearing: &Hearing) -> PyErr {
    match trouble {
        Trouble::Failure(failure) => raised(py, &failure, &hearing.doubts()),
        Trouble::Python(error) => error,
    }
}

fn is_parameter(net: &Loaded, name: &str) -> bool {
    net.usual().netlist.network.parameter(name).is_ok()
}

/// Asks a question that is not about a network: of netlists, of a record, of numbers. Records may
/// be in memory.
#[pyfunction]
pub(crate) fn ask(
    py: Python<'_>,
    name: &str,
    files: Vec<PathBuf>,
    words: &Bound<'_, PyDict>,
    memory: Files,
) -> PyResult<Answer> {
    let verb = named(name, |about| about != About::Network)?;
    answered(py, verb, (None, files, memory), words)
}

/// An option in Python: name, type, meaning.
type Option3 = (&'static str, &'static str, &'static str);

/// A question in Python: name, subject, purpose, first option, parameters or not, options.
type Question =
    (&'static str, &'static str, &'static str, Option<&'static str>, bool, Vec<Option3>);

/// The declarations of all questions.
#[pyfunction]
pub(crate) fn questions() -> Vec<Question> {
    let one = |verb: &'static Verb| {
        let Declaration { name, purpose, about, first, sets, options } = verb.declared;
        let about = match about {
            About::Network => "network",
            About::Netlists => "netlists",
            About::Nothing => "nothing",
        };
        let options = options.iter();
        let options = options.map(|option| (option.name, option.kind.python(), option.means));
        (name, about, purpose, first, sets, options.collect())
    };
    VERBS.iter().map(one).collect()
}

/// A failure of the netlist.
pub(crate) fn failed(failure: Failure) -> PyErr {
    Trouble::from(failure).into()
}
