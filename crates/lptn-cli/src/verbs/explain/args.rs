//! The options of `lptn explain`.

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn explain netlist::unknown_key
  lptn explain units
  lptn explain broken
  lptn explain";

/// Explain the code of a message, or list all codes
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ExplainArgs {
    /// The code in brackets in a message, an area such as units, or a word of a verdict
    /// such as broken; without it all codes are listed
    #[arg(value_name = "CODE")]
    pub(crate) code: Option<String>,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
