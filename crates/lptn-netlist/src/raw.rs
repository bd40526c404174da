//! A netlist as it is written: every key and value with its place, nothing resolved.

use lptn_data::{Span, on_borders};
use serde_json::Value;

use crate::toml_text::string;

/// The sections and keys of one file, in file order. Strings are untouched, numbers are the text of
/// the file.
#[derive(Clone, Debug, PartialEq)]
pub struct RawNetlist {
    /// The top level; sections are entries whose value is a table.
    pub top: RawTable,
}

impl RawNetlist {
    /// A section of this name, if it is there and is a table.
    pub(crate) fn section(&self, name: &str) -> Option<&RawTable> {
        match &self.top.get(name)?.value.kind {
            RawKind::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Takes the elements of a section out; a section that is not a table is left, to be reported.
    pub(crate) fn take(&mut self, name: &str) -> Vec<RawEntry> {
        let entries = &mut self.top.entries;
        let is_it =
            |entry: &RawEntry| entry.key == name && matches!(entry.value.kind, RawKind::Table(_));
        match entries.iter().position(is_it).map(|at| entries.remove(at).value.kind) {
            Some(RawKind::Table(table)) => table.entries,
            _ => Vec::new(),
        }
    }

    /// Adds an element to a section, after the existing ones.
    pub(crate) fn push(&mut self, section: &str, element: RawEntry) {
        let entries = &mut self.top.entries;
        let position = entries.iter().position(|known| known.key == section);
        let position = position.unwrap_or_else(|| {
            let span = element.key_span.clone();
            let kind = RawKind::Table(RawTable { span: span.clone(), entries: Vec::new() });
            entries.push(RawEntry::new(section, RawValue { span, kind }));
            entries.len() - 1
        });
        if let Some(RawKind::Table(table)) = entries.get_mut(position).map(|e| &mut e.value.kind) {
            table.entries.push(element);
        }
    }

    /// The elements of a section, in file order.
    pub(crate) fn elements(&self, name: &str) -> &[RawEntry] {
        self.section(name).map_or(&[], |table| &table.entries)
    }
}

/// The entries of a table in file order.
#[derive(Clone, Debug, PartialEq)]
pub struct RawTable {
    /// The whole inline table, or the heading of a `[table]`.
    pub span: Span,
    /// Its entries; no key appears twice.
    pub entries: Vec<RawEntry>,
}

impl RawTable {
    /// The entry of this key.
    pub fn get(&self, key: &str) -> Option<&RawEntry> {
        self.entries.iter().find(|entry| entry.key == key)
    }
}

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct RawEntry {
    /// The key without quotes.
    pub key: String,
    /// The place of the key.
    pub key_span: Span,
    /// The value.
    pub value: RawValue,
}

impl RawEntry {
    /// An entry that is generated: its key has the place of its value.
    pub(crate) fn new(key: &str, value: RawValue) -> Self {
        Self { key: key.to_owned(), key_span: value.span.clone(), value }
    }
}

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct RawValue {
    /// Its place, quotes included.
    pub span: Span,
    /// Its kind.
    pub kind: RawKind,
}

/// The kind of a value in TOML.
#[derive(Clone, Debug, PartialEq)]
pub enum RawKind {
    /// A string.
    String {
        /// Its content.
        text: String,
        /// The byte of the file at which the content begins; `None` if escapes make the content
        /// differ from the text of the file.
        start: Option<usize>,
    },
    /// An integer, as decimal text.
    Integer(String),
    /// A float, as text.
    Float(String),
    /// `true` or `false`.
    Boolean(bool),
    /// A date or time.
    Datetime,
    /// A list.
    Array(Vec<RawValue>),
    /// A table.
    Table(RawTable),
}

impl RawKind {
    /// A string, from its text with quotes and its content.
    pub(crate) fn string(written: &str, text: String, span: &Span) -> Self {
        let start = content_start(written, &text).map(|offset| span.range.start + offset);
        Self::String { text, start }
    }

    /// An integer, which may be hexadecimal, octal or binary; one that does not fit goes to the
    /// reader of numbers unchanged.
    pub(crate) fn integer(digits: &str, radix: u32) -> Self {
        let decimal = (radix != 10).then(|| i64::from_str_radix(digits, radix).ok()).flatten();
        Self::Integer(decimal.map_or_else(|| digits.to_owned(), |n| n.to_string()))
    }

    /// Its text in TOML; `None` for a table or a date.
    pub(crate) fn written(&self) -> Option<String> {
        match self {
            Self::String { text, .. } => Some(string(text)),
            Self::Integer(text) | Self::Float(text) => Some(text.clone()),
            Self::Boolean(answer) => Some(answer.to_string()),
            Self::Array(list) => {
                let all: Option<Vec<_>> = list.iter().map(|one| one.kind.written()).collect();
                Some(format!("[{}]", all?.join(", ")))
            }
            Self::Datetime | Self::Table(_) => None,
        }
    }

    /// Its kind, with the article that a sentence needs.
    pub(crate) fn with_article(&self) -> &'static str {
        match self {
            Self::String { .. } => "a string",
            Self::Integer(_) | Self::Float(_) => "a number",
            Self::Boolean(true) => "`true`",
            Self::Boolean(false) => "`false`",
            Self::Datetime => "a date",
            Self::Array(list) if list.is_empty() => "an empty list",
            Self::Array(_) => "a list",
            Self::Table(table) if table.entries.is_empty() => "an empty table",
            Self::Table(_) => "a table",
        }
    }
}

impl RawTable {
    /// The table as JSON, in which a date is `null`.
    pub fn json(&self) -> Value {
        self.entries.iter().map(|entry| (entry.key.clone(), entry.value.json())).collect()
    }
}

impl RawValue {
    /// The value as JSON, in which a date is `null`.
    pub fn json(&self) -> Value {
        match &self.kind {
            RawKind::String { text, .. } => text.as_str().into(),
            RawKind::Integer(text) | RawKind::Float(text) => number(&text.replace('_', "")),
            RawKind::Boolean(truth) => (*truth).into(),
            RawKind::Datetime => Value::Null,
            RawKind::Array(list) => list.iter().map(Self::json).collect(),
            RawKind::Table(table) => table.json(),
        }
    }

