//! The options of `lptn verify`.

use clap::Args as Arguments;

use crate::operating_point::At;
use crate::options::{Printed, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn verify motor.toml
  lptn verify motor.toml --tolerance 1e-7K
  lptn verify glowing.toml --at steady";

/// Compare runs of a network with its exact solution
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct VerifyArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Verify a tolerance such as 1e-7K and a hundredth of it
    #[arg(long, value_name = "K", conflicts_with = "at")]
    pub(crate) tolerance: Option<String>,
    #[command(flatten)]
    pub(crate) at: At,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
