//! The command line of `lptn fit`.

use std::path::PathBuf;

use clap::{Args as Arguments, Subcommand};

use crate::args::{Format, TEMPLATE};
use crate::fit::law::{LAW_EXAMPLES, LawArgs};

const STEP_EXAMPLES: &str = "\
Examples:
  lptn fit step record.csv
  lptn fit step record.csv --capacity \"2659 J/K ± 5 %\" --sensor \"3 K\"
  lptn fit step record.csv --capacity \"2659 J/K\" --reference mill_bed
  lptn fit step record.csv --model gearbox.toml --port steel --format json";

const NETWORK_EXAMPLES: &str = "\
Examples:
  lptn fit network gearbox.toml
  lptn fit network gearbox.toml heating --write";

#[derive(Debug, Arguments)]
pub(crate) struct FitArgs {
    #[command(subcommand)]
    pub(crate) verb: FitVerb,
}

#[derive(Debug, Subcommand)]
pub(crate) enum FitVerb {
    /// Fit one exponential to each thermocouple of a record
    #[command(before_help = STEP_EXAMPLES, help_template = TEMPLATE)]
    Step(StepArgs),
    /// Fit parameters of a network to records of its temperatures
    #[command(before_help = NETWORK_EXAMPLES, help_template = TEMPLATE)]
    Network(NetworkArgs),
    /// Find the law of the speed that a power follows, and test it against rise and time constant
    #[command(before_help = LAW_EXAMPLES, help_template = TEMPLATE)]
    Law(Box<LawArgs>),
}

#[derive(Debug, Arguments)]
pub(crate) struct NetworkArgs {
    /// A netlist with a [fit.NAME]; - reads stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which [fit.NAME], where there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// How many searches begin elsewhere between the bounds [4]
    #[arg(long, value_name = "N")]
    pub(crate) starts: Option<u16>,
    /// Write the values into the netlist; comments and order stay
    #[arg(long, conflicts_with = "set")]
    pub(crate) write: bool,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Accepted for scripts that pass it to every verb: `fit network` writes none.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct StepArgs {
    /// A CSV file with headers like `t [s],ring [degC]`; - reads stdin
    #[arg(value_name = "RECORD")]
    pub(crate) record: PathBuf,
    /// Fit this column; may be repeated; all temperatures otherwise
    #[arg(long, value_name = "NAME")]
    pub(crate) column: Vec<String>,
    /// The column of the times, where it is not the first in a unit of time
    #[arg(long, value_name = "NAME")]
    pub(crate) time: Option<String>,
    /// Leave out what is before, such as "30 s" of the record's time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,
    /// Leave out what is after
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) to: Option<String>,
    /// Go on to R_eq and P_disp with C_eq, such as "2659 J/K ± 5 %"
    #[arg(long, value_name = "J/K", allow_hyphen_values = true)]
    pub(crate) capacity: Option<String>,
    /// Count dT from T_i (initial), from a column, or from "25.5 degC"
    #[arg(long, value_name = "WHAT", default_value = "initial", allow_hyphen_values = true)]
    pub(crate) reference: String,
    /// Class error of the thermocouples, such as "3 K"
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub(crate) sensor: Option<String>,
    /// State the bias of the method on this network
    #[arg(long, value_name = "FILE", requires = "port")]
    pub(crate) model: Option<PathBuf>,
    /// The node of the model that the thermocouple is on
    #[arg(long, value_name = "NODE", requires = "model")]
    pub(crate) port: Option<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Show temperatures in degC, K, degF or degR
    #[arg(long, value_name = "UNIT")]
    pub(crate) temperature_unit: Option<String>,
    /// Accepted for scripts that pass it to every verb: `fit step` writes none.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}
