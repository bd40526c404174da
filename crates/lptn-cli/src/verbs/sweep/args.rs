//! The options of `lptn sweep` and of its verbs.

use std::path::PathBuf;

use clap::{Args as Arguments, Subcommand};
use lptn_answer::sweep::Shard;
use lptn_report::Format;

use crate::options::{Scale, TEMPLATE, one_of};

const EXAMPLES: &str = "\
Examples:
  lptn sweep fan.toml
  lptn sweep fan.toml cooling --resume
  lptn sweep fan.toml cooling --no-files --format csv > fans.csv
  lptn sweep fan.toml cooling --shard 3/20
  lptn sweep merge out/fan/cooling";

/// Solve many candidates: grids, lists, samples of parameters
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct SweepArgs {
    #[command(subcommand)]
    pub(crate) verb: Option<SweepVerb>,
    /// A netlist with a [sweep.NAME]; - reads it from stdin
    #[arg(value_name = "FILE", required = true)]
    pub(crate) file: Option<PathBuf>,
    /// Which [sweep.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Take the parameters and signals of a load case, [case.NAME]; --set goes before it
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Format::ALL, Format::key))]
    pub(crate) format: Format,
    #[command(flatten)]
    pub(crate) scale: Scale,
    /// Write into this folder instead of out/FILE/NAME
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Write no files
    #[arg(long, conflicts_with_all = ["output", "resume", "shard"])]
    pub(crate) no_files: bool,
    /// Continue a sweep that was stopped
    #[arg(long)]
    pub(crate) resume: bool,
    /// Solve the k-th of n parts only; auto asks the scheduler of the cluster
    #[arg(long, value_name = "K/N")]
    pub(crate) shard: Option<Shard>,
    /// Use this number of threads instead of all; the result is the same
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SweepVerb {
    Plan(PlanArgs),
    Merge(MergeArgs),
}

/// Print the job that a scheduler of a cluster runs
#[derive(Debug, Arguments)]
#[command(help_template = TEMPLATE)]
pub(crate) struct PlanArgs {
    /// A netlist with a [sweep.NAME]
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which [sweep.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Take the parameters and signals of a load case, [case.NAME]; --set goes before it
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
    /// Write a job array for Slurm
    #[arg(long, required_unless_present = "hyperqueue", conflicts_with = "hyperqueue")]
    pub(crate) slurm: bool,
    /// Write a task array for HyperQueue
    #[arg(long)]
    pub(crate) hyperqueue: bool,
    /// The number of parts of the sweep
    #[arg(long, value_name = "N", default_value_t = 10)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub(crate) shards: u64,
    /// The number of cores of each part
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1024))]
    pub(crate) cores: u64,
    /// The folder of the parts, instead of out/FILE/NAME
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
}

/// Join the parts of a sweep
#[derive(Debug, Arguments)]
#[command(help_template = TEMPLATE)]
pub(crate) struct MergeArgs {
    /// The folder of the parts
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
}
