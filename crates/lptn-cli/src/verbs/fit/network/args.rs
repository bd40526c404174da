//! The options of `lptn fit network`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn fit network gearbox.toml
  lptn fit network gearbox.toml heating --write";

/// Fit parameters of a network to records of its temperatures
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct NetworkArgs {
    /// A netlist with a [fit.NAME]; - reads stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which [fit.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// The number of searches that begin elsewhere between the bounds [4]
    #[arg(long, value_name = "N")]
    pub(crate) starts: Option<u16>,
    /// Write the values into the netlist; comments and order stay
    #[arg(long, conflicts_with = "set")]
    pub(crate) write: bool,
    /// Write residuals.csv, fit.json, posterior.json and a manifest here
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
