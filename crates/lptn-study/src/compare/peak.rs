//! The hottest node of a candidate.

use lptn_network::RunSettings;
use lptn_solve::{NodeSummary, first_there};

/// The highest temperature of a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The temperature in K.
    pub temperature: f64,
    /// The time in s at which it is first reached; `None` if the candidate was not run.
    pub at: Option<f64>,
}

/// The item with the largest value; the first of equal ones.
pub(crate) fn hottest<T>(mut of: impl Iterator<Item = (T, f64)>) -> Option<(T, f64)> {
    let first = of.next()?;
    Some(
        of.fold(first, |best, other| if other.1.total_cmp(&best.1).is_gt() { other } else { best }),
    )
}

/// The peak of a node; at the start or end if it is equal to the value there within the tolerance.
pub(crate) fn peak(node: &NodeSummary, run: &RunSettings) -> Peak {
    let ends = [(node.start, run.start), (node.end, run.stop)];
    Peak { temperature: node.peak.0, at: Some(first_there(node.peak, ends, 10.0 * run.tolerance)) }
}
