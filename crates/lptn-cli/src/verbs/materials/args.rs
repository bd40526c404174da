//! The options of `lptn materials`.

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn materials
  lptn materials steel_8620
  lptn materials --format csv > materials.csv";

/// List the materials that ship inside, with their sources
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct MaterialsArgs {
    /// One material, fluid or lubricant, with the source of its numbers; without it all are listed
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
