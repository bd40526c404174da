//! The netlist that a command line names.

use lptn_answer::belief::Belief;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;

use crate::arguments;
use crate::options::{Source, Times};

/// Reads the netlist of a command line.
pub(crate) trait Load: Sized {
    /// Reads the netlist, or reports all its problems.
    fn load(source: &Source) -> Result<Self, Failure>;

    /// Reads the netlist with values that a fit found: the load case and `--set` go before them.
    fn load_from(source: &Source, belief: &Belief<'_>) -> Result<Self, Failure>;

    /// Gives the run the times of the command line.
    fn set_run_times(&mut self, times: &Times) -> Result<(), Failure>;
}

impl Load for Input {
    fn load(source: &Source) -> Result<Self, Failure> {
        Self::load_from(source, &Belief::Named)
    }

    fn load_from(source: &Source, belief: &Belief<'_>) -> Result<Self, Failure> {
        let input = Self::open(&source.file, belief, source.settings())?;
        Ok(Self { command: arguments::words(), ..input })
    }

    fn set_run_times(&mut self, times: &Times) -> Result<(), Failure> {
        self.set_times(times.stop.as_deref(), times.every.as_deref())
    }
}
