//! Runs of a network compared with its exact solution.

mod near;
mod run;

use std::sync::Arc;

use lptn_netlist::{Diagnostic, Files};
use lptn_report::{Page, PageOf};

use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use near::NearAnswer;
use run::RunAnswer;

/// Letters of a node's name next to the other columns.
const NODE_WIDTH: usize = 22;

const NOTHING: &str = "not verified: there is nothing to compare";

/// Asks if runs of a network agree with its exact solution.
#[derive(Clone, Debug, Default)]
pub struct VerifyQuestion {
    /// The tolerance to verify next to a hundredth of it, `1e-7K`; `None` for that of the run.
    pub tolerance: Option<String>,
    /// The state at which linear and full network are compared, `steady` or a time of its run.
    /// `None` for the run.
    pub at: Option<String>,
}

/// The differences of a run, or of a linear network near a state, from its reference.
#[derive(Debug)]
pub struct VerifyAnswer(Compared);

#[derive(Debug)]
enum Compared {
    Run(RunAnswer),
    Near(NearAnswer),
}

impl VerifyQuestion {
    /// Asks a netlist; `None` if the listener interrupted a run.
    /// The listener hears doubts in advance, because comparing may take a while.
    ///
    /// # Errors
    /// A netlist without a run, and a question that does not fit it.
    /// A state that cannot be computed or disturbed, and a run that fails.
    pub fn ask(
        &self,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<Option<VerifyAnswer>, Failure> {
        let compared = match &self.at {
            Some(text) => Some(Compared::Near(NearAnswer::of(text, input, listener)?)),
            None => RunAnswer::of(self.tolerance.as_deref(), input, listener)?.map(Compared::Run),
        };
        Ok(compared.map(VerifyAnswer))
    }
}

impl VerifyAnswer {
    fn input(&self) -> &Input {
        match &self.0 {
            Compared::Run(run) => &run.input,
            Compared::Near(near) => &near.input,
        }
    }

    /// True if the reference is an exact solution, false if it is a finer run.
    pub fn is_independent(&self) -> bool {
        match &self.0 {
            Compared::Run(run) => run.is_independent(),
            Compared::Near(_) => true,
        }
    }
}

impl PageOf for VerifyAnswer {
    fn page(&self) -> &dyn Page {
        match &self.0 {
            Compared::Run(run) => run,
            Compared::Near(near) => near,
        }
    }
}

impl Answer for VerifyAnswer {
    fn files(&self) -> &Files {
        &self.input().netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        let of_state = match &self.0 {
            Compared::Run(_) => &[],
            Compared::Near(near) => near.doubts_of_state(),
        };
        [self.input().netlist.warnings.as_slice(), of_state].concat()
    }
}

/// Words for wrapping; a number stays with its unit.
fn with_units(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match words.last_mut() {
            Some(number) if word.starts_with('K') => *number += &format!(" {word}"),
            _ => words.push(word.to_owned()),
        }
    }
    words
}
