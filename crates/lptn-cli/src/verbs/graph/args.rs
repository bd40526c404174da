//! The options of `lptn graph`.

use std::path::PathBuf;

use clap::Args as Arguments;

use crate::options::{NoFiles, Scale, Source, TEMPLATE, one_of};
use lptn_answer::graph::Kind;

const EXAMPLES: &str = "\
Examples:
  lptn graph motor.toml --steady
  lptn graph motor.toml --sankey --at 10min
  lptn graph motor.toml -o motor.png
  lptn graph motor.toml --format mermaid
  lptn graph wall.toml --slice z=1";

/// Draw a network, or the temperatures in a grid
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct GraphArgs {
    #[command(flatten)]
    pub(crate) source: Source,
    /// Write svg, png, dot, mermaid; of a grid vtk or csv
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Kind::ALL, Kind::key))]
    pub(crate) format: Option<Kind>,
    /// Write this file by its ending; - is stdout
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Show temperatures and heat flows in steady state
    #[arg(long)]
    pub(crate) steady: bool,
    /// Show them at a time of the run, such as 10min
    #[arg(long, value_name = "TIME", conflicts_with = "steady")]
    pub(crate) at: Option<String>,
    /// Draw heat flows as bands of their width
    #[arg(long)]
    pub(crate) sankey: bool,
    /// Draw each grid, instance and family as one box
    #[arg(long, conflicts_with = "no_group")]
    pub(crate) group: bool,
    /// Draw every node by itself
    #[arg(long)]
    pub(crate) no_group: bool,
    #[command(flatten)]
    pub(crate) field: FieldArgs,
    #[command(flatten)]
    pub(crate) scale: Scale,
    #[command(flatten)]
    _no_files: NoFiles,
}

impl GraphArgs {
    /// Output that can only be a picture, and the option that asks for it.
    pub(super) fn only_a_picture(&self) -> Option<[&'static str; 2]> {
        match (&self.field.slice, self.sankey) {
            (Some(_), _) => Some(["a slice", "--slice"]),
            (None, true) => Some(["a Sankey diagram", "--sankey"]),
            (None, false) => None,
        }
    }
}

/// The temperatures in a grid.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Grids")]
pub(crate) struct FieldArgs {
    /// Draw a layer of cells by number or place: z=3, "z=5 mm"
    #[arg(long, value_name = "AXIS=PLACE", conflicts_with_all = ["group", "no_group", "steady", "sankey"])]
    pub(crate) slice: Option<String>,
    /// Draw this grid, if there are several
    #[arg(long, value_name = "NAME", conflicts_with = "sankey")]
    pub(crate) grid: Option<String>,
}
