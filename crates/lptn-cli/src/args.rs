//! The command line: a verb, and the options of every verb.

use clap::Parser;

use crate::options::{Global, TEMPLATE};
use crate::verbs::Verb;

const EXAMPLES: &str = "\
Examples:
  lptn new motor                  write motor.toml, a small commented network
  lptn run motor.toml             heat it up: table, heat balance, CSV
  lptn steady motor.toml --set P_loss=\"80 W\"";

/// Simulates lumped-parameter thermal networks
#[derive(Debug, Parser)]
#[command(name = "lptn", before_help = EXAMPLES, help_template = TEMPLATE)]
#[command(disable_version_flag = true)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) always: Always,
    #[command(subcommand)]
    pub(crate) verb: Option<Verb>,
}

/// What stands beside any verb, and before it.
#[derive(Debug, clap::Args)]
pub(crate) struct Always {
    /// Print the versions of lptn and of the SUNDIALS it runs with
    #[arg(short = 'V', long)]
    pub(crate) version: bool,
    #[command(flatten)]
    pub(crate) global: Global,
}
