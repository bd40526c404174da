//! Broken TOML, explained in the terms of a netlist.

use std::ops::Range;

use foldhash::{HashSet, HashSetExt as _};
use toml::de::Error;

use lptn_data::{Diagnostic, FileId, Span, on_borders};

use crate::duplicate;
use crate::format::NetlistFormat;
use crate::habit;
use crate::raw::RawTable;

const SYNTAX: &str = "netlist::syntax";

/// An unclosed part: the text after it is misread.
pub(crate) const NOT_CLOSED: &str = "netlist::not_closed";

/// Number of broken lines that are explained; further ones are only counted, as a file with more is
/// probably not a netlist.
const MOST_ERRORS: usize = 200;

/// Explains the parser's errors, one for each line: after the first the parser has lost its place
/// in the line.
pub(crate) fn explain(
    errors: &[Error],
    (file, format): (FileId, &NetlistFormat),
    text: &str,
    top: &RawTable,
) -> Vec<Diagnostic> {
    let mut lines = HashSet::new();
    let mut found: Vec<Diagnostic> = Vec::new();
    let mut unclosed = false;
    let breaks: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
    let places: Vec<(usize, &str, Place<'_>)> =
        errors.iter().map(|e| locate(e, file, (text, &breaks))).collect();
    let strings: HashSet<usize> = places
        .iter()
        .filter(|(_, message, _)| is_string(message))
        .map(|(line, ..)| *line)
        .collect();
    for (line, message, place) in places {
        // an unclosed inline table causes an error on every line up to the end
        let follows = unclosed && is_inside_table(message);
        let hidden = strings.contains(&line) && !is_string(message);
        if follows || hidden || !lines.insert(line) {
            continue;
        }
        if found.len() >= MOST_ERRORS {
            found.push(Diagnostic::error(SYNTAX, message).at(place.span(), ""));
            continue;
        }
        if let Some(habit) = habit::explain(&place.line(), (file, format), message) {
            found.push(habit);
            continue;
        }
        let breaks_off = place.line_before().trim().is_empty() || place.rest().is_empty();
        let brace = is_inside_table(message) && breaks_off;
        unclosed = brace || is_string(message);
        found.push(if brace { brace_missing(&place) } else { one(message, &place, top) });
    }
    if found.iter().any(|d| d.message.ends_with("is opened twice")) {
        // the fields below a heading that is opened twice are given twice for that reason
        found.retain(|d| d.code != duplicate::CODE || d.labels.len() > 1);
    }
    found
}

/// The line of an error from 0, its message and its place.
fn locate<'a>(
    error: &'a Error,
    file: FileId,
    (text, breaks): (&'a str, &[usize]),
) -> (usize, &'a str, Place<'a>) {
    let range = on_borders(text, error.span().unwrap_or(0..0));
    let line = breaks.partition_point(|at| *at < range.start);
    (line, error.message(), Place { file, text, range })
}

fn is_string(message: &str) -> bool {
    ["invalid basic string", "invalid literal string", "invalid multi-line"]
        .iter()
        .any(|s| message.starts_with(s))
}

fn is_inside_table(message: &str) -> bool {
    ["missing comma between", "missing key for inline", "unclosed inline", "missing assignment"]
        .iter()
        .any(|start| message.starts_with(start))
}

/// The place of an error.
struct Place<'a> {
    file: FileId,
    text: &'a str,
    range: Range<usize>,
}

impl Place<'_> {
    fn span(&self) -> Span {
        Span::new(self.file, self.range.clone())
    }

    fn fragment(&self) -> &str {
        self.text.get(self.range.clone()).unwrap_or("")
    }

    fn line_before(&self) -> &str {
        let before = self.text.get(..self.range.start).unwrap_or("");
        before.rsplit('\n').next().unwrap_or("")
    }

    /// The byte at which the line begins, and the whole line.
    fn line(&self) -> (usize, &str) {
        let start = self.range.start - self.line_before().len();
        (start, self.text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or(""))
    }

    fn rest(&self) -> &str {
        self.text.get(self.range.start..).unwrap_or("").trim()
    }
}

