//! The options of `lptn plot`.

use std::path::PathBuf;

use clap::Args as Arguments;

use super::view::ViewArgs;
use crate::drawing::Drawing;
use crate::options::{CsvForm, Scale, TEMPLATE, Times};

const EXAMPLES: &str = "\
Examples:
  lptn plot motor.toml                      run it, and draw it here
  lptn plot out/motor -o motor.svg          draw the results of a run
  lptn plot motor.toml measured.csv -o both.png
  lptn plot house.toml --from 200d --to 207d --energy-unit kWh
  lptn plot duty.toml --periodic -o cycle.png --size 160x90mm --dpi 300
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
    /// Take the parameters and signals of a load case, [case.NAME]
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
    /// Draw one cycle in periodic steady state
    #[arg(long, conflicts_with = "stop")]
    pub(crate) periodic: bool,
    /// The period, such as "10 min"; default: that of the signals
    #[arg(long, value_name = "TIME", requires = "periodic", allow_hyphen_values = true)]
    pub(crate) period: Option<String>,
    /// Keep columns like '*.T'; may be repeated
    #[arg(long, value_name = "PATTERN")]
    pub(crate) select: Vec<String>,
    #[command(flatten)]
    pub(crate) times: Times,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    #[command(flatten)]
    pub(crate) form: CsvForm,
}
