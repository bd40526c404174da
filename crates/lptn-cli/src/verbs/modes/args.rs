//! The options of `lptn modes`.

use clap::Args as Arguments;

use crate::operating_point::At;
use crate::options::{Printed, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn modes motor.toml
  lptn modes motor.toml --count 3 --format json
  lptn modes glowing.toml --at steady";

/// List the time constants of a network and the nodes that take part in each
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ModesArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Show the N slowest; default: all of up to 20, or 10
    #[arg(short = 'k', long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) count: Option<u32>,
    #[command(flatten)]
    pub(crate) at: At,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
