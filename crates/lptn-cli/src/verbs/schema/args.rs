//! The options of `lptn schema`.

use clap::Args as Arguments;

use crate::options::TEMPLATE;

const EXAMPLES: &str = "\
Examples:
  lptn schema > lptn.schema.json
  #:schema ./lptn.schema.json    as the first line of a netlist";

/// Print the JSON Schema of a netlist, for editors
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct SchemaArgs {}
