//! The options of `lptn run --uncertainty`.

use std::path::PathBuf;

use clap::{Args as Arguments, ValueEnum};
use lptn_answer::run::uncertainty::{self, UncertaintyQuestion};

/// What the `±` of parameters do to the results.
#[derive(Debug, Default, Arguments)]
#[command(next_help_heading = "Uncertainty")]
pub(crate) struct UncertaintyArgs {
    /// Bands from every `±` in `[param]`, by linear or sobol [linear]
    #[arg(long, value_name = "METHOD", hide_possible_values = true)]
    #[arg(num_args = 0..=1, default_missing_value = "linear")]
    pub(crate) uncertainty: Option<Method>,
    /// Take values and their covariance from a fit, not those of the netlist
    #[arg(long, value_name = "FILE.json")]
    pub(crate) posterior: Option<PathBuf>,
    /// Base points of sobol, a power of two [512]
    #[arg(long, value_name = "N", requires = "uncertainty")]
    #[arg(value_parser = clap::value_parser!(u32).range(64..=65536))]
    pub(crate) samples: Option<u32>,
    /// Seed of sobol [1]
    #[arg(long, value_name = "S", requires = "uncertainty")]
    pub(crate) seed: Option<u32>,
    /// Use this number of threads; the result is the same
    #[arg(long, value_name = "N", requires = "uncertainty")]
    pub(crate) threads: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    Linear,
    Sobol,
}

impl UncertaintyArgs {
    /// The uncertainty that is requested.
    pub(crate) fn question(&self) -> Option<UncertaintyQuestion> {
        let method = match self.uncertainty? {
            Method::Linear => uncertainty::Method::Linear,
            Method::Sobol => uncertainty::Method::Sobol,
        };
        let Self { samples, seed, threads, .. } = *self;
        Some(UncertaintyQuestion { method, samples, seed, threads })
    }
}
