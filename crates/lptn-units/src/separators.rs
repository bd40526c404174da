//! Numbers as they are written by hand: `0,5`, `1,000`, `1.000,5`, `1 000`, `1'000`.

use std::ops::Range;

use crate::error::{UnitError, UnitErrorKind};
use crate::expr::Expression;
use crate::format::number as format_number;
use crate::number::{self, Number};
use crate::quantity;

/// Longer texts get no proposal: each proposal is read again to check it.
const LONGEST: usize = 200;

/// Refuses a number with other separators than one decimal point, and shows it without.
pub(crate) fn check(text: &str, number: &Number) -> Result<(), UnitError> {
    let Some(run) = Run::at(text, &number.span) else { return Ok(()) };
    let kind = if run.marks.contains(&',') {
        let (decimal, thousands) = (run.decimal(), run.thousands());
        UnitErrorKind::DecimalComma {
            decimal: decimal.and_then(|digits| run.proposal(text, &digits)),
            thousands: thousands.and_then(|digits| run.proposal(text, &digits)),
        }
    } else {
        let digits = run.decimal().or_else(|| run.thousands());
        UnitErrorKind::DigitGroups { fix: digits.and_then(|digits| run.proposal(text, &digits)) }
    };
    Err(UnitError::new(kind, run.first.clone()))
}

/// Refuses `3/8 in`, `1 1/2 in` and `1-1/2 in`, which mean 0.375 and 1.5 of a unit but would be a
/// number over a unit as an expression.
pub(crate) fn check_fraction(text: &str, first: &Number) -> Result<(), UnitError> {
    let Some((value, end)) = fraction_at(text, first).filter(|_| text.len() <= LONGEST) else {
        return Ok(());
    };
    let fix = format!("{} {}", format_number(value), text.get(end..).unwrap_or_default().trim());
    // without a unit it is a quotient, and the rest of an expression may follow
    if quantity::read(&fix).is_err() || text.get(end..).is_none_or(|unit| unit.trim().is_empty()) {
        return Ok(());
    }
    Err(UnitError::new(UnitErrorKind::Fraction { fix }, first.span.start..end))
}

/// The value of the fraction that begins with this number, and its end.
fn fraction_at(text: &str, first: &Number) -> Option<(f64, usize)> {
    if let Some((below, end)) = divisor(text, first.span.end) {
        return Some((first.value / below, end));
    }
    let rest = text.get(first.span.end..)?;
    let between = rest.trim_start_matches([' ', '-', '+']);
    let at = text.len() - between.len();
    // `1 - 1/2` is a difference
    let joint = text.get(first.span.end..at)?;
    let joined = joint == "-" || (!joint.is_empty() && matches!(joint.trim(), "" | "+"));
    let above = number::scan(text, at, false)
        .ok()?
        .filter(|above| joined && above.value.fract().abs() == 0.0)?;
    let (below, end) = divisor(text, above.span.end)?;
    let part = above.value / below;
    let proper = part < 1.0 && first.value.fract().abs() == 0.0;
    proper.then_some((first.value + part.copysign(first.value), end))
}

/// A positive number after a bar, and its end.
fn divisor(text: &str, at: usize) -> Option<(f64, usize)> {
    let rest = text.get(at..)?.trim_start().strip_prefix(['/', '⁄'])?.trim_start();
    let number = number::scan(text, text.len() - rest.len(), false).ok()??;
    let sound = number.value > 0.0 && number.value.is_finite();
    sound.then_some((number.value, number.span.end))
}

/// Digits with separators.
struct Run<'a> {
    span: Range<usize>,
    groups: Vec<&'a str>,
    /// The separators between the groups.
    marks: Vec<char>,
    /// The first separator that is not a decimal point.
    first: Range<usize>,
}

impl<'a> Run<'a> {
    /// The run that begins with this number; `None` if it is written correctly.
    fn at(text: &'a str, number: &Range<usize>) -> Option<Self> {
        let sign = text.get(number.clone())?.find(|c: char| c.is_ascii_digit() || c == '.')?;
        let start = number.start + sign;
        if is_plain(text.get(start..)?) {
            return None;
        }
        let mut end = start + digits(text.get(start..)?);
        let (mut groups, mut marks) = (vec![text.get(start..end)?], Vec::new());
        let mut first: Option<Range<usize>> = None;
        while let Some(mark) = text.get(end..).and_then(|rest| rest.chars().next()) {
            let next = end + mark.len_utf8();
            let length = digits(text.get(next..)?);
            if !separates(mark, length) {
                break;
            }
            if mark != '.' || marks.contains(&'.') {
                first.get_or_insert(end..next);
            }
            groups.push(text.get(next..next + length)?);
            marks.push(mark);
            end = next + length;
        }
        Some(Self { span: start..end, groups, marks, first: first? })
    }

