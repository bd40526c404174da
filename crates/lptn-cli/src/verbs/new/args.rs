//! The options of `lptn new`.

use clap::Args as Arguments;

/// Write a small commented netlist to start from
#[derive(Debug, Arguments)]
pub(crate) struct NewArgs {
    /// The netlist is written to NAME.toml, which must not exist yet
    #[arg(value_name = "NAME")]
    pub(crate) name: String,
}
