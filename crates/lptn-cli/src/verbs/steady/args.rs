//! The options of `lptn steady`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{NoFiles, Shown, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn steady motor.toml
  lptn steady motor.toml --set P_loss=80W --format json
  lptn steady duty_cycle.toml --periodic";

/// Find the steady state of a network
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct SteadyArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    #[command(flatten)]
    pub(crate) shown: Shown,
    /// Show the heat into and out of a node or boundary, largest path first
    #[arg(long, value_name = "NODE")]
    pub(crate) balance: Option<String>,
    /// Bound the errors of the results, with proof
    #[arg(long)]
    pub(crate) certify: bool,
    #[command(flatten)]
    pub(crate) cycle: CycleArgs,
    #[command(flatten)]
    _no_files: NoFiles,
}

/// A cycle that repeats itself.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Cycles")]
pub(crate) struct CycleArgs {
    /// Find the periodic steady state of repeating inputs
    #[arg(long)]
    pub(crate) periodic: bool,
    /// The period, such as "10 min"; default: that of the signals
    #[arg(long, value_name = "TIME", requires = "periodic", allow_hyphen_values = true)]
    pub(crate) period: Option<String>,
    /// Integrate to a tolerance such as 1e-7K
    #[arg(long, value_name = "K", requires = "periodic")]
    pub(crate) tolerance: Option<String>,
    /// Write the periodic steady state into files here
    #[arg(short, long, value_name = "DIR", requires = "periodic", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
}