    /// The digits with a decimal point for the last separator.
    fn decimal(&self) -> Option<String> {
        let (mark, before) = self.marks.split_last()?;
        let (fraction, whole) = self.groups.split_last()?;
        let is_point = matches!(mark, ',' | '.') && !before.contains(mark);
        (is_point && (before.is_empty() || in_thousands(whole, before)))
            .then(|| format!("{}.{fraction}", whole.concat()))
    }

    /// The digits without separators.
    fn thousands(&self) -> Option<String> {
        in_thousands(&self.groups, &self.marks).then(|| self.groups.concat())
    }

    /// The text with these digits, or with further corrections, if it can be read then.
    fn proposal(&self, text: &str, digits: &str) -> Option<String> {
        if text.len() > LONGEST {
            return None;
        }
        let (before, after) = (text.get(..self.span.start)?, text.get(self.span.end..)?);
        let fixed = format!("{before}{digits}{after}").trim().to_owned();
        match quantity::read(&fixed).err().map(|error| error.kind) {
            None => Some(fixed),
            Some(UnitErrorKind::UnknownUnit { fix: Some(fix), .. }) => Some(fix),
            Some(UnitErrorKind::DecimalComma { decimal: Some(fix), thousands: None }) => Some(fix),
            Some(_) => Expression::parse(&fixed).is_ok().then_some(fixed),
        }
    }
}

/// `7.7*10^-3 K/W` and `7.7x10-3 K/W` as `7.7e-3 K/W`, if that is a quantity.
pub(crate) fn power_of_ten(text: &str) -> Option<String> {
    let text = text.trim();
    let at =
        text.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).filter(|&at| at > 0)?;
    let (mantissa, rest) = text.split_at_checked(at)?;
    let rest = rest
        .trim_start()
        .strip_prefix(['*', 'x', 'X', '×', '·', '⋅'])?
        .trim_start()
        .strip_prefix("10")?;
    let rest = rest.strip_prefix("**").or_else(|| rest.strip_prefix('^')).unwrap_or(rest);
    let exponent =
        rest.find(|c: char| !(c.is_ascii_digit() || "+-()".contains(c))).unwrap_or(rest.len());
    let (exponent, unit) = rest.split_at_checked(exponent)?;
    let fixed = format!("{mantissa}e{}{unit}", exponent.trim_matches(['(', ')']));
    (text.len() <= LONGEST && quantity::read(&fixed).is_ok()).then_some(fixed)
}

fn digits(text: &str) -> usize {
    text.bytes().position(|b| !b.is_ascii_digit() && b != b'_').unwrap_or(text.len())
}

/// True if no separator follows the digits that the text begins with, apart from one point.
fn is_plain(text: &str) -> bool {
    let fraction = |rest: &str| rest.strip_prefix('.').map_or(0, digits);
    let whole = digits(text);
    let rest = text.get(whole..).unwrap_or_default();
    let end = match fraction(rest) {
        0 => 0,
        digits => 1 + digits,
    };
    let rest = rest.get(end..).unwrap_or_default();
    rest.chars().next().is_none_or(|mark| !separates(mark, digits(&rest[mark.len_utf8()..])))
}

/// True if this can be between digits, with `after` digits after it. A space needs three: `5 1/s`
/// is a quantity.
fn separates(mark: char, after: usize) -> bool {
    match mark {
        ',' | '.' => after > 0,
        '\'' | '’' | ' ' | '\u{a0}' | '\u{2009}' | '\u{202f}' => after == 3,
        _ => false,
    }
}

/// `1`, `000`, `000` with the same separator between them.
fn in_thousands(groups: &[&str], marks: &[char]) -> bool {
    let Some((first, rest)) = groups.split_first() else { return false };
    (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && rest.iter().all(|group| group.len() == 3)
        && marks.windows(2).all(|pair| pair[0] == pair[1])
}
