//! The options of `lptn rank`.

use clap::{Args as Arguments, ValueEnum};

use crate::options::{Printed, Scale, Source, TEMPLATE};

const EXAMPLES: &str = "\
Examples:
  lptn rank motor.toml
  lptn rank motor.toml --of winding --format csv
  lptn rank motor.toml --over run";

/// Rank values by their effect on a temperature: what to change first
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct RankArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The node whose temperature responds; default: the hottest
    #[arg(long, value_name = "NODE")]
    pub(crate) of: Option<String>,
    /// Its temperature in steady state, or the highest one of the run
    #[arg(long, value_name = "WHAT", default_value = "steady", hide_default_value = true)]
    pub(crate) over: Over,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    pub(crate) printed: Printed,
}

/// Which temperature it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Over {
    Steady,
    Run,
}

impl From<Over> for lptn_answer::rank::Over {
    fn from(over: Over) -> Self {
        match over {
            Over::Steady => Self::Steady,
            Over::Run => Self::Run,
        }
    }
}
