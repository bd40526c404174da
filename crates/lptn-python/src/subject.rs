//! The subject of a question, and its answer.

use std::path::PathBuf;
use std::sync::Arc;

use lptn::{Belief, Input, Listener, Loaded};

use crate::memory::Files;
use crate::trouble::Trouble;
use crate::words::Words;

/// An answer of any question.
pub(crate) type Found = Box<dyn lptn::Answer + Send + Sync>;

/// The subject of a question.
pub(crate) struct Asked<'a> {
    /// The network, if it is about one.
    pub(crate) net: Option<&'a Loaded>,
    /// The netlists that it reads itself.
    pub(crate) files: Vec<PathBuf>,
    /// Files in memory by their paths.
    pub(crate) memory: Files,
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
