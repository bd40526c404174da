//! The options of `lptn check`.

use clap::{Args as Arguments, ValueEnum};

use crate::options::{Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn check motor.toml
  lptn check motor.toml --expand > flat.toml
  lptn check - < motor.toml";

/// Look for mistakes in a netlist without running it
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Print a table or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: CheckFormat,
    /// Print it flat, in SI units, without templates
    #[arg(long, conflicts_with = "format")]
    pub(crate) expand: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    Table,
    Json,
}
