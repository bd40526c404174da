//! Proposes the unit that was probably meant by a text that is none.

use crate::unit_parser::{self, superscript};
use crate::unit_table;

/// Texts longer than this are not a unit with a slip of the pen.
const LONGEST: usize = 200;

/// The corrected unit: exponents raised (`m2` to `m^2`), brackets after the bar, near names replaced.
/// `None` when no correction reads as a unit.
pub(crate) fn unit(text: &str) -> Option<String> {
    if text.len() > LONGEST {
        return None;
    }
    let mut repaired = String::new();
    for (i, part) in split(text.trim(), |c| c == '/').iter().enumerate() {
        let words = words(part)?;
        let product = words.join(" ");
        match i {
            0 => repaired = product,
            _ if words.len() > 1 => repaired.push_str(&format!("/({product})")),
            _ => repaired.push_str(&format!("/{product}")),
        }
    }
    unit_parser::parse(&repaired).ok().map(|_| repaired)
}

/// The factors of a product, each corrected.
fn words(part: &str) -> Option<Vec<String>> {
    let part = part.trim();
    let inner = part.strip_prefix('(').and_then(|p| p.strip_suffix(')')).unwrap_or(part);
    let mut corrected = Vec::new();
    for text in split(inner, |c| c.is_whitespace() || matches!(c, '*' | '·' | '⋅' | '×')) {
        if !text.is_empty() {
            corrected.extend(word(text)?);
        }
    }
    Some(corrected)
}

/// Splits outside brackets.
fn split(text: &str, separates: impl Fn(char) -> bool) -> Vec<&str> {
    let mut depth = 0_i32;
    text.split(|c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth == 0 && separates(c)
    })
    .collect()
}

/// One factor, or several if they were run together: `m2K` is `m^2` and `K`.
fn word(text: &str) -> Option<Vec<String>> {
    // More than one name in a factor would multiply after the bar: `m²K`.
    if unit_parser::parse(text).is_ok_and(|unit| unit.names.len() == 1) {
        return Some(vec![text.to_owned()]);
    }
    let mut rest = text;
    let mut found = Vec::new();
    while !rest.is_empty() {
        let end = rest.find(|c: char| !unit_parser::is_name_start(c)).unwrap_or(rest.len());
        let (name, tail) = rest.split_at_checked(end)?;
        let (exponent, tail) = exponent(tail)?;
        found.push(format!("{}{exponent}", known(name)?));
        rest = tail;
    }
    Some(found)
}

fn known(name: &str) -> Option<String> {
    let plain = unit_table::plain_name(name);
    match unit_table::find(&plain) {
        Some(_) => Some(name.to_owned()),
        None => unit_table::meant(&plain).map(str::to_owned),
    }
}

/// An exponent at the start of `text`, with or without its `^`, and what follows it.
fn exponent(text: &str) -> Option<(String, &str)> {
    let (body, has_caret) = match text.strip_prefix('^').or_else(|| text.strip_prefix("**")) {
        Some(body) => (body, true),
        None => (text, false),
    };
    let length = if body.starts_with('(') {
        body.find(')')? + 1
    } else {
        let belongs =
            |c: char| c.is_ascii_digit() || superscript(c).is_some() || matches!(c, '-' | '+' | '.');
        body.find(|c: char| !belongs(c)).unwrap_or(body.len())
    };
    let (digits, tail) = body.split_at_checked(length)?;
    match (digits.is_empty(), has_caret, digits.starts_with(|c| superscript(c).is_some())) {
        (true, true, _) => None,
        (true, false, _) | (false, false, true) => Some((digits.to_owned(), tail)),
        _ => Some((format!("^{digits}"), tail)),
    }
}
