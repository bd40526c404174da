//! The plain part of TOML, read at once: headings, `key = value` on one line, strings without
//! escapes, decimal numbers, lists and inline tables.
//!
//! The library for TOML builds an ordered tree that is then copied, which took a third of the time
//! of reading thousands of elements. Whatever is not plain, and whatever may be wrong, is left to
//! it: this reader only knows texts without a mistake, and has no messages.

use std::ops::Range;

use foldhash::{HashMap, HashSet};
use lptn_data::{FileId, Span};

use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

/// Deeper lists and tables are left to the library, as are longer integers.
const DEEPEST: usize = 8;
const MOST_DIGITS: usize = 18;

/// Tables of more keys find one that is given twice by its hash.
const FEW: usize = 12;

/// The whole text as a table; `None` if some of it is not plain.
pub(crate) fn read(text: &str, file: FileId) -> Option<RawTable> {
    let is_other = |byte: u8| (byte < b' ' && byte != b'\n' && byte != b'\t') || byte == 0x7f;
    if text.bytes().any(is_other) || text.starts_with('\u{feff}') {
        return None;
    }
    let mut reader = Reader { text, bytes: text.as_bytes(), at: 0, file };
    let mut top = Top { entries: Vec::new(), known: HashMap::default() };
    let mut open = top.own(reader.span(0..0));
    loop {
        reader.skip_lines();
        match reader.peek() {
            None => break,
            Some(b'[') => {
                top.close(open)?;
                open = reader.heading(&mut top)?;
            }
            Some(_) => {
                let entry = reader.entry(0)?;
                open.table.entries.push(entry);
            }
        }
        reader.end_of_line()?;
    }
    top.close(open)?;
    Some(RawTable { span: reader.span(0..0), entries: top.entries })
}

/// The sections so far.
struct Top<'t> {
    entries: Vec<RawEntry>,
    /// Names of the top level with their position, and true if only `[name.inner]` made them.
    known: HashMap<&'t str, (usize, bool)>,
}

/// The section that entries are read into.
struct Open<'t> {
    /// Its names with their places, none for the top level.
    path: Vec<(&'t str, Span)>,
    table: RawTable,
}

impl<'t> Top<'t> {
    fn own(&self, span: Span) -> Open<'t> {
        Open { path: Vec::new(), table: RawTable { span, entries: Vec::new() } }
    }

    /// Puts a section in its place; `None` if its name, or one of its keys, is taken.
    fn close(&mut self, open: Open<'t>) -> Option<()> {
        let Open { path, table } = open;
        if repeats(&table.entries) {
            return None;
        }
        let entry = |(name, place): &(&str, Span), table: RawTable| {
            let value = RawValue { span: table.span.clone(), kind: RawKind::Table(table) };
            RawEntry { key: (*name).to_owned(), key_span: place.clone(), value }
        };
        match path.as_slice() {
            [] => {
                self.entries = table.entries;
                return Some(());
            }
            [own] => {
                self.add(own.0, false)?;
                self.entries.push(entry(own, table));
            }
            [outer, own] => {
                let inner = entry(own, table);
                let position = match self.known.get(outer.0) {
                    Some((position, true)) => *position,
                    _ => {
                        self.add(outer.0, true)?;
                        let around = RawTable { span: outer.1.clone(), entries: Vec::new() };
                        self.entries.push(entry(outer, around));
                        self.entries.len() - 1
                    }
                };
                let RawKind::Table(table) = &mut self.entries[position].value.kind else {
                    return None;
                };
                if table.entries.iter().any(|known| known.key == inner.key) {
                    return None;
                }
                table.entries.push(inner);
            }
            _ => return None,
        }
        Some(())
    }

    fn add(&mut self, name: &'t str, implied: bool) -> Option<()> {
        let is_key = self.entries.iter().any(|entry| entry.key == name);
        let place = (self.entries.len(), implied);
        (!is_key && self.known.insert(name, place).is_none()).then_some(())
    }
}

/// True if a key is given twice.
fn repeats(entries: &[RawEntry]) -> bool {
    if entries.len() <= FEW {
        let before = |i: usize| entries[..i].iter().any(|entry| entry.key == entries[i].key);
        return (1..entries.len()).any(before);
    }
    let mut seen = HashSet::default();
    entries.iter().any(|entry| !seen.insert(entry.key.as_str()))
}

struct Reader<'t> {
    text: &'t str,
    bytes: &'t [u8],
    at: usize,
    file: FileId,
}

