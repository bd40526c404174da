//! What the table of a run shows.

use lptn_netlist::RunSettings;
use lptn_solve::{Lumping, Solution, SteadyState, Table};
use lptn_units::Unit;

use super::job::NoSteady;
use super::uncertainty::Study;
use crate::limits::Judged;

/// Everything that the text of a run is made of.
#[derive(Clone, Debug)]
pub(crate) struct View<'a> {
    pub(crate) title: &'a str,
    pub(crate) lumping: &'a Lumping,
    /// Where the temperatures at the start come from, if not from the netlist.
    pub(crate) origin: Option<String>,
    pub(crate) solution: &'a Solution,
    pub(crate) steady: Result<&'a SteadyState, &'a NoSteady>,
    pub(crate) unit: &'a Unit,
    pub(crate) settings: &'a RunSettings,
    pub(crate) limits: &'a [Judged],
    pub(crate) uncertainty: Option<&'a Study>,
    pub(crate) table: &'a Table,
    /// Whether columns were asked for by name.
    pub(crate) chosen: bool,
}