fn one(message: &str, place: &Place<'_>, top: &RawTable) -> Diagnostic {
    let error = |message: &str| Diagnostic::error(SYNTAX, message);
    let here = || place.span();
    let says = |start: &str| message.starts_with(start);
    if says("duplicate key") {
        duplicate::explain(place.text, &here(), top)
    } else if says("string values must be quoted") {
        unquoted(place)
    } else if says("cannot extend value of type") {
        error(&format!("`{}` has a value already and cannot have fields as well", place.fragment()))
            .at(here(), "used as a table here")
            .help("give all its fields in one place")
    } else if says("unclosed table") || says("unclosed array of tables") {
        Diagnostic::error(NOT_CLOSED, "heading without its closing bracket")
            .at(here(), "`]` is missing here")
            .help("write it like this: `[resistor]`")
    } else if is_string(message) {
        string_open(place)
    } else if let Some(found) = name_in_two(place).or_else(|| odd_letter(message, place)) {
        found
    } else if says("key with no value")
        || says("missing assignment")
        || says("missing value for key")
    {
        error("key without a value")
            .at(here(), "`=` and a value are missing here")
            .help("an entry is `name = value`, a heading `[name]`; a comment begins with `#`")
    } else if says("missing comma between key-value") {
        error("two fields without a comma between them")
            .at(here(), "a comma is missing before this")
            .help("separate fields by commas: `{ from = \"a\", to = \"b\" }`")
    } else if says("unexpected key or value") {
        error("there is text after the end of the entry")
            .at(here(), "does not belong to it")
            .help("begin a new line here; a comment begins with `#`")
    } else if says("extra `=`") {
        error("a second `=`").at(here(), "remove this")
    } else if says("unexpected leading zero") {
        error("number with a zero in front").at(here(), "remove this zero")
    } else if says("missing escaped value") {
        let path = [".csv", ".toml", ".json"]
            .iter()
            .any(|ending| place.line().1.to_lowercase().contains(ending));
        error("backslash that begins no escape").at(here(), "after this backslash").help(match path
        {
            true => "write the path with `/`: \"records/bench.csv\"",
            false => "write two backslashes, or put the string in single quotes: 'a\\b'",
        })
    } else {
        error(&message.replacen("unquoted keys", "keys", 1)).at(here(), "")
    }
}

/// `steel part = …`: a name with a blank in it.
fn name_in_two(place: &Place<'_>) -> Option<Diagnostic> {
    let (start, line) = place.line();
    let (name, _) = line.split_once('=')?;
    let words: Vec<&str> = name.split_whitespace().collect();
    let plain = |word: &&str| word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if words.len() < 2 || !words.iter().all(plain) {
        return None;
    }
    let from = start + (name.len() - name.trim_start().len());
    let span = Span::new(place.file, from..start + name.trim_end().len());
    let help = format!("write it in one word: `{}`", words.join("_"));
    Some(Diagnostic::error(SYNTAX, "name with a blank in it").at(span, "").help(help))
}

/// A letter that names cannot contain: `gehäuse`.
fn odd_letter(message: &str, place: &Place<'_>) -> Option<Diagnostic> {
    if !message.starts_with("invalid unquoted key") {
        return None;
    }
    let help = "names are made of the letters a to z and A to Z, digits and `_`: `gehaeuse`, `T_1`";
    Some(Diagnostic::error(SYNTAX, "name with an invalid letter").at(place.span(), "").help(help))
}

/// The most common first mistake: a quantity without quotes.
fn unquoted(place: &Place<'_>) -> Diagnostic {
    let fragment = place.fragment();
    if fragment.trim().is_empty() {
        return value_missing(place);
    }
    // quotes of word processors, and quotes that were opened and not closed
    let bare = fragment.trim_matches(|c: char| c.is_whitespace() || "\"'“”„‘’«»".contains(c));
    Diagnostic::error("netlist::unquoted", "text without quotes")
        .at(place.span(), "has to be in straight double quotes")
        .help(format!("write \"{}\"", bare.replace('"', "")))
}

fn value_missing(place: &Place<'_>) -> Diagnostic {
    Diagnostic::error(SYNTAX, "key without a value")
        .at(place.span(), "a value is missing here")
        .help("write a string, such as \"25 degC\", or a number")
}

/// A string that is still open at the end of its line.
fn string_open(place: &Place<'_>) -> Diagnostic {
    let before = place.line_before();
    if before.trim_end().ends_with('=') {
        return value_missing(place); // the parser takes what follows for the rest of a string
    }
    let start =
        place.range.start - before.len() + before.rfind(['"', '\'']).unwrap_or(before.len());
    let span = Span::new(place.file, start..place.range.start.max(start));
    Diagnostic::error(NOT_CLOSED, "string without its closing quote")
        .at(span, "this is not closed on its line")
        .help("a string begins and ends with a quote: `R = \"0.3 K/W\"`")
}

/// An inline table that is still open at the end of its line.
fn brace_missing(place: &Place<'_>) -> Diagnostic {
    let before = place.text.get(..place.range.start).unwrap_or("");
    let brace = before.rfind('{').map_or(place.range.start..place.range.start, |at| at..at + 1);
    Diagnostic::error(NOT_CLOSED, "inline table without its closing brace")
        .at(Span::new(place.file, brace), "`}` is missing on this line")
        .help("close it on the line it begins on: `{ from = \"a\", to = \"b\", R = \"0.3 K/W\" }`")
}
