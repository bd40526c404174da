//! The command line of `lptn fit law`.

use std::path::PathBuf;

use clap::Args as Arguments;

use lptn_report::Format;

use crate::options::{CsvNumbers, TEMPLATE, one_of};

const EXAMPLES: &str = "\
Examples:
  lptn fit law points.csv
  lptn fit law points.csv --law 'a * omega + b * omega^3'
  lptn fit law records/ --capacity '2659 J/K ± 5 %' --sensor '3 K'
  lptn fit law --dT '0.0084 K/rpm' --t_RC '18.6 min' --P '87 uW/rpm^(5/3)' \\
      --capacity '2659 J/K' --over '1000 rpm to 7000 rpm'";

/// Find the law of the speed that a power follows, and test it against rise and time constant
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct LawArgs {
    /// A CSV file with headers like `omega [rpm],P [W]`, or a folder of records
    #[arg(
        value_name = "POINTS",
        required_unless_present = "rise_law",
        conflicts_with = "rise_law"
    )]
    pub(crate) points: Option<PathBuf>,
    /// The column of the speed, if it is not the only rotation
    #[arg(long, value_name = "NAME", requires = "points")]
    pub(crate) speed: Option<String>,
    /// The column of the power, if it is not the only one; its errors are in NAME_sd
    #[arg(long, value_name = "NAME", requires = "points")]
    pub(crate) power: Option<String>,
    /// The column of the temperature rise, to test whether it agrees with the power
    #[arg(long, value_name = "NAME", requires = "points")]
    pub(crate) rise: Option<String>,
    /// The column of the time constant, for the same test
    #[arg(long, value_name = "NAME", requires = "points")]
    pub(crate) time_constant: Option<String>,
    /// Fit this law too; names that are not columns are coefficients; may be repeated
    #[arg(long, value_name = "EXPRESSION", requires = "points")]
    pub(crate) law: Vec<String>,
    /// Write the coefficients of --law with their covariance here, for lptn run --posterior
    #[arg(long, value_name = "FILE", requires = "law")]
    pub(crate) posterior: Option<PathBuf>,
    /// Begin the search for a coefficient here: "a = 20 mW/rpm"; may be repeated
    #[arg(long, value_name = "NAME=VALUE", requires = "law")]
    pub(crate) start: Vec<String>,
    /// Give every point the same weight, regardless of its standard error
    #[arg(long, requires = "points")]
    pub(crate) unweighted: bool,
    /// The heat capacity, such as "2659 J/K ± 5 %"
    #[arg(long, value_name = "C")]
    pub(crate) capacity: Option<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Format::ALL, Format::key))]
    pub(crate) format: Format,
    /// Write files here, not into out/FOLDER
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    /// Write no files
    #[arg(long)]
    pub(crate) no_files: bool,
    #[command(flatten)]
    pub(crate) records: RecordsArgs,
    #[command(flatten)]
    pub(crate) laws: StatedArgs,
    #[command(flatten)]
    pub(crate) csv: CsvNumbers,
}

/// A folder of records, one for each run.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "A folder of records")]
pub(crate) struct RecordsArgs {
    /// Fit this column; may be repeated, the first gives the power; default: all temperatures
    #[arg(long, value_name = "NAME", requires = "points")]
    pub(crate) column: Vec<String>,
    /// The zero of dT: initial, a column (its mean), or a temperature
    #[arg(long, value_name = "ZERO", default_value = "initial")]
    pub(crate) reference: String,
    /// The accuracy class of the thermocouples, such as "3 K"
    #[arg(long, value_name = "K", requires = "points")]
    pub(crate) sensor: Option<String>,
}

/// Three laws without points: can they be true together?
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Three laws without points")]
pub(crate) struct StatedArgs {
    /// The law of the temperature rise: "0.0084 ± 0.0011 K/rpm", or an expression in omega
    #[arg(
        long = "dT",
        value_name = "LAW",
        allow_hyphen_values = true,
        requires_all = ["time_constant_law", "power_law", "over"]
    )]
    pub(crate) rise_law: Option<String>,
    /// The law of the time constant: "18.6 ± 3.8 min"
    #[arg(long = "t_RC", value_name = "LAW", allow_hyphen_values = true, requires = "rise_law")]
    pub(crate) time_constant_law: Option<String>,
    /// The law of the power: "87 ± 15 uW/rpm^(5/3)"
    #[arg(long = "P", value_name = "LAW", allow_hyphen_values = true, requires = "rise_law")]
    pub(crate) power_law: Option<String>,
    /// The speeds it is about: "1000 rpm to 7000 rpm"
    #[arg(long, value_name = "RANGE", requires = "rise_law")]
    pub(crate) over: Option<String>,
}
