//! Curves over time: runs, results of runs and records over each other.

mod overlay;
mod source;

pub use overlay::overlay;
pub use source::{Columns, Source, is_netlist, is_record};
