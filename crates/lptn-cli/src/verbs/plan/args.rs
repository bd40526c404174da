//! The options of `lptn plan`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn plan gearbox.toml
  lptn plan gearbox.toml next --plot next.svg";

/// Plan a measurement: which sensors, which runs, for how long
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct PlanArgs {
    /// A netlist with a [plan.NAME]; - reads stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which [plan.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
