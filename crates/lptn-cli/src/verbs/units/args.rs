//! The options of `lptn units`.

use clap::Args as Arguments;

use crate::options::TEMPLATE;

const EXAMPLES: &str = "\
Examples:
  lptn units \"3 L/min\"
  lptn units \"87 uW/rpm^(5/3)\"
  lptn units";

/// Convert a quantity to SI and other units, or list the units
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct UnitsArgs {
    /// A number with its unit, in quotes; without it the known units are listed
    #[arg(value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) quantity: Option<String>,
}
