//! `--at`: the state near which a network that is not linear is linearised.

use clap::Args as Arguments;

/// Where a network that is not linear is taken for a linear one.
#[derive(Clone, Debug, Default, Arguments)]
pub(crate) struct At {
    /// Linearise at the steady state (steady), or at a time of the run such as 10min
    #[arg(long, value_name = "STATE")]
    pub(crate) at: Option<String>,
}
