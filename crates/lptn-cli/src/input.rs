//! The netlist that a command line names.

use std::sync::Arc;

use lptn_answer::belief::Belief;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, parse, read};

use crate::arguments;
use crate::options::{Source, Times};

/// Reads the netlist of a command line.
pub(crate) trait Load: Sized {
    /// Reads the netlist, or reports all its problems.
    fn load(source: &Source) -> Result<Self, Failure>;

    /// Reads the netlist with values that a fit found: the load case and `--set` go before them.
    fn load_from(source: &Source, belief: &Belief<'_>) -> Result<Self, Failure>;

    /// Reads the netlist with the times of the command line for its run.
    fn load_run(source: &Source, times: &Times, belief: &Belief<'_>) -> Result<Self, Failure>;
}

impl Load for Input {
    fn load(source: &Source) -> Result<Self, Failure> {
        Self::load_from(source, &Belief::Named)
    }

    fn load_from(source: &Source, belief: &Belief<'_>) -> Result<Self, Failure> {
        let input = Self::open(&source.file, belief, source.settings())?;
        Ok(Self { command: arguments::words(), ..input })
    }

    fn load_run(source: &Source, times: &Times, belief: &Belief<'_>) -> Result<Self, Failure> {
        let text = Arc::new(read(&source.file)?);
        let netlist = parse(&text)?;
        let times = [times.stop.as_deref(), times.every.as_deref()];
        let input = Self::of_run((text, netlist), (belief, times), source.settings())?;
        Ok(Self { command: arguments::words(), ..input })
    }
}
