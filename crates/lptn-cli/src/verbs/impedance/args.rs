//! The options of `lptn impedance`.

use clap::Args as Arguments;

use crate::operating_point::At;
use crate::options::{Printed, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn impedance module.toml --port chip
  lptn impedance module.toml --port chip --duty 0.5,0.1 --format csv
  lptn impedance wall.toml --port outside --to inner --omega \"1/24 Hz\"";

/// Say how a node answers heat: step by step, by pulses, or by frequency
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ImpedanceArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// What is put in: heat of a node or a source, or the temperature of a boundary
    #[arg(long, value_name = "NAME")]
    pub(crate) port: Option<String>,
    /// The node that answers, if it is not the port
    #[arg(id = "answering", long = "to", value_name = "NODE")]
    pub(crate) to: Option<String>,
    /// Times after the step, such as 1ms,1s; else three a decade
    #[arg(long, value_name = "TIMES")]
    pub(crate) time: Option<String>,
    /// Pulses too, which take these shares of their period, such as 0.5,0.1
    #[arg(long, value_name = "SHARES")]
    pub(crate) duty: Option<String>,
    /// Heat that swings instead: at these frequencies, in rad/s or Hz, or at three a decade
    #[arg(long, value_name = "LIST", num_args = 0..=1, conflicts_with_all = ["time", "duty"])]
    pub(crate) omega: Option<Option<String>>,
    #[command(flatten)]
    pub(crate) at: At,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
