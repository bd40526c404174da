//! Puts the brackets that an expression lacks around its units.

use std::ops::Range;

use crate::expr::{Expression, NoNames};
use crate::number;
use crate::repair;
use crate::unit_parser::is_name_start;
use crate::unit_table;

/// `20 W/K + 60 W/K * fan` as `20 [W/K] + 60 [W/K] * fan`, and the place of the first unit; `None`
/// if no number is followed by a unit, or brackets do not make it an expression.
pub(crate) fn bracketed(
    text: &str,
    is_parameter: &dyn Fn(&str) -> bool,
) -> Option<(String, Range<usize>)> {
    let mut result = String::new();
    let mut first = None;
    let mut at = 0;
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        let in_name =
            text.get(..at).is_some_and(|t| t.ends_with(|c: char| c.is_alphanumeric() || c == '_'));
        let number = if in_name { None } else { number::scan(text, at, false).ok()? };
        let Some(number) = number else {
            result.push(c);
            at += c.len_utf8();
            continue;
        };
        let start = skip_space(text, number.span.end);
        let end = unit_end(text, start, is_parameter);
        result.push_str(text.get(number.span.clone())?);
        at = number.span.end;
        if end > start {
            let unit = repair::unit(text.get(start..end)?)?;
            let unit = if is_added_to_temperature(text, number.span.start) {
                difference(&unit)
            } else {
                &unit
            };
            result.push_str(&format!(" [{unit}]"));
            first.get_or_insert(start..end);
            at = end;
        }
    }
    let expression = Expression::parse(&result).ok()?;
    // without names its correctness can be checked
    let constant = expression.names().is_empty() && expression.calls().is_empty();
    if constant && expression.compile(&NoNames, None).is_err() {
        return None;
    }
    first.map(|span| (result.trim().to_owned(), span))
}

/// True if the number at this byte is added to a name that looks like a temperature:
/// `T_amb + 5 degC`.
fn is_added_to_temperature(text: &str, number: usize) -> bool {
    let before = text.get(..number).unwrap_or_default().trim_end();
    let Some(before) = before.strip_suffix('+') else { return false };
    let name =
        before.trim_end().rsplit(|c: char| !(c.is_alphanumeric() || "_.[]".contains(c))).next();
    name.is_some_and(|name| name == "T" || name.starts_with("T_") || name.ends_with(".T"))
}

/// The unit of a temperature difference for that of a temperature.
fn difference(unit: &str) -> &str {
    match unit {
        "degC" => "K",
        "degF" => "degR",
        other => other,
    }
}

fn skip_space(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + rest.len() - rest.trim_start().len()
}

/// End of the longest run of units from `at` on.
fn unit_end(text: &str, at: usize, is_parameter: &dyn Fn(&str) -> bool) -> usize {
    let mut end = at;
    let mut next = at;
    while let Some(after) = factor_end(text, next, is_parameter) {
        end = after;
        let joint = skip_space(text, after);
        let symbol = text.get(joint..).and_then(|rest| rest.chars().next());
        next = match symbol {
            Some(c @ ('/' | '*' | '·')) => skip_space(text, joint + c.len_utf8()),
            _ => joint,
        };
    }
    end
}

/// End of one unit with its exponent, or of a group in brackets, if there is one here.
fn factor_end(text: &str, at: usize, is_parameter: &dyn Fn(&str) -> bool) -> Option<usize> {
    let rest = text.get(at..)?;
    let base = if rest.starts_with('(') {
        let end = rest.find(')')? + 1;
        crate::unit_parser::parse(rest.get(..end)?).ok()?;
        end
    } else {
        name_length(rest, is_parameter)?
    };
    let tail = rest.get(base..)?;
    Some(at + base + exponent_length(tail))
}

fn name_length(rest: &str, is_parameter: &dyn Fn(&str) -> bool) -> Option<usize> {
    let length =
        rest.find(|c: char| !is_name_start(c) && !c.is_ascii_digit()).unwrap_or(rest.len());
    let name = rest.get(..length)?;
    let is_call = rest.get(length..)?.starts_with('(');
    if !name.starts_with(is_name_start) || is_call || is_parameter(name) {
        return None;
    }
    let known = unit_table::find(&unit_table::plain_name(name)).is_some();
    let run_together = name.chars().any(|c| c.is_ascii_digit()) && repair::unit(name).is_some();
    (known || run_together).then_some(length)
}

fn exponent_length(tail: &str) -> usize {
    let Some(body) = tail.strip_prefix('^') else {
        return tail.find(|c| crate::unit_parser::superscript(c).is_none()).unwrap_or(tail.len());
    };
    let length = match body.find(')') {
        Some(close) if body.starts_with('(') => close + 1,
        _ => body
            .find(|c: char| !c.is_ascii_digit() && !matches!(c, '-' | '.'))
            .unwrap_or(body.len()),
    };
    1 + length
}
