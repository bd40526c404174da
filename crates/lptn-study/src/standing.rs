//! Limits of a candidate in a word, the same in comparisons and sweeps.

use lptn_network::LimitSeverity;

/// All limits are kept.
pub const KEPT: &str = "kept";
/// A limit of severity `"error"` is broken.
pub const BROKEN: &str = "broken";
/// A limit is broken, but only of severity `"warning"`.
pub const WARNING: &str = "warning";
/// No limit is broken, but one could not be judged.
pub const NOT_JUDGED: &str = "not judged";
/// There is no limit.
pub const NONE: &str = "none";

/// One of these words, from the margin of each limit, NaN if it was not judged, and its severity.
pub fn standing(limits: impl Iterator<Item = (f64, LimitSeverity)> + Clone) -> &'static str {
    let broken = |severity| limits.clone().any(|(margin, own)| margin < 0.0 && own == severity);
    match (broken(LimitSeverity::Error), broken(LimitSeverity::Warning)) {
        (true, _) => BROKEN,
        (false, true) => WARNING,
        (false, false) if limits.clone().next().is_none() => NONE,
        (false, false) if limits.clone().any(|(margin, _)| margin.is_nan()) => NOT_JUDGED,
        (false, false) => KEPT,
    }
}
