//! Numbers as text.

/// The shortest text that reads back as the same `f64`: `0.5`, `1e-5`, `8.7e-5`, `300`.
///
/// Scientific notation is used below 1e-4 and from 1e6 on.
pub fn number(value: f64) -> String {
    let size = value.abs();
    let plain = size == 0.0 || (1e-4..1e6).contains(&size) || !size.is_finite();
    if plain { format!("{value}") } else { format!("{value:e}") }
}

/// Rounds to `digits` significant decimal digits, so that a number computed for a help text shows
/// no noise of binary arithmetic: 50.00000000000001 becomes 50.
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    text.parse().map_or(text, number)
}

/// A number with ten digits at most, without the noise of binary arithmetic, for a message.
pub fn short(value: f64) -> String {
    rounded(value, 10)
}

/// A number as a message shows it: six digits are enough to find the place.
pub fn six(value: f64) -> String {
    rounded(value, 6)
}

#[cfg(test)]
mod tests {
    use super::{number, rounded};

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(0.5), "0.5");
        assert_eq!(number(1e-5), "1e-5");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(123_456.0), "123456");
        assert_eq!(number(-2.5e9), "-2.5e9");
    }

    #[test]
    fn rounding_removes_binary_noise() {
        assert_eq!(rounded(0.1 + 0.2, 12), "0.3");
    }
}
