//! Cells in which nothing was measured.

/// Words for a value that was not measured: none, outside of the range, a broken sensor.
const GAPS: [&str; 25] = [
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
    "open tc",
    "invalid",
    "error",
    "fault",
];

/// The number that instruments send for infinity, 9.9E37, if a value is outside of the range.
///
/// Source: SCPI 1999.0, volume 1, section 7.2.1 (`INFinity`; 9.91E37 is `NAN`).
pub(crate) const OVERLOAD: f64 = 9.9e37;

/// True for a number that is none: infinity or NaN of SCPI.
pub(crate) fn is_overload(number: f64) -> bool {
    [OVERLOAD, 9.91e37].iter().any(|one| (number.abs() - one).abs() < 1e-9 * OVERLOAD)
}

/// True for dashes, points, the words of [`GAPS`], and the numbers of SCPI for an overload.
pub(crate) fn is_gap_word(cell: &str) -> bool {
    let word = cell.trim_start_matches(['+', '-']).trim_start_matches('#').trim();
    cell.chars().all(|c| "-–—.*".contains(c))
        || cell.parse::<f64>().is_ok_and(is_overload)
        || GAPS.iter().any(|gap| gap.eq_ignore_ascii_case(word))
}
