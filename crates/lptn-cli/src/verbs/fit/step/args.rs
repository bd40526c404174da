//! The options of `lptn fit step`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{CsvForm, Printed, Scale, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn fit step record.csv
  lptn fit step record.csv --capacity \"2659 J/K ± 5 %\" --sensor \"3 K\"
  lptn fit step record.csv --capacity \"2659 J/K\" --reference mill_bed
  lptn fit step record.csv --model gearbox.toml --port steel --format json
  lptn fit step zth.csv --terms 4";

/// Fit one exponential to each thermocouple of a record
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct StepArgs {
    /// A CSV file with headers like `t [s],ring [degC]`; - reads stdin
    #[arg(value_name = "RECORD")]
    pub(crate) record: PathBuf,
    /// Fit this column; may be repeated; default: all temperatures
    #[arg(long, value_name = "NAME")]
    pub(crate) column: Vec<String>,
    /// The column of the times, if it is not the first in a unit of time
    #[arg(long, value_name = "NAME")]
    pub(crate) time: Option<String>,
    /// Leave out the rows before this time of the record, such as "30 s"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,
    /// Leave out the rows after this time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) to: Option<String>,
    /// Leave out values far from their neighbours
    #[arg(long)]
    pub(crate) drop_outliers: bool,
    /// Go on to R_eq and P_disp with C_eq, such as "2659 J/K ± 5 %"
    #[arg(long, value_name = "J/K", allow_hyphen_values = true)]
    pub(crate) capacity: Option<String>,
    /// Count dT from T_i (initial), from a column, or from "25.5 degC"
    #[arg(long, value_name = "WHAT", default_value = "initial", allow_hyphen_values = true)]
    pub(crate) reference: String,
    /// Accuracy class of the thermocouples, such as "3 K"
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub(crate) sensor: Option<String>,
    /// State the bias of the method on this network
    #[arg(long, value_name = "FILE", requires = "port")]
    pub(crate) model: Option<PathBuf>,
    /// The node of the model that the thermocouple is on
    #[arg(long, value_name = "NODE", requires = "model")]
    pub(crate) port: Option<String>,
    /// Write P_disp, R_eq and C_eq with their covariance here, for lptn run --posterior
    #[arg(long, value_name = "FILE", requires = "capacity")]
    pub(crate) posterior: Option<PathBuf>,
    /// Fit several exponentials to one column: their number, or auto for that of the least AICc
    #[arg(long, value_name = "N", conflicts_with_all = ["capacity", "sensor", "model", "posterior"])]
    pub(crate) terms: Option<String>,
    /// Heat of the step, such as "1 W": terms are then resistances
    #[arg(long, value_name = "W", requires = "terms", allow_hyphen_values = true)]
    pub(crate) power: Option<String>,
    #[command(flatten)]
    pub(crate) printed: Printed,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) form: CsvForm,
}
