//! Applies what a help says is to be written.

use std::ops::Range;

use lptn_netlist::Diagnostic;

/// A way to mend a text: the part to replace, and by what.
#[derive(Clone, Debug)]
pub(crate) struct Fix {
    pub(crate) part: Range<usize>,
    pub(crate) text: String,
}

impl Fix {
    pub(crate) fn applied(&self, text: &str) -> String {
        format!("{}{}{}", &text[..self.part.start], self.text, &text[self.part.end..])
    }
}

/// The words before a text that is to be pasted, and after which no more of them come.
const PASTED: [&str; 6] = ["write", "did you mean", "add", "or", "for revolutions, or", "K,"];

/// The texts that a help offers between these marks, each behind a word that says to write it.
fn offered(help: &str, mark: char) -> Vec<String> {
    let parts: Vec<&str> = help.split(mark).collect();
    let texts = parts.windows(2).step_by(2).filter_map(|pair| {
        let before = pair[0].trim_end();
        let said = PASTED.iter().any(|word| before.ends_with(word));
        said.then(|| pair[1].to_owned())
    });
    texts.collect()
}

/// Every fix that the help of a mistake at `place` of `text` offers.
pub(crate) fn of(diagnostic: &Diagnostic, text: &str, place: &Range<usize>) -> Vec<Fix> {
    let Some(help) = &diagnostic.help else { return Vec::new() };
    if diagnostic.code.starts_with("units::") {
        let value = value_at(text, place);
        let quoted = offered(help, '"').into_iter();
        return quoted
            .filter_map(|text| Some(Fix { part: value.clone()?, text: format!("\"{text}\"") }))
            .collect();
    }
    // a line that belongs elsewhere
    if help.contains(" in [") || help.contains("[signal]") {
        return Vec::new();
    }
    let codes = offered(help, '`').into_iter();
    codes.filter_map(|code| of_code(&code, help, text, place)).collect()
}

/// A field that is written, or a name that is meant.
fn of_code(code: &str, help: &str, text: &str, place: &Range<usize>) -> Option<Fix> {
    let name = |text: &str| text.chars().all(|c| c.is_alphanumeric() || "_.[]*,".contains(c));
    match code.split_once(" = ") {
        // what has to be thought about before it is written
        Some((_, value)) if value.contains('?') || value.contains("name of") => None,
        Some((key, value)) if name(key) => {
            let part = field_at(text, place, key);
            let added = || inside(text, place).map(|at| at..at);
            let fix = |part: Range<usize>| {
                let comma = if part.is_empty() { ", " } else { "" };
                Fix { part, text: format!("{key} = {value}{comma}") }
            };
            part.or_else(added).map(fix)
        }
        None if name(code) && help.starts_with("did you mean") => {
            let part = place.clone();
            let quote = if text[part.clone()].starts_with('"') { "\"" } else { "" };
            Some(Fix { part, text: format!("{quote}{code}{quote}") })
        }
        _ => None,
    }
}

/// The line that a place begins in.
fn line_at(text: &str, place: &Range<usize>) -> Range<usize> {
    let start = text[..place.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[place.start..].find('\n').map_or(text.len(), |at| place.start + at);
    start..end
}

/// The string, with its quotes, or the number in which a place lies.
fn value_at(text: &str, place: &Range<usize>) -> Option<Range<usize>> {
    let line = line_at(text, place);
    let mut at = line.start;
    while at < line.end {
        let rest = &text[at..line.end];
        match rest.chars().next()? {
            quote @ ('"' | '\'') => {
                let end = at + 1 + rest[1..].find(quote)? + 1;
                if (at..end).contains(&place.start) {
                    return (place.end <= end).then_some(at..end);
                }
                at = end;
            }
            '#' => break,
            letter => at += letter.len_utf8(),
        }
    }
    let bare = &text[place.clone()];
    bare.parse::<f64>().is_ok().then(|| place.clone())
}

/// `key = value` in the line of a place, up to the comma, the brace or the end.
fn field_at(text: &str, place: &Range<usize>, key: &str) -> Option<Range<usize>> {
    let line = line_at(text, place);
    let found = text[line.clone()].match_indices(&format!("{key} = ")).find(|(at, _)| {
        !text[line.start..line.start + at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
    })?;
    let start = line.start + found.0;
    let (mut depth, mut quoted, mut end) = (0, false, line.end);
    for (at, letter) in text[start..line.end].char_indices() {
        match letter {
            '"' => quoted = !quoted,
            '{' | '[' | '(' if !quoted => depth += 1,
            ',' | '}' if !quoted && depth == 0 => {
                end = start + at;
                break;
            }
            '}' | ']' | ')' if !quoted => depth -= 1,
            '#' if !quoted => {
                end = start + at;
                break;
            }
            _ => {}
        }
    }
    let end = start + text[start..end].trim_end().len();
    Some(start..end)
}

/// Where the fields of the element in this line begin.
fn inside(text: &str, place: &Range<usize>) -> Option<usize> {
    let line = line_at(text, place);
    let open = text[line.clone()].find("= {")?;
    let body = &text[line.start + open + 3..line.end];
    // `{ }` takes no comma
    (!body.trim_start().starts_with('}')).then_some(line.start + open + 4)
}
