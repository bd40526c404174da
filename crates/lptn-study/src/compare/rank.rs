//! The order of candidates.

use std::cmp::Ordering;

use lptn_network::LimitSeverity;

use crate::compare::candidate::Candidate;

lptn_units::words! {
/// The key by which candidates are sorted, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SortKey {
    /// Those that keep every limit first; then by the least margin of their temperature limits, the
    /// largest first, and those without such a limit last; then by peak.
    Margin = "margin",
    /// The lowest peak first.
    Peak = "peak",
    /// The lowest steady temperature of the hottest node first.
    Steady = "steady",
    /// The slowest first: the longest time to 95 % of the rise.
    Time = "time",
    /// The least heat capacity first.
    Capacity = "capacity",
    /// In the given order.
    Given = "given",
}
/// The name on the command line.
pub fn key;
}

/// The positions of candidates in their order; `None` means one without results, which comes last.
/// Equals stay in the given order.
pub fn order(candidates: &[Option<&Candidate>], key: SortKey) -> Vec<usize> {
    let mut positions: Vec<usize> = (0..candidates.len()).collect();
    positions.sort_by(|&a, &b| match (candidates[a], candidates[b]) {
        (Some(a), Some(b)) => compare(a, b, key),
        (a, b) => b.is_some().cmp(&a.is_some()),
    });
    positions
}

fn compare(a: &Candidate, b: &Candidate, key: SortKey) -> Ordering {
    let temperature = |of: &Candidate| of.peak.map(|peak| peak.temperature);
    let peak = || ascending(temperature(a), temperature(b));
    match key {
        SortKey::Margin => {
            let worst = |c: &Candidate| c.worst().map_or(f64::NEG_INFINITY, |limit| limit.margin);
            broken(a).cmp(&broken(b)).then_with(|| worst(b).total_cmp(&worst(a))).then_with(peak)
        }
        SortKey::Peak => peak(),
        SortKey::Steady => ascending(a.steady, b.steady).then_with(peak),
        SortKey::Time => ascending(b.time_to_95, a.time_to_95).then_with(peak),
        SortKey::Capacity => a.capacity.total_cmp(&b.capacity),
        SortKey::Given => Ordering::Equal,
    }
}

/// True if a limit of severity error is broken.
fn broken(candidate: &Candidate) -> bool {
    candidate.limits.iter().any(|limit| limit.broken() && limit.severity == LimitSeverity::Error)
}

/// An unknown value comes last among ascending values.
fn ascending(a: Option<f64>, b: Option<f64>) -> Ordering {
    a.unwrap_or(f64::INFINITY).total_cmp(&b.unwrap_or(f64::INFINITY))
}
