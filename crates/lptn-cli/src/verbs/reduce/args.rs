//! The options of `lptn reduce`.

use std::path::PathBuf;

use clap::Args as Arguments;
use clap::builder::TypedValueParser as _;
use lptn_reduce::{Definition, Judge};
use lptn_report::Format;

use crate::operating_point::At;
use crate::options::{NoFiles, Scale, Source, TEMPLATE, one_of};

const EXAMPLES: &str = "\
Examples:
  lptn reduce motor.toml --port winding --max-error 20%
  lptn reduce motor.toml --port winding --max-error 30% --definition sum
  lptn reduce motor.toml --port winding --max-error 20% --for run
  lptn reduce motor.toml --port winding --error 2K --power 60W
  lptn reduce motor.toml --port winding --nodes 3 --format toml > three.toml
  lptn reduce motor.toml --port winding --max-error 20% --at steady
  lptn reduce motor.toml --keep winding,housing --write kept.toml";

/// Replace a network by one node, and show the error
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ReduceArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The node that the network is seen from
    #[arg(long, value_name = "NODE")]
    pub(crate) port: Option<String>,
    /// Keep several nodes, and the network between them: steel,housing
    #[arg(long, value_name = "NODES")]
    #[arg(conflicts_with_all = ["port", "definition", "bias", "window", "worst", "at"])]
    pub(crate) keep: Option<String>,
    /// Write how all temperatures follow from the kept ones
    #[arg(long, value_name = "FILE")]
    pub(crate) recover: Option<PathBuf>,
    /// Exit with 1 if the error is larger than this: 0.5K, or 2% of the rise
    #[arg(long, value_name = "ERROR", default_value = "5%")]
    pub(crate) max_error: String,
    /// Use as few nodes as keep this error over every load: 0.1K, or 1%
    #[arg(long, value_name = "ERROR", conflicts_with_all = ["nodes", "definition"])]
    pub(crate) error: Option<String>,
    /// The largest power of these loads, not the largest Q_N
    #[arg(long, value_name = "POWER")]
    pub(crate) power: Option<String>,
    /// Use this number of nodes
    #[arg(long, value_name = "N", conflicts_with = "definition")]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=100).map(usize::from))]
    pub(crate) nodes: Option<usize>,
    /// Write the load with the largest error as a signal
    #[arg(long, value_name = "FILE")]
    pub(crate) worst: Option<PathBuf>,
    /// Recommend the pair with the smallest error of a step, or of the run
    #[arg(long = "for", value_name = "WHAT", default_value = "step", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Judge::ALL, Judge::key))]
    pub(crate) judge: Judge,
    /// Use sum, first_moment, dominant_pole or least_squares for C_eq
    #[arg(long, value_name = "NAME", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Definition::ALL, Definition::key))]
    pub(crate) definition: Option<Definition>,
    /// Fit one exponential to the run and show the heat that it implies
    #[arg(long)]
    pub(crate) bias: bool,
    /// Fit least_squares over this time after the step, not 5 tau_1
    #[arg(long, value_name = "TIME")]
    pub(crate) window: Option<String>,
    #[command(flatten)]
    pub(crate) at: At,
    /// Print a table, csv, json, or the one node as toml
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    #[arg(value_parser = one_of(&ReduceFormat::ALL, ReduceFormat::key))]
    pub(crate) format: ReduceFormat,
    /// Write the one-node network as a netlist too
    #[arg(long, value_name = "FILE")]
    pub(crate) write: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    _no_files: NoFiles,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReduceFormat {
    /// One of every result.
    Of(Format),
    /// The netlist of the one node.
    Toml,
}

impl ReduceFormat {
    const ALL: [Self; 4] =
        [Self::Of(Format::Table), Self::Of(Format::Csv), Self::Of(Format::Json), Self::Toml];

    fn key(self) -> &'static str {
        match self {
            Self::Of(format) => format.key(),
            Self::Toml => "toml",
        }
    }
}
