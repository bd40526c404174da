//! Numbers as text: exact for files, rounded for reading.

/// Writes numbers as the shortest text that reads back as the same `f64`: `92.7`, `300`, `1e-7`.
#[derive(Default)]
pub struct Shortest {
    buffer: zmij::Buffer,
}

impl Shortest {
    /// A writer; it is reused, so that writing a number allocates nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// The text of `value`; `NaN`, `inf` and `-inf` if it is not finite.
    pub fn text(&mut self, value: f64) -> &str {
        let text = self.buffer.format(value);
        text.strip_suffix(".0").unwrap_or(text)
    }
}

/// From this size on, digits before the point mean nothing to a reader.
const HUGE: f64 = 1e12;

/// `value` with `decimals` digits after the point, never `-0.0`.
/// From 1e12 on it has an exponent.
pub fn fixed(value: f64, decimals: usize) -> String {
    if value.abs() >= HUGE {
        return significant(value, 4);
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| matches!(c, '0' | '.')) => zero.to_owned(),
        _ => text,
    }
}

/// Decimals that show `span` with `digits` significant digits, from `least` to 9.
pub fn decimals(span: f64, digits: i32, least: usize) -> usize {
    let size = span.abs();
    if !(size.is_finite() && size > 0.0) {
        return least;
    }
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = (size.log10() + 1e-12).floor() as i32;
    usize::try_from(digits - 1 - exponent).unwrap_or(0).clamp(least, 9.max(least))
}

/// `value` rounded to `digits` significant digits, without trailing zeros.
/// It has an exponent below 1e-3 and from 1e6 on.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return Shortest::new().text(value).to_owned();
    }
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value);
    if rounded == 0.0 {
        return "0".to_owned();
    }
    if (1e-3..1e6).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// The power of 1000 that brings `largest` to 1 … 1000, and its SI prefix.
pub fn prefix(largest: f64) -> (f64, &'static str) {
    const PREFIXES: [(f64, &str); 7] =
        [(1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "u")];
    let size = largest.abs();
    // 999.96 would be shown as 1000.0
    let fits = |scale: f64| size >= 0.9999 * scale;
    let found = PREFIXES.iter().find(|(scale, _)| fits(*scale)).copied();
    if size > 0.0 && size.is_finite() { found.unwrap_or((1e-6, "u")) } else { (1.0, "") }
}

/// A time in s as text in a suitable unit: `25 min`, `39.5 min`, `2.5 h`.
/// It has up to `digits` significant digits.
pub fn duration(seconds: f64, digits: usize) -> String {
    const UNITS: [(f64, f64, &str); 6] = [
        (172_800.0, 86_400.0, "d"),
        (7200.0, 3600.0, "h"),
        (120.0, 60.0, "min"),
        (1.0, 1.0, "s"),
        (1e-3, 1e-3, "ms"),
        (0.0, 1e-6, "us"),
    ];
    let size = seconds.abs();
    if size == 0.0 || !size.is_finite() {
        return format!("{} s", significant(seconds, digits));
    }
    let unit = UNITS.iter().find(|(from, _, _)| size >= *from).unwrap_or(&UNITS[3]);
    format!("{} {}", significant(seconds / unit.1, digits), unit.2)
}

/// A bound with two digits, its last one rounded up.
pub fn rounded_up(bound: f64) -> String {
    const DIGITS: usize = 2;
    let text = significant(bound, DIGITS);
    if text.parse::<f64>().is_ok_and(|shown| shown < bound) {
        let last = 10f64.powi(bound.log10().floor() as i32 - 1);
        return significant((bound / last).ceil() * last, DIGITS);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_read_well() {
        let mut writer = Shortest::new();
        for (value, text) in
            [(92.7, "92.7"), (300.0, "300"), (1e-7, "1e-7"), (-0.5, "-0.5"), (0.0, "0")]
        {
            assert_eq!(writer.text(value), text);
        }
        assert_eq!(writer.text(f64::NAN), "NaN");
    }

    #[test]
    fn exact_numbers_read_back() {
        let mut writer = Shortest::new();
        for value in
            [0.1 + 0.2, f64::MIN_POSITIVE, 5e-324, f64::MAX, -1.0 / 3.0, 92.699_999_999_999_99]
        {
            let back: f64 = writer.text(value).parse().unwrap();
            assert_eq!(back.to_bits(), value.to_bits());
        }
    }

    #[test]
    fn fixed_has_no_negative_zero() {
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(fixed(-0.06, 1), "-0.1");
        assert_eq!(fixed(92.699_99, 1), "92.7");
    }

    #[test]
    fn decimals_follow_the_span() {
        assert_eq!(decimals(67.2, 3, 1), 1);
        assert_eq!(decimals(6.72, 3, 1), 2);
        assert_eq!(decimals(0.0672, 3, 1), 4);
        assert_eq!(decimals(672.0, 3, 1), 1);
        assert_eq!(decimals(1000.0, 4, 0), 0);
        assert_eq!(decimals(0.0, 3, 1), 1);
        assert_eq!(decimals(f64::NAN, 3, 1), 1);
    }

    #[test]
    fn significant_digits() {
        assert_eq!(significant(330.916, 4), "330.9");
        assert_eq!(significant(25.0, 3), "25");
        assert_eq!(significant(0.000_123_4, 2), "1.2e-4");
        assert_eq!(significant(1_234_567.0, 2), "1.2e6");
        assert_eq!(significant(0.0, 2), "0");
        assert_eq!(significant(f64::INFINITY, 2), "inf");
    }

    #[test]
    fn prefixes() {
        assert_eq!(prefix(330_916.0), (1e3, "k"));
        assert_eq!(prefix(999.96), (1e3, "k"));
        assert_eq!(prefix(0.02), (1e-3, "m"));
        assert_eq!(prefix(0.0), (1.0, ""));
        assert_eq!(prefix(-5e6), (1e6, "M"));
    }

    #[test]
    fn durations() {
        assert_eq!(duration(1500.0, 3), "25 min");
        assert_eq!(duration(2370.0, 3), "39.5 min");
        assert_eq!(duration(90.0, 3), "90 s");
        assert_eq!(duration(7200.0, 3), "2 h");
        assert_eq!(duration(259_200.0, 3), "3 d");
        assert_eq!(duration(0.005, 3), "5 ms");
        assert_eq!(duration(0.0, 3), "0 s");
        assert_eq!(duration(2e-5, 3), "20 us");
    }
}
