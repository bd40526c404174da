//! Numbers in text: `5`, `-0.3`, `8.7e-5`, `1_000`.

use std::borrow::Cow;
use std::ops::Range;

use crate::error::{UnitError, UnitErrorKind};
use crate::rational::Rational;

/// A number with its place.
#[derive(Clone, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) span: Range<usize>,
}

impl Number {
    /// The same without rounding, if it is short enough; `text` is the text it was read from.
    pub(crate) fn exact(&self, text: &str) -> Option<Rational> {
        let written = text.get(self.span.clone())?;
        let exact = Rational::from_decimal(&plain(false, written.get(sign(written).1..)?))?;
        if self.value < 0.0 { exact.checked_neg() } else { Some(exact) }
    }
}

/// Reads the number at byte `at`; `None` if there is none. A sign counts only if `signed`.
pub(crate) fn scan(text: &str, at: usize, signed: bool) -> Result<Option<Number>, UnitError> {
    let rest = text.get(at..).unwrap_or_default();
    let (negative, sign_length) = if signed { sign(rest) } else { (false, 0) };
    let length = unsigned_length(rest.get(sign_length..).unwrap_or_default());
    if length == 0 {
        return Ok(None);
    }
    let end = sign_length + length;
    let plain = plain(negative, rest.get(sign_length..end).unwrap_or_default());
    let span = at..at + end;
    let out_of_range = || {
        let number = rest.get(..end).unwrap_or_default().to_owned();
        UnitError::new(UnitErrorKind::OutOfRange { number }, span.clone())
    };
    let value: f64 = plain.parse().map_err(|_| out_of_range())?;
    let mantissa = || plain.bytes().take_while(|byte| !matches!(byte, b'e' | b'E'));
    let vanished = || mantissa().any(|byte| (b'1'..=b'9').contains(&byte));
    if !value.is_finite() || (value == 0.0 && vanished()) {
        return Err(out_of_range());
    }
    Ok(Some(Number { value, span }))
}

/// The number in the form that every reader of numbers accepts.
fn plain(negative: bool, digits: &str) -> Cow<'_, str> {
    match (negative, digits.contains('_')) {
        (false, false) => digits.into(),
        (false, true) => digits.replace('_', "").into(),
        (true, _) => format!("-{}", digits.replace('_', "")).into(),
    }
}

/// True for a minus, and the length of the sign in bytes. The typographic minus counts.
fn sign(text: &str) -> (bool, usize) {
    match text.chars().next() {
        Some('+') => (false, 1),
        Some(minus @ ('-' | '\u{2212}')) => (true, minus.len_utf8()),
        _ => (false, 0),
    }
}

/// Length of `digits [. digits] [e [sign] digits]`, 0 if there is no digit.
fn unsigned_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let whole = digits_length(bytes);
    let mut end = whole;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits_length(bytes.get(end + 1..).unwrap_or_default());
        if whole + fraction == 0 {
            return 0;
        }
        end += 1 + fraction;
    }
    if end == 0 { 0 } else { end + exponent_length(bytes.get(end..).unwrap_or_default()) }
}

/// Digits with single underscores between them.
fn digits_length(bytes: &[u8]) -> usize {
    let is_digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let mut end = 0;
    while is_digit(end) || (end > 0 && bytes.get(end) == Some(&b'_') && is_digit(end + 1)) {
        end += 1;
    }
    end
}

/// An `e` without digits after it begins a name, not an exponent.
fn exponent_length(bytes: &[u8]) -> usize {
    if !matches!(bytes.first(), Some(b'e' | b'E')) {
        return 0;
    }
    let sign = usize::from(matches!(bytes.get(1), Some(b'+' | b'-')));
    match digits_length(bytes.get(1 + sign..).unwrap_or_default()) {
        0 => 0,
        digits => 1 + sign + digits,
    }
}
