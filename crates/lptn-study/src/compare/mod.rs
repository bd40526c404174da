//! Comparison of candidate designs: the results that matter for each, side by side.

mod asked;
mod candidate;
mod doubt;
mod error;
mod heat;
mod limits;
mod peak;
mod rank;
mod reports;
mod settled;
mod table;

pub use candidate::Candidate;
pub use doubt::{Above, Scatter};
pub use error::CompareError;
pub use heat::{HeatOut, HeatOver, PathShare, Share};
pub use limits::CandidateLimit;
pub use peak::Peak;
pub(crate) use peak::hottest;
pub use rank::{SortKey, order};
pub use reports::CandidateReport;
pub use settled::Settled;
pub use table::{CompareRow, compare_table};
