//! Records of what was computed from what.
//!
//! A [`Manifest`] lies beside the results of a run and names everything that made them: the hash of every input,
//! the parameters as they were resolved, versions, tolerance, counters of the solver, the energy ledger and the
//! hash of every result. What changes from run to run, time and host, stands apart in [`Environment`]; the rest is
//! the same to the last byte whenever the same inputs are run by the same program.

mod digest;
mod manifest;
mod moment;
mod record;

pub use digest::{Hashing, sha256};
pub use manifest::{Environment, FileHash, Manifest, ParameterRecord, RunEnd, Sundials};
pub use moment::utc;
pub use record::{LedgerRecord, Scalar, StatisticsRecord};
