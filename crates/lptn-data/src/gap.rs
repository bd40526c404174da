//! Cells in which nothing was measured.

/// Words for a value that was not measured: none, outside of the range, a broken sensor.
const GAPS: [&str; 21] = [
    "nan",
    "na",
    "n/a",
    "null",
    "none",
    "nodata",
    "no data",
    "ol",
    "ul",
    "ofl",
    "ufl",
    "over",
    "under",
    "overflow",
    "underflow",
    "overrange",
    "overload",
    "ovld",
    "burnout",
    "burn out",
    "open",
];

/// True for dashes, points, and the words of [`GAPS`].
pub(crate) fn is_gap_word(cell: &str) -> bool {
    let word = cell.trim_start_matches(['+', '-']).trim_start_matches('#').trim();
    cell.chars().all(|c| "-–—.*".contains(c))
        || GAPS.iter().any(|gap| gap.eq_ignore_ascii_case(word))
}
