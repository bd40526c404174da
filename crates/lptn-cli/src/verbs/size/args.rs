//! The options of `lptn size`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{Printed, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn size --power \"223 W\" --limit \"110 degC\" --ambient \"35 degC\"
  lptn size fan.toml
  lptn size fan.toml fan --write";

/// Find the cooling, the values of parameters, or the parts that keep a limit
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct SizeArgs {
    /// A netlist with a [size.NAME]; without it the options of a cooling are needed
    #[arg(value_name = "FILE")]
    pub(crate) file: Option<PathBuf>,
    /// Which [size.NAME], if there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE", conflicts_with = "power")]
    pub(crate) set: Vec<String>,
    /// Take values and their covariance from a fit, not those of the netlist
    #[arg(long, value_name = "FILE.json", conflicts_with = "power")]
    pub(crate) posterior: Option<PathBuf>,
    /// Write the value into the netlist; comments and order stay
    #[arg(long, conflicts_with_all = ["set", "power"])]
    pub(crate) write: bool,
    /// Bound the errors of the results, with proof
    #[arg(long, conflicts_with = "power")]
    pub(crate) certify: bool,
    /// Use this number of threads instead of all; the result is the same
    #[arg(long, value_name = "N", conflicts_with = "power")]
    pub(crate) threads: Option<usize>,
    #[command(flatten)]
    pub(crate) printed: Printed,
    #[command(flatten)]
    pub(crate) cooling: CoolingArgs,
}

/// A cooling without a netlist.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Cooling without a netlist")]
pub(crate) struct CoolingArgs {
    /// Heat to be taken away, such as "223 W"
    #[arg(long, value_name = "W", required_unless_present = "file", conflicts_with = "file")]
    #[arg(allow_hyphen_values = true)]
    pub(crate) power: Option<String>,
    /// Temperature that must not be exceeded, such as "110 degC"
    #[arg(long, value_name = "T", required_unless_present = "file", conflicts_with = "file")]
    #[arg(allow_hyphen_values = true)]
    pub(crate) limit: Option<String>,
    /// Temperature of the surroundings, such as "35 degC"
    #[arg(long, value_name = "T", required_unless_present = "file", conflicts_with = "file")]
    #[arg(allow_hyphen_values = true)]
    pub(crate) ambient: Option<String>,
    /// Allowed rise of the air or oil on its way [10 K]
    #[arg(long, value_name = "K", conflicts_with = "file", allow_hyphen_values = true)]
    pub(crate) rise: Option<String>,
}
