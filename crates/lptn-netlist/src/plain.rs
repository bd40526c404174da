//! The tree of a plain file, made while the parser reads it.
//!
//! `DeTable` of `toml` keeps the tokens and the events of a whole file and has a map for each
//! table. With the copy into the tree here it took 38 % of the instructions that read 5000
//! elements, and most of the memory. The lexer and the grammar are the same here, those of
//! `toml_parser`. Errors, dotted keys, lists of tables, dates and headings that are not in order
//! are left to `toml`.

use std::borrow::Cow;

use foldhash::{HashSet, HashSetExt as _};
use lptn_data::{FileId, Span};
use toml_parser::decoder::{Encoding, ScalarKind};
use toml_parser::lexer::{Lexer, Token, TokenKind};
use toml_parser::parser::{EventReceiver, RecursionGuard, ValidateWhitespace, parse_document};
use toml_parser::{ErrorSink, ParseError, Raw, Source};

use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::toml_1_1;

type Place = toml_parser::Span;

/// Depth of lists, of inline tables and of headings that `toml` allows.
const DEEPEST: u32 = 80;

/// Number of tokens after which a line is the last of those that are parsed together: tokens of a
/// whole file fill as much memory as its tree.
const MOST_TOKENS: usize = 1000;

/// Tables of fewer keys are compared key by key.
const FEW: usize = 8;

/// The tree; `None` if the file is not plain.
pub(crate) fn tree(text: &str, file: FileId) -> Option<RawTable> {
    let source = Source::new(text);
    let mut plain = Plain::new(source, file);
    let mut errors: Option<ParseError> = None;
    let mut checked = ValidateWhitespace::new(&mut plain, source);
    let mut guarded = RecursionGuard::new(&mut checked, DEEPEST);
    let mut tokens = source.lex();
    let mut some = Vec::new();
    while lines(&mut tokens, &mut some) && errors.is_none() {
        parse_document(&some, &mut guarded, &mut errors);
    }
    plain.finish_section();
    (errors.is_none() && !plain.odd && unique(&plain.top)).then_some(plain.top)
}

/// The tokens of some lines, up to a line break outside brackets: a file whose parts are TOML is
/// TOML. `false` at the end.
fn lines(tokens: &mut Lexer<'_>, some: &mut Vec<Token>) -> bool {
    some.clear();
    let mut depth = 0_i32;
    for token in tokens {
        some.push(token);
        match token.kind() {
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => depth -= 1,
            TokenKind::Newline if depth == 0 && some.len() >= MOST_TOKENS => break,
            _ => {}
        }
    }
    !some.is_empty()
}

/// The tree as far as it is read.
struct Plain<'a> {
    source: Source<'a>,
    file: FileId,
    top: RawTable,
    /// The heading of the section that is read, with the keys of its path.
    heading: Option<(Span, Vec<(String, Span)>)>,
    /// True between the brackets of a heading.
    in_heading: bool,
    /// Keys without a value yet; those of a heading while it is read.
    keys: Vec<(String, Span)>,
    /// Lists and inline tables that are not closed.
    open: Vec<Open>,
    /// Entries of the section that is read, then those of its open tables.
    entries: Vec<RawEntry>,
    /// Values of open lists.
    values: Vec<RawValue>,
    /// True after a comma.
    comma: bool,
    /// True after something that is left to `toml`.
    odd: bool,
}

/// A list or an inline table that is not closed.
struct Open {
    /// The byte of its bracket.
    start: usize,
    /// The position of its first value or entry.
    first: usize,
    list: bool,
}

impl<'a> Plain<'a> {
    fn new(source: Source<'a>, file: FileId) -> Self {
        let top = RawTable { span: Span::new(file, 0..0), entries: Vec::new() };
        Self {
            source,
            file,
            top,
            heading: None,
            in_heading: false,
            keys: Vec::new(),
            open: Vec::new(),
            entries: Vec::new(),
            values: Vec::new(),
            comma: false,
            odd: false,
        }
    }

    fn span(&self, place: Place) -> Span {
        Span::new(self.file, place.start()..place.end())
    }

    /// Puts a value into the list or table that is open.
    fn value(&mut self, value: RawValue) {
        self.comma = false;
        if let Some(Open { list: true, .. }) = self.open.last() {
            self.values.push(value);
        } else if let Some((key, key_span)) = self.keys.pop() {
            self.entries.push(RawEntry { key, key_span, value });
        } else {
            self.odd = true;
        }
    }

    /// Puts the section that was read to its place.
    fn finish_section(&mut self) {
        let entries = self.entries.drain(..).collect();
        let Some((place, mut path)) = self.heading.take() else {
            self.top.entries = entries;
            return;
        };
        let Some((key, key_span)) = path.pop() else {
            self.odd = true;
            return;
        };
        let kind = RawKind::Table(RawTable { span: place.clone(), entries });
        let entry = RawEntry { key, key_span, value: RawValue { span: place, kind } };
        match below(&mut self.top, path, self.source.input()) {
            Some(table) => table.entries.push(entry),
            None => self.odd = true,
        }
    }

