//! The options of `lptn gear`.

use clap::Args as Arguments;

use crate::options::{Printed, Scale, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn gear gearbox.toml
  lptn gear gearbox.toml --speed 1000rpm,3000rpm,7000rpm
  lptn gear gearbox.toml --torque '0 N m,10 N m' --temperature 40degC,80degC";

/// Say what gears do: speeds, torques, and what each part loses
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct GearArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The gearbox, with those that it drives; else the only one
    #[arg(value_name = "NAME")]
    pub(crate) gearbox: Option<String>,
    /// Look at these speeds of the input; else at fifths of its own
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) speed: Vec<String>,
    /// Look at these torques on the input; else at its own
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) torque: Vec<String>,
    /// Hold all nodes at these temperatures; else find where they settle
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) temperature: Vec<String>,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
