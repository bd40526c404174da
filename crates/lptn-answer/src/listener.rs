//! Whoever asked, while the answer is computed.

use lptn_netlist::{Diagnostic, Files};
use lptn_solve::{Proceed, Progress};

/// Hears of doubts and of progress, and says whether to go on.
pub trait Listener: Sync {
    /// Doubts in what is being computed; their places are in `files`.
    fn warn(&self, files: &Files, doubts: &[Diagnostic]);

    /// Something worth knowing that is not a doubt.
    fn note(&self, text: &str);

    /// A run has come this far. [`Proceed::Interrupt`] ends it; what is finished is kept.
    fn progress(&self, progress: Progress) -> Proceed;

    /// The same of one of several runs, by what it is called: `at 1e-5 K`.
    fn progress_of(&self, _run: &str, progress: Progress) -> Proceed {
        self.progress(progress)
    }
}

/// Nobody: every run goes to its end, and doubts are in the answers alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Listener for Nobody {
    fn warn(&self, _: &Files, _: &[Diagnostic]) {}

    fn note(&self, _: &str) {}

    fn progress(&self, _: Progress) -> Proceed {
        Proceed::Continue
    }
}