    fn written(&self, span: &Span) -> &'a str {
        self.source.input().get(span.range.clone()).unwrap_or("")
    }

    fn kind(&mut self, kind: ScalarKind, decoded: Cow<'_, str>, span: &Span) -> RawKind {
        match kind {
            ScalarKind::String => {
                let written = self.written(span);
                let escaped = matches!(decoded, Cow::Owned(_));
                self.odd |= escaped && toml_1_1::string(written, span).is_some();
                RawKind::string(written, decoded.into_owned(), span)
            }
            ScalarKind::Integer(radix) => RawKind::integer(&decoded, radix.value()),
            ScalarKind::Float => RawKind::Float(decoded.into_owned()),
            ScalarKind::Boolean(truth) => RawKind::Boolean(truth),
            ScalarKind::DateTime => {
                self.odd = true;
                RawKind::Datetime
            }
        }
    }
}

impl EventReceiver for Plain<'_> {
    fn std_table_open(&mut self, place: Place, _: &mut dyn ErrorSink) {
        self.finish_section();
        self.heading = Some((self.span(place), Vec::new()));
        self.in_heading = true;
    }

    fn std_table_close(&mut self, place: Place, _: &mut dyn ErrorSink) {
        self.in_heading = false;
        if let Some((span, path)) = &mut self.heading {
            span.range.end = place.end();
            *path = std::mem::take(&mut self.keys);
            self.odd |= path.len() >= DEEPEST as usize;
        }
    }

    fn array_table_open(&mut self, _: Place, _: &mut dyn ErrorSink) {
        self.odd = true;
    }

    fn simple_key(&mut self, place: Place, quotes: Option<Encoding>, errors: &mut dyn ErrorSink) {
        let span = self.span(place);
        let mut key = Cow::Borrowed("");
        Raw::new_unchecked(self.written(&span), quotes, place).decode_key(&mut key, errors);
        self.keys.push((key.into_owned(), span));
    }

    fn key_sep(&mut self, _: Place, _: &mut dyn ErrorSink) {
        self.odd |= !self.in_heading;
    }

    fn scalar(&mut self, place: Place, quotes: Option<Encoding>, errors: &mut dyn ErrorSink) {
        let span = self.span(place);
        let mut decoded = Cow::Borrowed("");
        let raw = Raw::new_unchecked(self.written(&span), quotes, place);
        let kind = raw.decode_scalar(&mut decoded, errors);
        let kind = self.kind(kind, decoded, &span);
        self.value(RawValue { span, kind });
    }

    fn value_sep(&mut self, _: Place, _: &mut dyn ErrorSink) {
        self.comma = true;
    }

    fn newline(&mut self, _: Place, _: &mut dyn ErrorSink) {
        // TOML 1.1 allows it in an inline table
        self.odd |= self.open.last().is_some_and(|open| !open.list);
    }

    fn inline_table_open(&mut self, place: Place, _: &mut dyn ErrorSink) -> bool {
        self.comma = false;
        self.open.push(Open { start: place.start(), first: self.entries.len(), list: false });
        true
    }

    fn inline_table_close(&mut self, place: Place, _: &mut dyn ErrorSink) {
        let Some(Open { start, first, list: false }) = self.open.pop() else {
            self.odd = true;
            return;
        };
        self.odd |= self.comma; // TOML 1.1
        let span = Span::new(self.file, start..place.end());
        let entries = self.entries.drain(first..).collect();
        let kind = RawKind::Table(RawTable { span: span.clone(), entries });
        self.value(RawValue { span, kind });
    }

    fn array_open(&mut self, place: Place, _: &mut dyn ErrorSink) -> bool {
        self.open.push(Open { start: place.start(), first: self.values.len(), list: true });
        true
    }

    fn array_close(&mut self, place: Place, _: &mut dyn ErrorSink) {
        let Some(Open { start, first, list: true }) = self.open.pop() else {
            self.odd = true;
            return;
        };
        let span = Span::new(self.file, start..place.end());
        let kind = RawKind::Array(self.values.drain(first..).collect());
        self.value(RawValue { span, kind });
    }
}

/// The table below headings of this path, made if it is absent; `None` if it is a value.
fn below<'t>(
    mut table: &'t mut RawTable,
    path: Vec<(String, Span)>,
    text: &str,
) -> Option<&'t mut RawTable> {
    for (key, key_span) in path {
        let known = table.entries.iter().rposition(|entry| entry.key == key);
        let at = known.unwrap_or(table.entries.len());
        if known.is_none() {
            let span = key_span.clone();
            let kind = RawKind::Table(RawTable { span: span.clone(), entries: Vec::new() });
            table.entries.push(RawEntry { key, key_span, value: RawValue { span, kind } });
        }
        let RawKind::Table(inner) = &mut table.entries.get_mut(at)?.value.kind else { return None };
        if text.get(inner.span.range.clone())?.starts_with('{') {
            return None;
        }
        table = inner;
    }
    Some(table)
}

/// True if no table has a key twice.
fn unique(table: &RawTable) -> bool {
    let entries = &table.entries;
    let alone = match entries.len() {
        ..FEW => entries
            .iter()
            .enumerate()
            .all(|(at, entry)| entries.iter().take(at).all(|before| before.key != entry.key)),
        many => {
            let mut keys = HashSet::with_capacity(many);
            entries.iter().all(|entry| keys.insert(entry.key.as_str()))
        }
    };
    alone && entries.iter().all(|entry| inside_unique(&entry.value))
}

fn inside_unique(value: &RawValue) -> bool {
    match &value.kind {
        RawKind::Table(table) => unique(table),
        RawKind::Array(list) => list.iter().all(inside_unique),
        _ => true,
    }
}
