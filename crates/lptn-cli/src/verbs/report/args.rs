//! The options of `lptn report`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::TEMPLATE;
use crate::reporting::page_name;

const EXAMPLES: &str = "\
Examples:
  lptn report out/motor
  lptn report out/motor -o for_anna.html";

/// Write the results of a run in a folder as one HTML page
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ReportArgs {
    /// The folder of results, out/NAME
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// Write this file, not report.html in the folder
    #[arg(short, long, value_name = "FILE", value_parser = page_name)]
    pub(crate) output: Option<PathBuf>,
}
