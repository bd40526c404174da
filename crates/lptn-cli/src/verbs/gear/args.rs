//! The options of `lptn gear`.

use clap::Args as Arguments;

use crate::options::{Printed, Scale, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn gear gearbox.toml
  lptn gear gearbox.toml --speed 1000rpm,3000rpm,7000rpm
  lptn gear gearbox.toml --torque '0 N m,10 N m' --temperature 40degC,80degC";

/// Show speeds, torques and losses of the parts of a gearbox
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct GearArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The gearbox, with those that it drives; default: the only one
    #[arg(value_name = "NAME")]
    pub(crate) gearbox: Option<String>,
    /// Use these speeds of the input; default: fifths of the given one
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) speed: Vec<String>,
    /// Use these torques on the input; default: the given one
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) torque: Vec<String>,
    /// Fix all nodes at these temperatures; default: their steady state
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) temperature: Vec<String>,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
