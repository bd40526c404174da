//! The options of `lptn fit compare`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn fit compare one_node.toml two_nodes.toml
  lptn fit compare body.toml --fit linear --fit radiating
  lptn fit compare body.toml --set exponent=0,0.25,0.333 -o results/which";

/// Choose between networks by how well each predicts held-out data
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct FitCompareArgs {
    /// Netlists, or folders of netlists: each [fit.NAME] is a candidate
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Take this [fit.NAME] only; may be repeated
    #[arg(long, value_name = "NAME")]
    pub(crate) fit: Vec<String>,
    /// Give a parameter a value in every candidate that has it, or several, n=1,2: each makes a
    /// separate candidate; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// The number of searches that begin elsewhere between the bounds [4]
    #[arg(long, value_name = "N")]
    pub(crate) starts: Option<u16>,
    /// Write candidates.csv, unseen.csv, choice.json and a manifest here
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) printed: Printed,
    /// Use this number of threads instead of all; the result is the same
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
}
