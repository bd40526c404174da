//! TOML to [`RawNetlist`]: the tree with every place, and errors of the TOML itself.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use lptn_data::{Diagnostic, FileId, Files, Span, arrange};

use crate::foreign;
use crate::format::NetlistFormat;
use crate::plain_toml;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::syntax_error;
use crate::toml_1_1;

/// Reads the text of a file. The tree contains everything that could be read.
pub(crate) fn read(
    files: &Files,
    file: FileId,
    format: &NetlistFormat,
) -> (RawNetlist, Vec<Diagnostic>) {
    match plain_toml::read(files.text(file), file) {
        Some(top) => (RawNetlist { top }, Vec::new()),
        None => by_library(files, file, format),
    }
}

/// The same by the library for TOML, which knows all of it and every mistake.
pub(crate) fn by_library(
    files: &Files,
    file: FileId,
    format: &NetlistFormat,
) -> (RawNetlist, Vec<Diagnostic>) {
    let text = files.text(file);
    let (tree, errors) = DeTable::parse_recoverable(text);
    let mut reader = Reader { file, text, newer: Vec::new() };
    let top = reader.table(tree.get_ref(), 0..0);
    let mut diagnostics = syntax_error::explain(&errors, (file, format), text, &top);
    if diagnostics.is_empty() {
        // next to broken TOML it would only repeat the same
        diagnostics = reader.newer;
    } else if let Some(other) =
        foreign::recognise((files.name(file), format), (file, text), diagnostics.len())
    {
        return (RawNetlist { top: RawTable { entries: Vec::new(), ..top } }, vec![other]);
    }
    arrange(files, &mut diagnostics);
    (RawNetlist { top }, diagnostics)
}

struct Reader<'a> {
    file: FileId,
    text: &'a str,
    /// Features of TOML 1.1, which this format does not allow.
    newer: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn table(&mut self, table: &DeTable<'_>, range: std::ops::Range<usize>) -> RawTable {
        let mut entries: Vec<RawEntry> = table
            .iter()
            .map(|(key, value)| RawEntry {
                key: key.get_ref().to_string(),
                key_span: Span::new(self.file, key.span()),
                value: self.value(value),
            })
            .collect();
        // the tree is in the order of the names
        entries.sort_by_key(|entry| entry.key_span.range.start);
        let span = Span::new(self.file, range);
        let written = self.text.get(span.range.clone()).unwrap_or("");
        if written.starts_with('{') {
            self.newer.extend(toml_1_1::inline_table(written, &span));
        }
        RawTable { span, entries }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>) -> RawValue {
        let span = Span::new(self.file, value.span());
        let kind = match value.get_ref() {
            DeValue::String(text) => self.string(text, &span),
            DeValue::Integer(integer) => {
                RawKind::Integer(decimal(integer.as_str(), integer.radix()))
            }
            DeValue::Float(float) => RawKind::Float(float.as_str().to_owned()),
            DeValue::Boolean(truth) => RawKind::Boolean(*truth),
            DeValue::Datetime(_) => RawKind::Datetime,
            DeValue::Array(list) => RawKind::Array(self.list(list)),
            DeValue::Table(table) => RawKind::Table(self.table(table, value.span())),
        };
        RawValue { span, kind }
    }

    fn list(&mut self, list: &DeArray<'_>) -> Vec<RawValue> {
        list.iter().map(|value| self.value(value)).collect()
    }

    fn string(&mut self, text: &str, span: &Span) -> RawKind {
        let written = self.text.get(span.range.clone()).unwrap_or("");
        self.newer.extend(toml_1_1::string(written, span));
        let start = content_start(written, text).map(|offset| span.range.start + offset);
        RawKind::String { text: text.to_owned(), start }
    }
}

/// The byte at which the content of a written string begins, if the content is in it letter by
/// letter.
fn content_start(written: &str, content: &str) -> Option<usize> {
    let quotes = ["\"\"\"\r\n", "'''\r\n", "\"\"\"\n", "'''\n", "\"\"\"", "'''", "\"", "'"];
    let opening =
        quotes.iter().find(|quote| written.starts_with(**quote)).map_or(0, |quote| quote.len());
    written.get(opening..)?.starts_with(content).then_some(opening)
}

/// A TOML integer may be hexadecimal, octal or binary; one that does not fit goes to the reader of
/// numbers unchanged.
fn decimal(digits: &str, radix: u32) -> String {
    match radix {
        10 => digits.to_owned(),
        _ => {
            i64::from_str_radix(digits, radix).map_or_else(|_| digits.to_owned(), |n| n.to_string())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::content_start;
    use crate::parse_raw;
    use crate::raw::RawKind;
    use lptn_data::Files;

    #[test]
    fn content_is_found_where_no_escape_changes_it() {
        assert_eq!(content_start("\"5 K/W\"", "5 K/W"), Some(1));
        assert_eq!(content_start("'5 K/W'", "5 K/W"), Some(1));
        assert_eq!(content_start("\"\"\"\n5 K/W\"\"\"", "5 K/W"), Some(4));
        assert_eq!(content_start("\"5\\u0020K/W\"", "5 K/W"), None);
        assert_eq!(content_start("\"\"", ""), Some(1));
    }

    #[test]
    fn entries_keep_the_order_of_the_file() {
        let mut files = Files::new();
        let file = files.add("a.toml", "z = 0x10\na = 1.5\n[m]\n[b]\n[b.y]\n[b.x]\n");
        let (raw, diagnostics) = parse_raw(&files, file);
        assert_eq!(diagnostics, []);
        let keys: Vec<&str> = raw.top.entries.iter().map(|e| e.key.as_str()).collect();
        assert_eq!(keys, ["z", "a", "m", "b"]);
        assert_eq!(raw.top.entries[0].value.kind, RawKind::Integer("16".into()));
        let RawKind::Table(b) = &raw.top.entries[3].value.kind else { panic!("a table") };
        assert_eq!(b.entries[0].key, "y");
    }
}
