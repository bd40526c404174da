//! Runs that have no result.

use std::fmt;

/// Runs without a result, all for the same reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Lost {
    /// Number of runs.
    pub count: usize,
    /// True if the network refused the parameters, such as a resistance below zero; else the run
    /// failed.
    pub refused: bool,
    /// The stable code of the reason.
    pub code: &'static str,
    /// The message of the network or the run for the first of them.
    pub message: String,
}

impl fmt::Display for Lost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = if self.refused { "refused" } else { "failed" };
        let runs = if self.count == 1 { "run" } else { "runs" };
        write!(f, "{} {runs} {how} ({}): {}", self.count, self.code, self.message)
    }
}
