//! Comparison of candidate designs: what an engineer asks of each, side by side.

mod candidate;
mod limits;
mod rank;
mod table;

pub(crate) use candidate::hottest;
pub use candidate::{Candidate, CompareError, Peak};
pub use limits::LimitResult;
pub use rank::{SortKey, order};
pub use table::{CompareRow, compare_table};
