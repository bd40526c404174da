//! The options of `lptn compare`.

use std::path::PathBuf;

use clap::Args as Arguments;
use lptn_study::SortKey;

use crate::options::{CsvNumbers, Printed, Scale, TEMPLATE, one_of};

const EXAMPLES: &str = "\
Examples:
  lptn compare bare.toml finned.toml fan.toml
  lptn compare candidates/ --sort peak
  lptn compare gearbox.toml --set R_sink=0.55K/W,0.42K/W --cases
  lptn compare gearbox.toml --parts sinks.csv
  lptn compare candidates/ --set P_loss=80W --format csv > candidates.csv";

/// Put candidate designs side by side: peaks, limits, margins, heat
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct CompareArgs {
    /// Netlists, or folders of netlists
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Give a parameter a value in every candidate that has it, or several, R=1K/W,2K/W: each
    /// makes a separate candidate; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Take values and their covariance from a fit, in every candidate that has the parameters
    #[arg(long, value_name = "FILE.json")]
    pub(crate) posterior: Option<PathBuf>,
    /// Show the uncertainty of peaks, margins and their order, from every ±, to first order
    #[arg(long, conflicts_with = "periodic")]
    pub(crate) uncertainty: bool,
    /// Make a candidate of every part in a CSV file, with its name as `part` and a column for each
    /// parameter that a part sets, as R_sink [K/W]; may be repeated
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) parts: Vec<PathBuf>,
    /// Take every netlist in each of its load cases, [case.NAME]
    #[arg(long)]
    pub(crate) cases: bool,
    /// Compare in the periodic steady state of repeated signals, not over the run
    #[arg(long)]
    pub(crate) periodic: bool,
    #[command(flatten)]
    pub(crate) printed: Printed,
    /// Sort by margin, peak, steady, time, capacity, or keep the order as given
    #[arg(long, value_name = "KEY", default_value = "margin", hide_possible_values = true)]
    #[arg(value_parser = one_of(&SortKey::ALL, SortKey::key))]
    pub(crate) sort: SortKey,
    #[command(flatten)]
    pub(crate) scale: Scale,
    /// Use this number of threads instead of all; the result is the same
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    // its heading would be that of options below it
    #[command(flatten)]
    pub(crate) csv: CsvNumbers,
}
