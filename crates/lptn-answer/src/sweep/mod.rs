//! Sweeps: many candidates of one netlist.

mod asked;
mod figure;
mod front;
mod lines;
mod page;
mod row;
mod shard;
mod solve;
mod tally;

pub use asked::{Column, SweepAsked, SweepQuestion, folder, study};
pub use lines::{Lines, damaged, read_row};
pub use page::{Rows, SweepAnswer};
pub use row::{Row, RowShape};
pub use shard::Shard;
pub use solve::Sink;
pub use tally::Tally;
