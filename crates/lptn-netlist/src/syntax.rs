//! TOML to [`RawNetlist`]: the tree with every place, and errors of the TOML itself.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use lptn_data::{Diagnostic, FileId, Files, Span, arrange};

use crate::foreign;
use crate::format::NetlistFormat;
use crate::plain;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::syntax_error;
use crate::toml_1_1;

/// Reads the text of a file. The tree contains everything that could be read.
pub(crate) fn read(
    files: &Files,
    file: FileId,
    format: &NetlistFormat,
) -> (RawNetlist, Vec<Diagnostic>) {
    let text = files.text(file);
    if let Some(top) = plain::tree(text, file) {
        return (RawNetlist { top }, Vec::new());
    }
    read_any(files, file, format)
}

/// The same of a text that may contain errors.
fn read_any(files: &Files, file: FileId, format: &NetlistFormat) -> (RawNetlist, Vec<Diagnostic>) {
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
            DeValue::Integer(integer) => RawKind::integer(integer.as_str(), integer.radix()),
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
        RawKind::string(written, text.to_owned(), span)
    }
}

#[cfg(test)]
mod tests {
    use super::read_any;
    use crate::raw::RawKind;
    use crate::{parse_raw, plain, section};
    use lptn_data::Files;

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

    /// True if the file is plain; its tree is then that of `toml`.
    fn is_plain(text: &str) -> bool {
        let mut files = Files::new();
        let file = files.add("a.toml", text);
        let Some(top) = plain::tree(text, file) else { return false };
        let (raw, diagnostics) = read_any(&files, file, section::format());
        assert_eq!((top, diagnostics), (raw.top, vec![]), "{text}");
        true
    }

    #[test]
    fn a_plain_file_has_the_tree_of_toml() {
        let texts = [
            "",
            "\u{feff}a = 1 # why\r\nb = 0x10\r\n",
            "a = \"x\\u0020\\n\"\nb = ''\nc = \"\"\"\nd\"\"\"\ne = '''f'''\n",
            "a = [1, [2.5, true], { b = 'x', c = [{}] },\n # why\n]\n",
            "a = { b = [1,\n 2,\n], c = \"x,}\\\"\" }",
            "[a.b.c]\nx = 1_000\n[a.b.d]\n[a.e]\n[f]\n'g.h' = -1e3\n[f.\"i j\"]\nk = inf",
        ];
        for text in texts {
            assert!(is_plain(text), "{text}");
        }
    }

    #[test]
    fn other_files_are_left_to_toml() {
        let texts = [
            "a = 1\na = 2",
            "a.b = 1",
            "a = { b.c = 1 }",
            "a = { b = 1, b = 2 }",
            "a = { b = 1, }",
            "a = { b = 1, # why\n c = 2 }",
            "a = [{ b = [1,\n 2], }]",
            "a = \"\\x41\"",
            "a = 1979-05-27",
            "[[a]]\nb = 1",
            "[a]\n[a]",
            "[a.b]\n[a]",
            "a = 1\n[a]",
            "a = {}\n[a.b]",
            "a = [1]\n[a.b]",
            "a = [1",
            "a = 1 b = 2",
            "a = \"\u{7f}\"",
            "[]",
            "= 1",
        ];
        for text in texts {
            assert!(!is_plain(text), "{text}");
        }
    }

    #[test]
    fn a_plain_file_with_a_letter_less_has_the_tree_of_toml() {
        let text = "format = 1 # of it\n[node]\na = { C = \"5 J/K\", T0 = '25 degC' }\n[run]\n\
            select = [\"a.T\", 'b']\n[use.x]\ncount = 2\n[use.x.set]\nk = [1.5, true]\n";
        assert!(is_plain(text));
        let less = |at: usize| [&text[..at], &text[at + 1..]].concat();
        let plain = (0..text.len()).filter(|&at| is_plain(&less(at))).count();
        assert!(plain > text.len() / 4, "{plain}");
    }
}
