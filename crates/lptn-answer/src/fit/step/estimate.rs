//! Numbers with their errors, for reading.

use lptn_report::{fixed, significant};

/// Digits of a number whose error is not known.
const DIGITS: usize = 6;

/// `810.3 ± 3.1`: the error with two digits, the number with as many decimals.
pub(super) fn with_error(value: f64, error: f64) -> String {
    match decimals(value, error) {
        Some(decimals) => format!("{} ± {}", fixed(value, decimals), fixed(error, decimals)),
        None => significant(value, DIGITS),
    }
}

/// The number with as many decimals as its error has.
pub(super) fn to_error(value: f64, error: f64) -> String {
    decimals(value, error)
        .map_or_else(|| significant(value, DIGITS), |decimals| fixed(value, decimals))
}

/// Decimals that show two digits of an error; `None` if it is 0, not known, or rounding.
/// Rounding is that of the number, or of its record, which has fewer than ten digits.
fn decimals(value: f64, error: f64) -> Option<usize> {
    if !(error.is_finite() && error > 1e-9 && error > 1e-8 * value.abs()) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = error.log10().floor() as i32;
    usize::try_from(1 - exponent).ok().or(Some(0))
}

#[cfg(test)]
mod tests {
    use super::with_error;

    #[test]
    fn errors_have_two_digits() {
        assert_eq!(with_error(810.312, 3.12), "810.3 ± 3.1");
        assert_eq!(with_error(0.304_62, 0.001_23), "0.3046 ± 0.0012");
        assert_eq!(with_error(2204.6, 133.0), "2205 ± 133");
        assert_eq!(with_error(92.7, 0.0), "92.7");
        assert_eq!(with_error(92.7, f64::NAN), "92.7");
        assert_eq!(with_error(809.999_999_08, 3.9e-7), "810");
    }
}
