//! The options of `lptn plot`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::drawing::Drawing;
use crate::options::{CsvForm, Scale, TEMPLATE, Times};

const EXAMPLES: &str = "\
Examples:
  lptn plot motor.toml                      run it, and draw it here
  lptn plot out/motor -o motor.svg          draw the results of a run
  lptn plot motor.toml measured.csv -o both.png
  lptn plot small.toml large.toml --select '*.T'";

/// Draw runs, results and measured records over time
#[derive(Debug, Default, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct PlotArgs {
    /// Netlists, folders of results and CSV files; all into one picture
    #[arg(value_name = "FILE", required = true)]
    pub(crate) sources: Vec<PathBuf>,
    /// Write a picture that ends with .svg or .png; without it, draw it here
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<Drawing>,
    /// Give a parameter of the netlists a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Keep columns like '*.T'; may be repeated
    #[arg(long, value_name = "PATTERN")]
    pub(crate) select: Vec<String>,
    #[command(flatten)]
    pub(crate) times: Times,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) form: CsvForm,
}
