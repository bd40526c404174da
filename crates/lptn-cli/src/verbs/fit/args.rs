//! The options of `lptn fit`: its verbs.

use clap::{Args as Arguments, Subcommand};

use super::compare::FitCompareArgs;
use super::law::LawArgs;
use super::network::NetworkArgs;
use super::step::StepArgs;
use crate::options::TEMPLATE;

/// Estimate time constants, resistances and heat from measured records
#[derive(Debug, Arguments)]
#[command(help_template = TEMPLATE)]
pub(crate) struct FitArgs {
    #[command(subcommand)]
    pub(crate) verb: FitVerb,
}

#[derive(Debug, Subcommand)]
pub(crate) enum FitVerb {
    Step(Box<StepArgs>),
    Network(NetworkArgs),
    Law(Box<LawArgs>),
    Compare(FitCompareArgs),
}
