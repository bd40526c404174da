//! A string of the netlist: quantity or expression.

use std::ops::Range;

use crate::bracket::bracketed;
use crate::error::{UnitError, UnitErrorKind};
use crate::expr::Expression;
use crate::quantity::{self, Quantity, Reading};
use crate::separators;
use crate::types::Type;
use crate::unit_parser::is_name_start;

/// The reading of a string.
#[derive(Clone, Debug)]
pub enum Written {
    /// A number with a unit, `0.3 K/W`.
    Quantity(Quantity),
    /// Anything else: `2 * G_out`.
    Expression(Expression),
}

/// Reads a string that is either a quantity or an expression. A string that reads as a quantity is
/// never an expression.
///
/// `expected` is the type of the field, if known; only a quantity is checked against it here, an
/// expression is when it is compiled. `is_parameter` is true for the names of parameters in scope.
///
/// # Errors
///
/// If neither reading succeeds, the error of the more probable one. `2 * m` is an error if `m` is a
/// parameter, because both readings succeed; units without brackets in an expression are an error
/// that shows the brackets.
pub fn parse_value(
    text: &str,
    expected: Option<Type>,
    is_parameter: &dyn Fn(&str) -> bool,
) -> Result<Written, UnitError> {
    let plain = match quantity::read_plainly(text) {
        Ok(reading) => return settle(text, &reading, expected, is_parameter),
        Err(error) => error,
    };
    let as_expression = match Expression::parse(text) {
        Ok(expression) if !is_word(text, &plain) => return Ok(Written::Expression(expression)),
        other => other.err(),
    };
    let error = quantity::read(text).err().unwrap_or(plain);
    let as_quantity = quantity::of_quantity(error, expected);
    Err(match as_expression {
        Some(as_expression) => more_helpful(text, as_quantity, as_expression, is_parameter),
        None => as_quantity,
    })
}

/// `nan` and `inf` are not names.
fn is_word(text: &str, error: &UnitError) -> bool {
    let word = text.trim().trim_start_matches(['+', '-']);
    let UnitErrorKind::NotFinite { text } = &error.kind else { return false };
    word.eq_ignore_ascii_case(text)
}

fn settle(
    text: &str,
    reading: &Reading<'_>,
    expected: Option<Type>,
    is_parameter: &dyn Fn(&str) -> bool,
) -> Result<Written, UnitError> {
    let parameter = reading.unit_names().find(|(name, _)| is_parameter(name));
    if let Some((name, span)) = parameter
        && Expression::parse(text).is_ok()
    {
        return Err(two_readings(reading, name, span));
    }
    reading.conclude(expected).map(Written::Quantity)
}

fn two_readings(reading: &Reading<'_>, name: &str, span: Range<usize>) -> UnitError {
    let kind = UnitErrorKind::TwoReadings {
        name: name.to_owned(),
        quantity: reading.as_plain_quantity(),
        expression: format!("({})", reading.plain_text()),
    };
    UnitError::new(kind, span)
}

fn more_helpful(
    text: &str,
    as_quantity: UnitError,
    as_expression: UnitError,
    is_parameter: &dyn Fn(&str) -> bool,
) -> UnitError {
    if let Some(error) = missing_operator(text, &as_quantity, is_parameter) {
        return error;
    }
    if matches!(as_quantity.kind, UnitErrorKind::Fraction { .. })
        && !mentions_parameter(text, is_parameter)
    {
        return as_quantity;
    }
    if matches!(as_expression.kind, UnitErrorKind::AmbiguousSign { .. }) {
        return as_expression;
    }
    let separated = matches!(
        as_quantity.kind,
        UnitErrorKind::DecimalComma { .. } | UnitErrorKind::DigitGroups { .. }
    );
    // `3,000` alone
    if separated && !text.contains(is_name_start) && as_quantity.help().is_some() {
        return as_quantity;
    }
    if let Some(fix) = separators::power_of_ten(text) {
        let span = 0..text.len();
        return UnitError::new(UnitErrorKind::PowerOfTen { fix }, span);
    }
    let has_fix = as_quantity.help().is_some();
    if looks_like_quantity(text) && has_fix && !mentions_parameter(text, is_parameter) {
        return as_quantity;
    }
    if let Some((fix, span)) = bracketed(text, is_parameter) {
        return UnitError::new(UnitErrorKind::UnbracketedUnit { fix }, span);
    }
    if looks_like_quantity(text)
        || matches!(as_quantity.kind, UnitErrorKind::Empty | UnitErrorKind::NotFinite { .. })
    {
        return as_quantity;
    }
    as_expression
}

/// `2 P`, if `P` is a parameter.
fn missing_operator(
    text: &str,
    error: &UnitError,
    is_parameter: &dyn Fn(&str) -> bool,
) -> Option<UnitError> {
    let UnitErrorKind::UnknownUnit { name, .. } = &error.kind else { return None };
    let (before, after) = text.split_at_checked(error.span.start).filter(|_| is_parameter(name))?;
    let fix = format!("{} * {after}", before.trim_end()).trim().to_owned();
    Expression::parse(&fix).ok()?;
    Some(UnitError::new(
        UnitErrorKind::MissingOperator { name: name.clone(), fix },
        error.span.clone(),
    ))
}

fn mentions_parameter(text: &str, is_parameter: &dyn Fn(&str) -> bool) -> bool {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').any(is_parameter)
}

/// A number, then only parts of units; `+` and `-` only in `±` and exponents.
fn looks_like_quantity(text: &str) -> bool {
    let text = text.trim();
    let Ok(Some(number)) = crate::number::scan(text, 0, true) else {
        let bare = text.trim_start_matches(['+', '-', '.']);
        return bare.starts_with(|c: char| c.is_ascii_digit());
    };
    let rest = text.get(number.span.end..).unwrap_or_default();
    let rest = rest.replace("+-", "±").replace("+/-", "±");
    // Without a single letter it is arithmetic.
    if !rest.contains(is_name_start) {
        return rest.trim_start().starts_with('±');
    }
    let has_operator = rest.contains(" + ") || rest.contains(" - ");
    !has_operator && !rest.contains(['[', ']', '<', '>', '=', '!', '+'])
}
