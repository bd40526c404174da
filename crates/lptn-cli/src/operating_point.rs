//! `--at`: the state near which a network that is not linear is linearised.

use clap::Args as Arguments;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::operating_point::OperatingPoint;

use crate::console::Console;

/// Where a network that is not linear is taken for a linear one.
#[derive(Clone, Debug, Default, Arguments)]
pub(crate) struct At {
    /// Linearise where the network settles (steady), or at a time of its run such as 10min
    #[arg(long, value_name = "STATE")]
    pub(crate) at: Option<String>,
}

impl At {
    /// The state that is asked for, if one is.
    pub(crate) fn find(
        &self,
        input: &Input,
        console: &Console,
    ) -> Result<Option<OperatingPoint>, Failure> {
        let Some(text) = &self.at else { return Ok(None) };
        let point = OperatingPoint::find(text, input, &console.listening())?;
        console.warn(&input.netlist.files, &point.doubts);
        Ok(Some(point))
    }
}
