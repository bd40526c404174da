//! Many candidates: values of parameters, and reports of each.
//!
//! The rows of `lptn sweep` grow in a file with its own name (`sweep.csv.part`). The record of its
//! inputs, parameters and version is written next to it before the first row. `--resume` accepts no
//! row with another identity. Complete lines are rows; the text after the last line break is
//! discarded.

mod cases;
mod error;
mod latin;
mod limits;
mod linear;
mod task;

pub use cases::Cases;
pub use error::SweepError;
pub use limits::{LimitsJudged, SweepLimits};
pub use linear::LinearSweep;
pub use task::{Candidate, SweepTask};
