//! One way from Python to every question.

use std::path::PathBuf;
use std::sync::Arc;

use lptn::{Belief, Failure, Input, Listener, Loaded};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::Answer;
use crate::trouble::{Trouble, raised};
use crate::verbs::{About, Found, VERBS, Verb};
use crate::watching::{Hearing, soon};
use crate::words::Words;

/// The subject of a question.
pub(crate) struct Asked<'a> {
    /// The network, if it is about one.
    pub(crate) net: Option<&'a Loaded>,
    /// The netlists that it reads itself.
    pub(crate) files: Vec<PathBuf>,
    /// Hears doubts; says if Ctrl-C was pressed.
    pub(crate) listener: &'a dyn Listener,
}

impl Asked<'_> {
    /// The network with the load case, the fit and the parameters of the words.
    pub(crate) fn input(&self, words: &Words) -> Result<Arc<Input>, Trouble> {
        let posterior = words.text("posterior").map(PathBuf::from);
        self.input_with(&Belief::of(posterior.as_deref()), words)
    }

    /// The same with the values of this fit.
    pub(crate) fn input_with(
        &self,
        belief: &Belief<'_>,
        words: &Words,
    ) -> Result<Arc<Input>, Trouble> {
        let missing = || Trouble::of_type("this question needs a network".to_owned());
        let net = self.net.ok_or_else(missing)?;
        let case = words.text("case");
        Ok(net.input(belief, (case.as_deref(), &words.set))?)
    }

    /// All parameters: those of the network, then those of the words.
    pub(crate) fn set(&self, words: &Words) -> Vec<String> {
        let of_net = self.net.map_or(&[][..], Loaded::set);
        [of_net, &words.set].concat()
    }
}

/// Asks a question of this name, and gives its answer.
///
/// # Errors
/// `lptn.Error` with all problems; `TypeError` and `ValueError` for arguments.
pub(crate) fn answered(
    py: Python<'_>,
    verb: &'static Verb,
    (net, files): (Option<&Loaded>, Vec<PathBuf>),
    given: &Bound<'_, PyDict>,
) -> PyResult<Answer> {
    let is_parameter = |name: &str| net.is_some_and(|net| is_parameter(net, name));
    let words = Words::sorted(verb, given, &is_parameter)?;
    let hearing = Hearing::default();
    let asked = Asked { net, files, listener: &hearing };
    let work = || (verb.ask)(&asked, &words);
    let is_soon = verb.name == "steady" && !words.flag("periodic");
    let outcome = if is_soon { soon(py, work) } else { hearing.watch(py, work) };
    outcome.map(Answer::of).map_err(|trouble| told(py, trouble, &hearing))
}

fn told(py: Python<'_>, trouble: Trouble, hearing: &Hearing) -> PyErr {
    match trouble {
        Trouble::Failure(failure) => raised(py, &failure, &hearing.doubts()),
        Trouble::Python(error) => error,
    }
}

fn is_parameter(net: &Loaded, name: &str) -> bool {
    net.usual().netlist.network.parameter(name).is_ok()
}

/// Asks a question that is not about a network: of netlists, of a record, of numbers.
#[pyfunction]
pub(crate) fn ask(
    py: Python<'_>,
    name: &str,
    files: Vec<PathBuf>,
    words: &Bound<'_, PyDict>,
) -> PyResult<Answer> {
    let mut found = VERBS.iter().filter(|verb| verb.name == name);
    let verb = found.find(|verb| verb.about != About::Network);
    let none = || Trouble::of_value(format!("`{name}` is asked of a network"));
    answered(py, verb.ok_or_else(none)?, (None, files), words)
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
        let about = match verb.about {
            About::Network => "network",
            About::Netlists => "netlists",
            About::Nothing => "nothing",
        };
        let options = verb.options.iter();
        let options = options.map(|option| (option.name, option.kind.python(), option.means));
        (verb.name, about, verb.purpose, verb.first, verb.sets, options.collect())
    };
    VERBS.iter().map(one).collect()
}

/// Answers are sent between threads.
const _: fn(Found) = |found| {
    fn sent<T: Send>(_: T) {}
    sent(found);
};

/// A failure of the netlist.
pub(crate) fn failed(failure: Failure) -> PyErr {
    Trouble::from(failure).into()
}
