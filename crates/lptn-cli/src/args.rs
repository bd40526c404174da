//! The command line.

use std::path::PathBuf;

use clap::{Args as Arguments, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use lptn_reduce::Definition;
use lptn_study::SortKey;

use crate::choice::one_of;
use crate::cycle_args::CycleArgs;
use crate::fit::FitArgs;
use crate::uncertainty_args::UncertaintyArgs;

const EXAMPLES: &str = "\
Examples:
  lptn new motor                  write motor.toml, a small commented network
  lptn run motor.toml             heat it up: table, heat balance, CSV
  lptn steady motor.toml --set P_loss=\"80 W\"";

const RUN_EXAMPLES: &str = "\
Examples:
  lptn run motor.toml
  lptn run motor.toml --set P_loss=80W --no-files
  lptn run motor.toml --balance winding
  lptn run motor.toml --select '*.T' --format csv > temperatures.csv";

const STEADY_EXAMPLES: &str = "\
Examples:
  lptn steady motor.toml
  lptn steady motor.toml --set P_loss=80W --format json
  lptn steady duty_cycle.toml --periodic";

const MODES_EXAMPLES: &str = "\
Examples:
  lptn modes motor.toml
  lptn modes motor.toml --count 3 --format json";

const VERIFY_EXAMPLES: &str = "\
Examples:
  lptn verify motor.toml
  lptn verify motor.toml --tolerance 1e-7K";

const COMPARE_EXAMPLES: &str = "\
Examples:
  lptn compare bare.toml finned.toml fan.toml
  lptn compare candidates/ --sort peak
  lptn compare candidates/ --set P_loss=80W --format csv > candidates.csv";

const SIZE_EXAMPLES: &str = "\
Examples:
  lptn size --power \"223 W\" --limit \"110 degC\" --ambient \"35 degC\"
  lptn size fan.toml
  lptn size fan.toml fan --write";

const REDUCE_EXAMPLES: &str = "\
Examples:
  lptn reduce motor.toml --port winding
  lptn reduce motor.toml --port winding --max-error 30% --definition sum
  lptn reduce motor.toml --port winding --format toml > one_node.toml";

const CHECK_EXAMPLES: &str = "\
Examples:
  lptn check motor.toml
  lptn check motor.toml --expand > flat.toml
  lptn check - < motor.toml";

const UNITS_EXAMPLES: &str = "\
Examples:
  lptn units \"3 L/min\"
  lptn units \"87 uW/rpm^(5/3)\"
  lptn units";

const MATERIALS_EXAMPLES: &str = "\
Examples:
  lptn materials
  lptn materials steel_8620
  lptn materials --format csv > materials.csv";

pub(crate) const TEMPLATE: &str = "{before-help}{about-with-newline}\n{usage-heading} {usage}\n\n{all-args}";

/// Simulates lumped-parameter thermal networks
#[derive(Debug, Parser)]
#[command(name = "lptn", before_help = EXAMPLES, help_template = TEMPLATE, disable_version_flag = true)]
#[command(term_width = 80)]
pub(crate) struct Args {
    /// Print the versions of lptn and of the SUNDIALS it runs with
    #[arg(short = 'V', long)]
    pub(crate) version: bool,
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) verb: Option<Verb>,
}

/// Options of every verb.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Everywhere")]
pub(crate) struct Global {
    /// Print results and errors only
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more about the solver, and list what was not checked
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto", hide_possible_values = true)]
    #[arg(help = "Use colours: auto, always or never; auto respects NO_COLOR", hide_default_value = true)]
    pub(crate) color: Color,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Simulate a network over time
    #[command(before_help = RUN_EXAMPLES, help_template = TEMPLATE)]
    Run(RunArgs),
    /// Find the temperatures at which a network settles
    #[command(before_help = STEADY_EXAMPLES, help_template = TEMPLATE)]
    Steady(SteadyArgs),
    /// List the time constants of a network and who takes part in each
    #[command(before_help = MODES_EXAMPLES, help_template = TEMPLATE)]
    Modes(ModesArgs),
    /// Compare runs of a network with its exact solution
    #[command(before_help = VERIFY_EXAMPLES, help_template = TEMPLATE)]
    Verify(VerifyArgs),
    /// Put candidate designs side by side: peaks, limits, margins, heat
    #[command(before_help = COMPARE_EXAMPLES, help_template = TEMPLATE)]
    Compare(CompareArgs),
    /// Find the cooling, or the value of a parameter, that keeps a limit
    #[command(before_help = SIZE_EXAMPLES, help_template = TEMPLATE)]
    Size(SizeArgs),
    /// Take time constants, resistances and heat from measured records
    #[command(help_template = TEMPLATE)]
    Fit(FitArgs),
    /// Replace a network by one node, and say how wrong that is
    #[command(before_help = REDUCE_EXAMPLES, help_template = TEMPLATE)]
    Reduce(ReduceArgs),
    /// Look for mistakes in a netlist without running it
    #[command(before_help = CHECK_EXAMPLES, help_template = TEMPLATE)]
    Check(CheckArgs),
    /// Write a small commented netlist to start from
    New(NewArgs),
    /// Convert a quantity to SI and other units, or list the units
    #[command(before_help = UNITS_EXAMPLES, help_template = TEMPLATE)]
    Units(UnitsArgs),
    /// List the materials that ship inside, with their sources
    #[command(before_help = MATERIALS_EXAMPLES, help_template = TEMPLATE)]
    Materials(MaterialsArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
}

/// The netlist and what is changed in it.
#[derive(Debug, Arguments)]
pub(crate) struct Source {
    /// The netlist; - reads it from stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
}

/// What is shown of a result, and how.
#[derive(Debug, Arguments)]
pub(crate) struct Shown {
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Keep columns like '*.T'; may be repeated
    #[arg(long, value_name = "PATTERN")]
    pub(crate) select: Vec<String>,
    /// Show temperatures in degC, K, degF or degR
    #[arg(long, value_name = "UNIT")]
    pub(crate) temperature_unit: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Csv,
    Json,
}

#[derive(Debug, Arguments)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    #[command(flatten)]
    pub(crate) shown: Shown,
    /// Show the heat into and out of a node or boundary, largest path first
    #[arg(long, value_name = "NODE")]
    pub(crate) balance: Option<String>,
    /// Integrate to a tolerance such as 1e-7K
    #[arg(long, value_name = "K")]
    pub(crate) tolerance: Option<String>,
    /// Write files here, not into out/NAME
    #[arg(short, long, value_name = "DIR", conflicts_with = "no_files")]
    pub(crate) output: Option<PathBuf>,
    /// Write no files
    #[arg(long)]
    pub(crate) no_files: bool,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
}

