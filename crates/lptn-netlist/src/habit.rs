//! The probable meaning of a line that is not TOML: habits of other notations, which the parser
//! reports in a place after their cause.

use lptn_data::{Diagnostic, FileId, Span};
use lptn_units::parse_quantity;

use crate::format::NetlistFormat;
use crate::toml_1_1::string_length;

/// Longer lines were not written by hand.
const LONGEST: usize = 2000;

/// Explains a broken line by the first habit found in it.
pub(crate) fn explain(
    (start, line): &(usize, &str),
    (file, format): (FileId, &NetlistFormat),
    message: &str,
) -> Option<Diagnostic> {
    if line.len() > LONGEST {
        return None;
    }
    let place = |at: usize, length: usize| Span::new(file, start + at..start + at + length);
    let (mut at, mut in_table) = (0, false);
    while let Some(rest) = line.get(at..).filter(|rest| !rest.is_empty()) {
        let letter = rest.chars().next()?;
        match letter {
            '"' | '\'' => {
                at += string_length(rest);
                continue;
            }
            '#' => return None,
            '{' => in_table = true,
            ';' if in_table => return Some(semicolon(place(at, 1))),
            '=' => {
                let value = Value::after(line, at);
                if let Some(found) = value.explain(message, format) {
                    return Some(found.at(place(value.start, value.text.len().max(1)), ""));
                }
            }
            _ => {}
        }
        at += letter.len_utf8();
    }
    None
}

fn semicolon(place: Span) -> Diagnostic {
    Diagnostic::error("netlist::syntax", "fields are separated by `,`")
        .at(place, "write `,` here")
        .help("write it like this: `{ T0 = \"25 degC\", C = \"500 J/K\" }`")
}

/// The value after an equals sign.
struct Value<'a> {
    key: &'a str,
    start: usize,
    text: &'a str,
}

impl<'a> Value<'a> {
    fn after(line: &'a str, equals: usize) -> Self {
        let (before, after) =
            (line.get(..equals).unwrap_or(""), line.get(equals + 1..).unwrap_or(""));
        let key = before.trim_end().rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
        let start = line.len() - after.trim_start().len();
        let rest = line.get(start..).unwrap_or("");
        Self {
            key: key.unwrap_or(""),
            start,
            text: rest.get(..length(rest)).unwrap_or("").trim_end(),
        }
    }

    fn explain(&self, message: &str, format: &NetlistFormat) -> Option<Diagnostic> {
        if self.text.starts_with(['"', '\'', '{', '[']) || self.text.is_empty() {
            return None;
        }
        if self.text.starts_with('(') && self.text.contains('=') {
            let error = Diagnostic::error("netlist::syntax", "fields are in braces");
            return Some(error.help(format!("write `{}`", self.in_braces())));
        }
        self.decimal_comma(format).or_else(|| self.unquoted(message))
    }

    fn in_braces(&self) -> String {
        let inner = self.text.trim_start_matches('(').trim_end_matches(')').trim();
        format!("{{ {inner} }}")
    }

    /// `R = 0,35`, with the unit of the field if none is written.
    fn decimal_comma(&self, format: &NetlistFormat) -> Option<Diagnostic> {
        let example = format.example(self.key).unwrap_or_default().trim_matches('"');
        let unit = example.split_once(' ').map_or("", |(_, unit)| unit);
        let number = self.text.trim_end_matches(|c: char| !c.is_ascii_digit());
        let quantity =
            if number == self.text { format!("{number} {unit}") } else { self.text.to_owned() };
        let error = parse_quantity(quantity.trim(), None).err()?;
        let (code, help) = (error.code(), error.help()?);
        (code == "units::decimal_comma")
            .then(|| Diagnostic::error(code, error.to_string()).help(help))
    }

    /// `T0 = T_room` and `C = 150 [J/K]`, if the parser reports something else.
    fn unquoted(&self, message: &str) -> Option<Diagnostic> {
        let other = ["invalid boolean", "missing key for inline", "unexpected key or value"];
        if !other.iter().any(|start| message.starts_with(start)) || is_toml(self.text) {
            return None;
        }
        let plain = self.text.replace(['[', ']'], "");
        let text =
            if parse_quantity(&plain, None).is_ok() { plain } else { self.text.replace('"', "") };
        let error = Diagnostic::error("netlist::unquoted", "text without quotes");
        Some(error.help(format!("write \"{text}\"")))
    }
}

/// A value without quotes ends at a comma outside brackets that is not inside a number, at a brace
/// or a comment.
fn length(rest: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(letter) = rest.get(at..).and_then(|rest| rest.chars().next()) {
        let tail = rest.get(at..).unwrap_or("");
        let next_is_digit = tail.chars().nth(1).is_some_and(|c| c.is_ascii_digit());
        let in_number = next_is_digit
            && rest.get(..at).is_some_and(|t| t.ends_with(|c: char| c.is_ascii_digit()));
        match letter {
            '"' | '\'' if depth > 0 => {
                at += string_length(tail);
                continue;
            }
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            ',' if depth == 0 && !in_number => return at,
            '}' | '#' if depth == 0 => return at,
            _ => {}
        }
        at += letter.len_utf8();
    }
    rest.len()
}

/// True if a text without quotes is a value of TOML: a number, `true`, a date.
fn is_toml(text: &str) -> bool {
    let digits = text.replace('_', "");
    let date = text.contains([':', '-']) && text.starts_with(|c: char| c.is_ascii_digit());
    matches!(text, "true" | "false")
        || digits.parse::<f64>().is_ok()
        || digits.starts_with("0x")
        || date
}

#[cfg(test)]
mod tests {
    use super::Value;

    #[test]
    fn values_end_where_the_field_ends() {
        let value = |line: &'static str| Value::after(line, line.find('=').unwrap_or(0)).text;
        assert_eq!(value("R = 0,35 }"), "0,35");
        assert_eq!(value("R = 0,35, to = \"b\""), "0,35");
        assert_eq!(value("C = 150 [J/K] # steel"), "150 [J/K]");
        assert_eq!(
            value("a = ( T0 = \"20 degC)\", C = \"150 J/K\" )"),
            "( T0 = \"20 degC)\", C = \"150 J/K\" )"
        );
    }
}
