//! The format is TOML 1.0, the parser reads 1.1. Features of 1.1 are found here, so that every TOML
//! tool can read every netlist.

use lptn_data::{Diagnostic, Span};

const CODE: &str = "netlist::toml_1_1";

/// A line break or a trailing comma in an inline table.
pub(crate) fn inline_table(written: &str, span: &Span) -> Option<Diagnostic> {
    let ends_with_comma =
        || written.strip_suffix('}').is_none_or(|inner| inner.trim_end().ends_with(','));
    if !written.contains('\n') && !ends_with_comma() {
        return None;
    }
    let mut scan = Scan { text: written, at: 1, open: Vec::new(), last: '{' };
    while let Some((at, found)) = scan.next() {
        let place = |len| Span::new(span.file, span.range.start + at..span.range.start + at + len);
        match found {
            '\n' if scan.open.is_empty() => {
                let opening = Span::new(span.file, span.range.start..span.range.start + 1);
                return Some(
                    Diagnostic::error(CODE, "an inline table has to end on the line it begins on")
                        .at(opening, "begins here, and does not end on this line")
                        .help(
                            "write it on one line, or give it a heading, `[resistor.internal]`, \
                               and one field per line",
                        ),
                );
            }
            '}' if scan.open.is_empty() => {
                return (scan.last == ',').then(|| {
                    Diagnostic::error(CODE, "an inline table may not end with a comma")
                        .at(place(1), "remove the comma before this")
                });
            }
            _ => scan.step(found),
        }
    }
    None
}

/// `\e` or `\x41` in a basic string.
pub(crate) fn string(written: &str, span: &Span) -> Option<Diagnostic> {
    if !written.starts_with('"') || !written.contains('\\') {
        return None;
    }
    let mut letters = written.char_indices();
    while let Some((at, letter)) = letters.next() {
        if letter == '\\'
            && let Some((_, escaped @ ('e' | 'x'))) = letters.next()
        {
            let place = Span::new(span.file, span.range.start + at..span.range.start + at + 2);
            return Some(
                Diagnostic::error(CODE, format!("TOML 1.0 has no escape `\\{escaped}`"))
                    .at(place, "")
                    .help("write the character itself, or `\\u0041` with its code"),
            );
        }
    }
    None
}

/// The characters of an inline table that are neither in strings nor in comments.
struct Scan<'a> {
    text: &'a str,
    at: usize,
    /// Brackets open inside the table; a list may have line breaks.
    open: Vec<char>,
    /// The last character that is not a space.
    last: char,
}

impl Scan<'_> {
    fn next(&mut self) -> Option<(usize, char)> {
        loop {
            let rest = self.text.get(self.at..)?;
            let found = rest.chars().next()?;
            let start = self.at;
            match found {
                '"' | '\'' => {
                    self.at += string_length(rest);
                    self.last = found;
                }
                '#' => self.at += rest.find('\n').unwrap_or(rest.len()),
                _ => {
                    self.at += found.len_utf8();
                    return Some((start, found));
                }
            }
        }
    }

    fn step(&mut self, found: char) {
        match found {
            '{' | '[' => self.open.push(found),
            '}' | ']' => drop(self.open.pop()),
            _ => {}
        }
        if !found.is_whitespace() {
            self.last = found;
        }
    }
}

/// The length of the string that `text` begins with; all of it if it is not closed.
pub(crate) fn string_length(text: &str) -> usize {
    let quote = if text.starts_with('"') { '"' } else { '\'' };
    let triple = quote.to_string().repeat(3);
    let closing = if text.starts_with(&triple) { triple } else { quote.to_string() };
    let mut at = closing.len();
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        if rest.starts_with(&closing) {
            return at + closing.len();
        }
        let escaped = quote == '"' && rest.starts_with('\\');
        at += rest.chars().take(if escaped { 2 } else { 1 }).map(char::len_utf8).sum::<usize>();
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::{inline_table, string};
    use lptn_data::{Files, Span};

    fn newer(written: &str) -> bool {
        let span = Span::new(Files::new().add("a", ""), 0..written.len());
        inline_table(written, &span).is_some()
    }

    #[test]
    fn line_breaks_and_trailing_commas_are_newer() {
        assert!(newer("{ a = 1,\n b = 2 }"));
        assert!(newer("{ a = 1, }"));
        assert!(newer("{ a = 'x', # why\n }"));
    }

    #[test]
    fn lists_and_strings_may_have_both() {
        assert!(!newer("{}"));
        assert!(!newer("{ a = [1,\n 2,\n], b = \"x,}\\\"\" }"));
        assert!(!newer("{ a = '''x\ny''', b = { c = 1 } }"));
    }

    #[test]
    fn escapes_of_the_newer_toml() {
        let span = Span::new(Files::new().add("a", ""), 0..9);
        assert!(string("\"\\x41\"", &span).is_some());
        assert!(string("\"\\\\x41\"", &span).is_none());
        assert!(string("'\\x41'", &span).is_none());
    }
}