#[derive(Debug, Arguments)]
pub(crate) struct SteadyArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    #[command(flatten)]
    pub(crate) shown: Shown,
    /// Show the heat into and out of a node or boundary, largest path first
    #[arg(long, value_name = "NODE")]
    pub(crate) balance: Option<String>,
    #[command(flatten)]
    pub(crate) cycle: CycleArgs,
    /// Accepted for scripts that pass it to every verb: `steady` writes none unless asked.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct ModesArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Show the N slowest; else all of up to 20, or 10
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) count: Option<u32>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Accepted for scripts that pass it to every verb: `modes` writes none.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct CompareArgs {
    /// Netlists, or folders of netlists
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Give a parameter a value in every candidate that has it; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Sort by margin, peak, steady, time, capacity, or keep the order as given
    #[arg(long, value_name = "KEY", default_value = "margin", hide_possible_values = true)]
    #[arg(value_parser = one_of(&SortKey::ALL, SortKey::key))]
    pub(crate) sort: SortKey,
    /// Show temperatures in degC, K, degF or degR
    #[arg(long, value_name = "UNIT")]
    pub(crate) temperature_unit: Option<String>,
    /// Use so many threads, not all of the machine; the result is the same
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Accepted for scripts that pass it to every verb: `compare` writes none.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct VerifyArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Verify a tolerance such as 1e-7K and a hundredth of it
    #[arg(long, value_name = "K")]
    pub(crate) tolerance: Option<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    /// Accepted for scripts that pass it to every verb: `verify` writes none.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct ReduceArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// The node that the network is seen from
    #[arg(long, value_name = "NODE")]
    pub(crate) port: String,
    /// Exit with 1 if the error over the run is larger than 0.5K, or 2%
    #[arg(long, value_name = "ERROR")]
    pub(crate) max_error: Option<String>,
    /// Use sum, first_moment, dominant_pole or least_squares for C_eq
    #[arg(long, value_name = "NAME", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Definition::ALL, Definition::key))]
    pub(crate) definition: Option<Definition>,
    /// Fit one exponential to the run and say what heat it implies
    #[arg(long)]
    pub(crate) bias: bool,
    /// Fit least_squares over this time after the step, not over the run
    #[arg(long, value_name = "TIME")]
    pub(crate) window: Option<String>,
    /// Print a table, csv, json, or the one node as toml
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: ReduceFormat,
    /// Write the one-node network as a netlist too
    #[arg(long, value_name = "FILE")]
    pub(crate) write: Option<PathBuf>,
    /// Show temperatures in degC, K, degF or degR
    #[arg(long, value_name = "UNIT")]
    pub(crate) temperature_unit: Option<String>,
    /// Accepted for scripts that pass it to every verb: only `--write` writes a file.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
}

#[derive(Debug, Arguments)]
pub(crate) struct SizeArgs {
    /// A netlist with a [size.NAME]; without it the options of a cooling are needed
    #[arg(value_name = "FILE")]
    pub(crate) file: Option<PathBuf>,
    /// Which [size.NAME], where there are several
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE", conflicts_with = "power")]
    pub(crate) set: Vec<String>,
    /// Write the value into the netlist; comments and order stay
    #[arg(long, conflicts_with_all = ["set", "power"])]
    pub(crate) write: bool,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
    #[command(flatten)]
    pub(crate) cooling: CoolingArgs,
    /// Accepted for scripts that pass it to every verb.
    #[arg(long, hide = true)]
    pub(crate) no_files: bool,
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
    /// How much air or oil may warm on its way [10 K]
    #[arg(long, value_name = "K", conflicts_with = "file", allow_hyphen_values = true)]
    pub(crate) rise: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReduceFormat {
    Table,
    Csv,
    Json,
    Toml,
}

#[derive(Debug, Arguments)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Print a table or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: CheckFormat,
    /// Print it flat, in SI units, without templates
    #[arg(long, conflicts_with = "format")]
    pub(crate) expand: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    Table,
    Json,
}

#[derive(Debug, Arguments)]
pub(crate) struct NewArgs {
    /// The netlist is written to NAME.toml, which must not exist yet
    #[arg(value_name = "NAME")]
    pub(crate) name: String,
}

#[derive(Debug, Arguments)]
pub(crate) struct UnitsArgs {
    /// A number with its unit, in quotes; without it the known units are listed
    #[arg(value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) quantity: Option<String>,
}

#[derive(Debug, Arguments)]
pub(crate) struct MaterialsArgs {
    /// One material or fluid, with the source of its numbers; without it all are listed
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    pub(crate) format: Format,
}

#[derive(Debug, Arguments)]
pub(crate) struct CompletionsArgs {
    /// bash, zsh, fish, elvish or powershell
    #[arg(value_name = "SHELL", hide_possible_values = true)]
    pub(crate) shell: Shell,
}