    /// The entries of a table; none of any other value.
    pub(crate) fn entries(&self) -> &[RawEntry] {
        match &self.kind {
            RawKind::Table(table) => &table.entries,
            _ => &[],
        }
    }

    /// The items of a list; any other value is one item.
    pub(crate) fn items(&self) -> &[Self] {
        match &self.kind {
            RawKind::Array(list) => list,
            _ => std::slice::from_ref(self),
        }
    }

    /// The file that it names, as a string or as `csv` of a table, with its place.
    pub(crate) fn file(&self) -> Option<(&str, &Self)> {
        match &self.kind {
            RawKind::String { text, .. } => Some((text, self)),
            RawKind::Table(table) => {
                let named = &table.get("csv")?.value;
                matches!(named.kind, RawKind::String { .. }).then(|| named.file())?
            }
            _ => None,
        }
    }

    /// A table that is generated.
    pub(crate) fn table(entries: Vec<RawEntry>, at: &Span) -> Self {
        Self { span: at.clone(), kind: RawKind::Table(RawTable { span: at.clone(), entries }) }
    }

    /// Text that is generated: its place is that of the value that it follows from.
    pub(crate) fn text(text: String, at: &Span) -> Self {
        Self { span: at.clone(), kind: RawKind::String { text, start: None } }
    }

    /// The place of some bytes of the string's content; the whole value if it is unknown.
    pub(crate) fn part(&self, range: &std::ops::Range<usize>) -> Span {
        let RawKind::String { text, start: Some(start) } = &self.kind else {
            return self.span.clone();
        };
        if range.start >= text.len() {
            // a problem at the end of the text is shown at the closing quote
            let end = start + text.len();
            return self.span.with(end..(end + 1).min(self.span.range.end));
        }
        let part = on_borders(text, range.start..range.end.max(range.start + 1));
        self.span.with(start + part.start..start + part.end)
    }
}

/// A number as JSON, which has no infinite numbers.
fn number(text: &str) -> Value {
    let whole = text.parse::<i64>().map(Value::from);
    let finite = |text: &str| text.parse().map_or(0.0, |x: f64| x.clamp(f64::MIN, f64::MAX));
    whole.unwrap_or_else(|_| finite(text).into())
}

/// The byte at which the content of a written string begins, if the content is in it letter by
/// letter.
fn content_start(written: &str, content: &str) -> Option<usize> {
    let opening = match written.as_bytes() {
        [b'"', b'"', b'"', b'\r', b'\n', ..] | [b'\'', b'\'', b'\'', b'\r', b'\n', ..] => 5,
        [b'"', b'"', b'"', b'\n', ..] | [b'\'', b'\'', b'\'', b'\n', ..] => 4,
        [b'"', b'"', b'"', ..] | [b'\'', b'\'', b'\'', ..] => 3,
        [b'"' | b'\'', ..] => 1,
        _ => 0,
    };
    written.get(opening..)?.starts_with(content).then_some(opening)
}

#[cfg(test)]
mod tests {
    use super::content_start;

    #[test]
    fn content_is_found_where_no_escape_changes_it() {
        assert_eq!(content_start("\"5 K/W\"", "5 K/W"), Some(1));
        assert_eq!(content_start("'5 K/W'", "5 K/W"), Some(1));
        assert_eq!(content_start("\"\"\"\n5 K/W\"\"\"", "5 K/W"), Some(4));
        assert_eq!(content_start("\"5\\u0020K/W\"", "5 K/W"), None);
        assert_eq!(content_start("\"\"", ""), Some(1));
    }
}
