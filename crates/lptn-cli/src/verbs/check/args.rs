//! The options of `lptn check`.

use clap::Args as Arguments;
use lptn_report::Format;

use crate::options::{Source, TEMPLATE, one_of};

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
    #[arg(value_parser = one_of(&[Format::Table, Format::Json], Format::key))]
    pub(crate) format: Format,
    /// Print it flat, in SI units, without templates
    #[arg(long, conflicts_with = "format")]
    pub(crate) expand: bool,
}
