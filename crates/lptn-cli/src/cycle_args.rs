//! The options of `lptn steady --periodic`.

use std::path::PathBuf;

use clap::Args as Arguments;

/// A cycle that repeats itself.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Cycles")]
pub(crate) struct CycleArgs {
    /// Find the cycle that repeating inputs settle at
    #[arg(long)]
    pub(crate) periodic: bool,
    /// The period, such as "10 min"; else that of the signals
    #[arg(long, value_name = "TIME", requires = "periodic", allow_hyphen_values = true)]
    pub(crate) period: Option<String>,
    /// Integrate to a tolerance such as 1e-7K
    #[arg(long, value_name = "K", requires = "periodic")]
    pub(crate) tolerance: Option<String>,
    /// Write the settled cycle into files here
    #[arg(short, long, value_name = "DIR", requires = "periodic", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
}