impl<'t> Reader<'t> {
    fn span(&self, range: Range<usize>) -> Span {
        Span::new(self.file, range)
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn take(&mut self, byte: u8) -> Option<()> {
        (self.peek()? == byte).then(|| self.at += 1)
    }

    fn skip(&mut self, is_part: impl Fn(u8) -> bool) -> Range<usize> {
        let from = self.at;
        while self.peek().is_some_and(&is_part) {
            self.at += 1;
        }
        from..self.at
    }

    fn skip_space(&mut self) {
        self.skip(|byte| byte == b' ' || byte == b'\t');
    }

    /// Skips blank lines and comments.
    fn skip_lines(&mut self) {
        loop {
            self.skip(|byte| matches!(byte, b' ' | b'\t' | b'\n'));
            if self.peek() != Some(b'#') {
                return;
            }
            self.skip(|byte| byte != b'\n');
        }
    }

    /// Nothing but space and a comment up to the end of the line.
    fn end_of_line(&mut self) -> Option<()> {
        self.skip_space();
        if self.peek() == Some(b'#') {
            self.skip(|byte| byte != b'\n');
        }
        matches!(self.peek(), None | Some(b'\n')).then_some(())
    }

    fn key(&mut self) -> Option<(&'t str, Span)> {
        let range = self.skip(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
        let key = self.text.get(range.clone()).filter(|key| !key.is_empty())?;
        Some((key, self.span(range)))
    }

    /// `[name]` or `[name.inner]`.
    fn heading(&mut self, top: &mut Top<'t>) -> Option<Open<'t>> {
        let from = self.at;
        self.take(b'[')?;
        let mut path = vec![self.key()?];
        if self.take(b'.').is_some() {
            path.push(self.key()?);
        }
        self.take(b']')?;
        Some(Open { path, ..top.own(self.span(from..self.at)) })
    }

    /// `key = value`.
    fn entry(&mut self, depth: usize) -> Option<RawEntry> {
        let (key, key_span) = self.key()?;
        self.skip_space();
        self.take(b'=')?;
        self.skip_space();
        let value = self.value(depth)?;
        Some(RawEntry { key: key.to_owned(), key_span, value })
    }

    fn value(&mut self, depth: usize) -> Option<RawValue> {
        let from = self.at;
        let kind = match self.peek()? {
            b'"' => self.string()?,
            b'{' if depth < DEEPEST => self.inline_table(depth)?,
            b'[' if depth < DEEPEST => self.list(depth)?,
            b't' | b'f' => self.truth()?,
            _ => self.number()?,
        };
        Some(RawValue { span: self.span(from..self.at), kind })
    }

    /// A string in single double quotes without escapes.
    fn string(&mut self) -> Option<RawKind> {
        self.take(b'"')?;
        let range = self.skip(|byte| !matches!(byte, b'"' | b'\\' | b'\n'));
        self.take(b'"')?;
        let is_long = range.is_empty() && self.peek() == Some(b'"');
        let text = self.text.get(range.clone()).filter(|_| !is_long)?;
        Some(RawKind::String { text: text.to_owned(), start: Some(range.start) })
    }

    fn inline_table(&mut self, depth: usize) -> Option<RawKind> {
        let from = self.at;
        self.take(b'{')?;
        let mut entries = Vec::new();
        self.skip_space();
        if self.peek() != Some(b'}') {
            loop {
                self.skip_space();
                entries.push(self.entry(depth + 1)?);
                self.skip_space();
                if self.take(b',').is_none() {
                    break;
                }
            }
        }
        self.take(b'}')?;
        let span = self.span(from..self.at);
        (!repeats(&entries)).then_some(RawKind::Table(RawTable { span, entries }))
    }

    fn list(&mut self, depth: usize) -> Option<RawKind> {
        self.take(b'[')?;
        let mut items = Vec::new();
        loop {
            self.skip_lines();
            if self.peek() == Some(b']') {
                break;
            }
            items.push(self.value(depth + 1)?);
            self.skip_lines();
            if self.take(b',').is_none() {
                break;
            }
        }
        self.take(b']')?;
        Some(RawKind::Array(items))
    }

    fn truth(&mut self) -> Option<RawKind> {
        let range = self.skip(|byte| byte.is_ascii_alphabetic());
        match self.text.get(range)? {
            "true" => Some(RawKind::Boolean(true)),
            "false" => Some(RawKind::Boolean(false)),
            _ => None,
        }
        .filter(|_| self.ends_here())
    }

    /// `-1`, `0.5`, `2e-3`.
    fn number(&mut self) -> Option<RawKind> {
        let from = self.at;
        let _ = self.take(b'-');
        let whole = self.digits()?;
        if whole.len() > 1 && self.bytes[whole.start] == b'0' {
            return None;
        }
        let mut is_float = false;
        if self.take(b'.').is_some() {
            self.digits()?;
            is_float = true;
        }
        if self.take(b'e').is_some() {
            let _ = self.take(b'-');
            self.digits()?;
            is_float = true;
        }
        let text = self.text.get(from..self.at).filter(|_| self.ends_here())?.to_owned();
        match is_float {
            true => Some(RawKind::Float(text)),
            false => (whole.len() <= MOST_DIGITS).then_some(RawKind::Integer(text)),
        }
    }

    fn digits(&mut self) -> Option<Range<usize>> {
        Some(self.skip(|byte| byte.is_ascii_digit())).filter(|digits| !digits.is_empty())
    }

    /// True if a value may end here.
    fn ends_here(&self) -> bool {
        matches!(self.peek(), None | Some(b' ' | b'\t' | b'\n' | b',' | b']' | b'}' | b'#'))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use lptn_data::Files;

    use crate::section;
    use crate::syntax::by_library;

    /// True if a text is plain; the tree is then that of the library, which is the other program.
    fn agrees(text: &str) -> bool {
        let mut files = Files::new();
        let file = files.add("a.toml", text);
        let Some(own) = super::read(text, file) else { return false };
        let (raw, problems) = by_library(&files, file, section::format());
        assert_eq!(problems, [], "{text}");
        assert_eq!(own, raw.top, "{text}");
        true
    }

    /// The netlists of this repository.
    fn netlists() -> Vec<String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folders = ["tests/good", "tests/bad", "tests/expand", "../../networks"];
        let files = folders.iter().flat_map(|folder| std::fs::read_dir(root.join(folder)).unwrap());
        let paths = files.map(|file| file.unwrap().path());
        let toml = paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
        let mut paths: Vec<_> = toml.collect();
        paths.sort();
        paths.iter().filter_map(|path| std::fs::read_to_string(path).ok()).collect()
    }

    #[test]
    fn trees_are_those_of_the_library() {
        let netlists = netlists();
        let plain = netlists.iter().filter(|text| agrees(text)).count();
        assert!(3 * plain > netlists.len(), "{plain} of {}", netlists.len());
    }

    /// One byte less, another one or one more, at many places of each netlist.
    #[test]
    fn a_text_with_a_mistake_is_left_to_the_library() {
        let (mut seed, letters) = (1_usize, b"\"[]{}=,.#\n\\'0e-_ta \r");
        for text in netlists().iter().filter(|text| (1..4000).contains(&text.len())) {
            for _ in 0..12 {
                seed = (seed * 25_173 + 13_849) % 1_048_576;
                let (at, letter) = (seed % text.len(), letters[seed / 7 % letters.len()]);
                if !text.is_char_boundary(at) || !text.is_char_boundary(at + 1) {
                    continue;
                }
                let (before, after) = (&text[..at], &text[at + 1..]);
                let letter = char::from(letter);
                let same = &text[at..];
                agrees(&format!("{before}{after}"));
                agrees(&format!("{before}{letter}{after}"));
                agrees(&format!("{before}{letter}{same}"));
            }
        }
    }

    #[test]
    fn parts_of_the_grammar() {
        let plain = "# a\nformat = 1\n\n[a] # b\nx = { }\ny = {p = -1, q= [1, 2.5e-3 ,\n # c\n \"é\",]}\n\
                     [b.c]\nt = true\n[b.d]\n[e]\n";
        assert!(agrees(plain));
        for other in [
            "a = 'x'\n",
            "a = 01\n",
            "a = +1\n",
            "a = 1_000\n",
            "a.b = 1\n",
            "[a]\n[a]\n",
            "a = 1\na = 2\n",
            "a = { b = 1, b = 2 }\n",
            "a = { b = 1, }\n",
            "a = \"\"\"x\"\"\"\n",
            "a = \"\\n\"\n",
            "[[a]]\n",
            "[a]\n[a.b]\n",
            "[a.b]\n[a]\n",
            "a = 1\n[a.b]\n",
            "[ a ]\n",
            "a = 2020-01-01\n",
            "a = 1 b = 2\n",
            "a\n",
            "a = \n",
            "a = inf\n",
            "\u{feff}a = 1\n",
            "a = 1\r\n",
            "a = truex\n",
        ] {
            assert!(!agrees(other), "{other}");
        }
    }
}
