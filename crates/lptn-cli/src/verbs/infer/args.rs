//! The options of `lptn infer`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn infer gearbox.toml
  lptn infer gearbox.toml power -o results --plot power.svg
  tail -n +1 -f bench.csv | lptn infer gearbox.toml power --follow";

/// Estimate a heat, flow or heat transfer coefficient over time from a record
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct InferArgs {
    /// A netlist with an [infer.NAME]; - reads stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which [infer.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Read a growing record from stdin and answer each row at once
    #[arg(long, conflicts_with = "output")]
    pub(crate) follow: bool,
    /// Write inferred.csv, infer.json and a manifest here
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) printed: Printed,
}
