//! The options of `lptn run`.

use std::path::PathBuf;

use clap::Args as Arguments;

use super::uncertainty::args::UncertaintyArgs;
use crate::options::{Shown, Source, TEMPLATE, TimeScale, Times};

const EXAMPLES: &str = "\
Examples:
  lptn run motor.toml
  lptn run motor.toml --set P_loss=80W --no-files
  lptn run motor.toml --balance winding
  lptn run motor.toml --select '*.T' --format csv > temperatures.csv";

/// Simulate a network over time
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    #[command(flatten)]
    pub(crate) times: Times,
    #[command(flatten)]
    pub(crate) shown: Shown,
    #[command(flatten)]
    pub(crate) time_scale: TimeScale,
    /// Show the heat into and out of a node or boundary, largest path first
    #[arg(long, value_name = "NODE")]
    pub(crate) balance: Option<String>,
    /// Integrate to a tolerance such as 1e-7K
    #[arg(long, value_name = "K")]
    pub(crate) tolerance: Option<String>,
    /// Write files here, not into out/NAME
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    /// Write no files
    #[arg(long)]
    pub(crate) no_files: bool,
    /// Draw the network in the report as it is then; may be repeated
    #[arg(long, value_name = "TIME", requires = "report")]
    pub(crate) at: Vec<String>,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
}
