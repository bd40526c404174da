//! Proposes the unit that was probably meant by an invalid text.

use crate::unit_parser::{self, MILLIKELVIN, is_name_start, superscript};
use crate::unit_table;

/// Texts longer than this are not a unit with a slip of the pen.
const LONGEST: usize = 200;

/// Torques as they are said in the order of the words, which would read as a mass times a length.
const TORQUES: [(&str, [&str; 4]); 2] = [
    ("lbf ft", ["ft-lb", "lb-ft", "ftlb", "lbft"]),
    ("lbf in", ["in-lb", "lb-in", "inlb", "lbin"]),
];

/// The corrected unit: exponents raised (`m2` to `m^2`), brackets after the bar, near names
/// replaced. `None` when no correction reads as a unit.
pub(crate) fn unit(text: &str) -> Option<String> {
    if text.len() > LONGEST {
        return None;
    }
    if ["u/min", "r/min", "rot/min", "min-1"].contains(&text.trim().to_lowercase().as_str()) {
        return Some("rpm".to_owned());
    }
    let plain = text.trim().to_lowercase();
    let torque = TORQUES.iter().find(|(_, said)| said.contains(&plain.as_str()));
    if let Some((unit, _)) = torque {
        return Some((*unit).to_owned());
    }
    let text = without_dots(text).replace("**", "^").replace(" per ", "/");
    let mut repaired = String::new();
    for (i, part) in split(text.trim(), |c| c == '/').iter().enumerate() {
        let words = words(part, i > 0)?;
        let product = words.join(" ");
        match i {
            0 => repaired = product,
            _ if words.len() > 1 => repaired.push_str(&format!("/({product})")),
            _ => repaired.push_str(&format!("/{product}")),
        }
    }
    unit_parser::parse(&repaired).ok().map(|_| repaired)
}

/// `kg.K` and `kg-K` as `kg K`: a point or a hyphen before a letter multiplies.
fn without_dots(text: &str) -> String {
    let next = text.chars().skip(1).chain([' ']);
    text.chars()
        .zip(next)
        .map(|(c, next)| if matches!(c, '.' | '-') && is_name_start(next) { ' ' } else { c })
        .collect()
}

/// The factors of a product, each corrected.
fn words(part: &str, below: bool) -> Option<Vec<String>> {
    let part = part.trim();
    let inner = part.strip_prefix('(').and_then(|p| p.strip_suffix(')')).unwrap_or(part);
    let mut corrected = Vec::new();
    let factors = split(inner, |c| c.is_whitespace() || matches!(c, '*' | '·' | '⋅' | '×'));
    let mut factors = factors.into_iter().filter(|text| !text.is_empty()).peekable();
    while let Some(text) = factors.next() {
        match factors.peek().and_then(|scale| degrees(text, scale)) {
            Some(unit) => {
                factors.next();
                corrected.push(unit.to_owned());
            }
            None if below && text == MILLIKELVIN => {
                corrected.extend(["m", "K"].map(str::to_owned));
            }
            None => corrected.extend(word(text)?),
        }
    }
    Some(corrected)
}

/// `deg C` and `degrees Celsius`, which are not degrees of angle.
fn degrees(word: &str, scale: &str) -> Option<&'static str> {
    let degree = ["deg", "deg.", "degree", "degrees", "°", "º", "˚"];
    if !degree.contains(&word.to_lowercase().as_str()) {
        return None;
    }
    match scale.to_lowercase().as_str() {
        "c" | "celsius" | "centigrade" => Some("degC"),
        "f" | "fahrenheit" => Some("degF"),
        _ => None,
    }
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
        let mut at = rest.char_indices().skip(1);
        // a degree begins another factor: `g°C`
        let end = at.find(|(_, c)| !is_name_start(*c) || DEGREES.contains(c));
        let (name, tail) = rest.split_at_checked(end.map_or(rest.len(), |(end, _)| end))?;
        let (exponent, tail) = exponent(tail)?;
        let unit = known(name)?;
        let joined = unit_table::run_together(&unit_table::plain_name(name));
        if !exponent.is_empty() && (unit.contains('^') || unit.contains(' ') && joined.is_none()) {
            return None; // the power would be of a part
        }
        // of units that were run together the power is that of the last: `kgm2`
        let (first, last) = unit
            .rsplit_once(' ')
            .map_or((None, unit.as_str()), |(first, last)| (Some(first), last));
        found.extend(first.into_iter().flat_map(|first| first.split(' ')).map(str::to_owned));
        found.push(format!("{last}{exponent}"));
        rest = tail;
    }
    Some(found)
}

/// Signs with which a unit begins.
const DEGREES: [char; 5] = ['°', '˚', 'º', '℃', '℉'];

fn known(name: &str) -> Option<String> {
    let plain = unit_table::plain_name(name);
    match unit_table::find(&plain) {
        Some(_) => Some(name.to_owned()),
        None => unit_table::meant(&plain),
    }
}

/// An exponent at the start of `text`, with or without its `^`, and the rest.
fn exponent(text: &str) -> Option<(String, &str)> {
    let (body, has_caret) = match text.strip_prefix('^').or_else(|| text.strip_prefix("**")) {
        Some(body) => (body, true),
        None => (text, false),
    };
    let length = if body.starts_with('(') {
        body.find(')')? + 1
    } else {
        let belongs = |c: char| {
            c.is_ascii_digit() || superscript(c).is_some() || matches!(c, '-' | '+' | '.')
        };
        body.find(|c: char| !belongs(c)).unwrap_or(body.len())
    };
    let (digits, tail) = body.split_at_checked(length)?;
    match (digits.is_empty(), has_caret, digits.starts_with(|c| superscript(c).is_some())) {
        (true, true, _) => None,
        (true, false, _) | (false, false, true) => Some((digits.to_owned(), tail)),
        _ => Some((format!("^{digits}"), tail)),
    }
}
