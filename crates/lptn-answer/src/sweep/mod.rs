//! Sweeps: many candidates of one netlist.

mod asked;
mod figure;
mod front;
mod kept;
mod lines;
mod page;
mod row;
mod shard;
mod solve;
mod tally;

pub use asked::{Column, SweepAsked, SweepQuestion, folder, study};
pub use kept::{KeptRows, RowForm};
pub use lines::{Lines, damaged, read_row};
pub use page::{Rows, SweepAnswer};
pub use row::{Row, RowShape};
pub use shard::Shard;
pub use tally::Tally;
