//! The options of `lptn impedance`.

use std::path::PathBuf;

use clap::Args as Arguments;
use clap::builder::TypedValueParser as _;
use lptn_answer::impedance::Form;

use crate::operating_point::At;
use crate::options::{Printed, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn impedance module.toml --port chip
  lptn impedance module.toml --port chip --duty 0.5,0.1 --format csv
  lptn impedance module.toml --port chip --cauer --write chip.toml
  lptn impedance wall.toml --port outside --to inner --omega \"1/24 Hz\"";

/// Compute the response of a node to a step, to pulses or over frequency
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct ImpedanceArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The input: heat of a node or a source, or the temperature of a boundary
    #[arg(long, value_name = "NAME")]
    pub(crate) port: Option<String>,
    /// The node that responds, if it is not the port
    #[arg(id = "answering", long = "to", value_name = "NODE")]
    pub(crate) to: Option<String>,
    /// Times after the step, such as 1ms,1s; default: three a decade
    #[arg(long, value_name = "TIMES")]
    pub(crate) time: Option<String>,
    /// Pulses too, with these duty cycles, such as 0.5,0.1
    #[arg(long, value_name = "SHARES")]
    pub(crate) duty: Option<String>,
    /// Oscillating heat instead: at these frequencies, in rad/s or Hz, or at three a decade
    #[arg(long, value_name = "LIST", num_args = 0..=1, conflicts_with_all = ["time", "duty"])]
    pub(crate) omega: Option<Option<String>>,
    /// As a sum of exponentials, the R-tau table of data sheets: as many as matter, or N
    #[arg(long, value_name = "N", num_args = 0..=1, conflicts_with_all = ["time", "duty", "omega"])]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=100).map(usize::from))]
    pub(crate) foster: Option<Option<usize>>,
    /// As a ladder of capacities and resistances, whose sums are the structure function
    #[arg(long, value_name = "N", num_args = 0..=1)]
    #[arg(conflicts_with_all = ["time", "duty", "omega", "foster"])]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=100).map(usize::from))]
    pub(crate) cauer: Option<Option<usize>>,
    /// Write the table or the ladder as a netlist too
    #[arg(long, value_name = "FILE")]
    pub(crate) write: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) at: At,
    #[command(flatten)]
    pub(crate) printed: Printed,
}

impl ImpedanceArgs {
    /// Input and form of the response.
    pub(super) fn form(&self) -> Form {
        match (self.foster, self.cauer, &self.omega) {
            (Some(count), ..) => Form::Chain { count, ladder: false },
            (_, Some(count), _) => Form::Chain { count, ladder: true },
            (_, _, Some(list)) => Form::Swing(list.clone()),
            _ => Form::Step { times: self.time.clone(), shares: self.duty.clone() },
        }
    }
}
