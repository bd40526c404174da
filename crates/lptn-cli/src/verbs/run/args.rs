//! The options of `lptn run`.

use std::path::PathBuf;

use clap::Args as Arguments;
use lptn_answer::run::{RunQuestion, View};

use super::uncertainty::UncertaintyArgs;
use crate::console::Console;
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
    /// Bound the errors of the results, with proof
    #[arg(long)]
    pub(crate) certify: bool,
    /// Write files here, not into out/NAME
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    /// Write no files
    #[arg(long)]
    pub(crate) no_files: bool,
    /// Draw the network in the report at this time; may be repeated
    #[arg(long, value_name = "TIME", requires = "report")]
    pub(crate) at: Vec<String>,
    /// Make a report whose parameters can be changed in the browser, which solves again
    #[arg(long, requires = "report", conflicts_with_all = ["uncertainty", "posterior"])]
    pub(crate) live: bool,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    /// True if the run is drawn
    #[arg(skip)]
    pub(crate) picture: bool,
    /// The part that is drawn
    #[arg(skip)]
    pub(crate) view: View,
}

impl RunArgs {
    /// The question; `console` gives the detail, and says if a report is wanted.
    pub(crate) fn question(&self, console: &Console) -> RunQuestion {
        RunQuestion {
            tolerance: self.tolerance.clone(),
            select: self.shown.select.clone(),
            temperature_unit: self.shown.scale.temperature_unit.clone(),
            time_unit: self.time_scale.time_unit,
            balance: self.balance.clone(),
            at: self.at.clone(),
            format: self.shown.format,
            report: console.reports(),
            picture: self.picture || console.plot.is_some(),
            view: self.view,
            detail: console.detail,
            uncertainty: self.uncertainty.question(),
            certify: self.certify,
        }
    }
}
