//! The command line: its verbs, each with the options in its own folder.

use clap::{Parser, Subcommand};

use crate::options::{Global, TEMPLATE};
use crate::verbs::{
    check::CheckArgs, compare::CompareArgs, completions::CompletionsArgs, fit::FitArgs,
    materials::MaterialsArgs, modes::ModesArgs, new::NewArgs, reduce::ReduceArgs, run::RunArgs,
    size::SizeArgs, steady::SteadyArgs, units::UnitsArgs, verify::VerifyArgs,
};

const EXAMPLES: &str = "\
Examples:
  lptn new motor                  write motor.toml, a small commented network
  lptn run motor.toml             heat it up: table, heat balance, CSV
  lptn steady motor.toml --set P_loss=\"80 W\"";

/// Simulates lumped-parameter thermal networks
#[derive(Debug, Parser)]
#[command(name = "lptn", before_help = EXAMPLES, help_template = TEMPLATE)]
#[command(disable_version_flag = true, term_width = 80)]
pub(crate) struct Args {
    /// Print the versions of lptn and of the SUNDIALS it runs with
    #[arg(short = 'V', long)]
    pub(crate) version: bool,
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) verb: Option<Verb>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Run(RunArgs),
    Steady(SteadyArgs),
    Modes(ModesArgs),
    Verify(VerifyArgs),
    Compare(CompareArgs),
    Size(SizeArgs),
    Fit(FitArgs),
    Reduce(ReduceArgs),
    Check(CheckArgs),
    New(NewArgs),
    Units(UnitsArgs),
    Materials(MaterialsArgs),
    Completions(CompletionsArgs),
}
