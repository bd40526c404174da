//! How a CSV file was saved: what its first lines say when that was done otherwise than with one header, commas and
//! decimal points. Records, sheets of points, signals, tables and imports are told the same.

use std::sync::Arc;

use lptn_units::Unit;

use crate::csv_head::{Head, Row, reader, row};
use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Files, Span};

/// The codes of an area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Codes {
    separator: &'static str,
    no_header: &'static str,
    /// Whether a command line names the file, and not a netlist.
    of_record: bool,
}

/// Of records and sheets of points.
pub(crate) const RECORD: Codes =
    Codes { separator: "record::separator", no_header: "record::no_header", of_record: true };

/// Of the files that a netlist names.
pub(crate) const NETLIST: Codes =
    Codes { separator: "netlist::csv_separator", no_header: "netlist::csv_no_header", of_record: false };

/// Titles of loggers are not longer than this, in lines.
const LONGEST_TITLE: usize = 30;

/// What the header says of how the file was saved: with another separator, without names, below a title. `example` is
/// a header as it could be.
pub(crate) fn check(
    head: &Head,
    (name, text): (&str, &str),
    (codes, example): (Codes, &str),
) -> Option<Diagnostic> {
    if head.columns.iter().all(|header| header.written.replace(',', ".").parse::<f64>().is_ok()) {
        let problem = Diagnostic::error(codes.no_header, "the first line holds numbers, not names")
            .at(head.place.clone(), "the header belongs above this line");
        return Some(
            problem.help(format!("begin with the names of the columns and their units: `{example}`")),
        );
    }
    if let Some(problem) = foreign(head, name, codes) {
        return Some(problem);
    }
    let mut reader = reader(text);
    let records = reader.records().filter_map(Result::ok).skip(1).take(LONGEST_TITLE);
    let rows: Vec<Row> = records.map(|cells| row(cells, text)).collect();
    separator(head, name, (&rows, codes)).or_else(|| title(head, &rows, codes))
}

/// A netlist, or a file of another kind.
fn foreign(head: &Head, name: &str, codes: Codes) -> Option<Diagnostic> {
    let first = head.columns.first()?.written.as_str();
    let heading = first.starts_with('[') && first.ends_with(']');
    let (is, help) = if heading || first.starts_with("format = ") || first.starts_with("format=") {
        let help = match codes.of_record {
            true => format!(
                "`lptn fit network {name}` fits a netlist to the records that it names below [fit.NAME]"
            ),
            false => "name a CSV file here; other netlists stand in `include`".to_owned(),
        };
        ("a netlist", help)
    } else if first.starts_with('{') || first == "[" {
        ("JSON", "name a CSV file, such as the `result.csv` that `lptn run` writes".to_owned())
    } else {
        return None;
    };
    let problem = Diagnostic::error(codes.no_header, format!("{name} is not a CSV file: it looks like {is}"));
    Some(problem.at(head.place.clone(), "taken for the header").help(help))
}

/// The columns are separated by something else.
fn separator(head: &Head, name: &str, (rows, codes): (&[Row], Codes)) -> Option<Diagnostic> {
    let [one] = head.columns.as_slice() else { return None };
    let other = [';', '\t', '|'].into_iter().find(|c| one.written.contains(*c))?;
    let words = if other == '\t' { "tabs".to_owned() } else { format!("`{other}`") };
    let pattern = if other == '\t' { "\\t".to_owned() } else { other.to_string() };
    let decimal = rows.first().is_some_and(|row| row.cells.len() > 1);
    let typed = name.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
    let name = if typed { name } else { "record.csv" };
    let message = format!("the columns are separated by {words}, not by commas");
    let problem =
        Diagnostic::error(codes.separator, message).at(one.place.clone(), "one column, as it stands");
    Some(match decimal {
        true => problem.help(format!(
            "save it with commas between the columns and decimal points, or change both:\n\
             sed 's/,/./g; s/{pattern}/,/g' {name} > with_commas.csv"
        )),
        false => problem.help(format!(
            "save it with commas between the columns, or change them:\n\
             sed 's/{pattern}/,/g' {name} > with_commas.csv"
        )),
    })
}

/// A line above the one that names the columns.
fn title(head: &Head, rows: &[Row], codes: Codes) -> Option<Diagnostic> {
    if head.columns.iter().any(|header| header.unit.is_some()) {
        return None;
    }
    let below = rows.iter().find(|row| names_columns(row, head.file()))?;
    let problem =
        Diagnostic::error(codes.no_header, "the first line is not the header: another one names the columns")
            .at(head.place.clone(), "taken for the header")
            .also(below.whole(head.file()), "the header");
    Some(problem.help("put `#` before the lines above the header, or remove them"))
}

/// A line of names with units.
fn names_columns(row: &Row, file: FileId) -> bool {
    let columns = Head::new(file, row).columns;
    let named = columns.iter().all(|header| header.written.parse::<f64>().is_err());
    let unit = |unit: &str| unit == "-" || Unit::parse(unit).is_ok();
    named && columns.iter().any(|header| header.unit.as_deref().is_some_and(unit))
}

/// The name and the unit of `ring (degC)`, `ring/degC`, `ring_degC`.
pub(crate) fn other_brackets(name: &str) -> Option<(&str, &str)> {
    let at = name.find(['(', '/', ',', '{']).or_else(|| name.rfind(['_', ' ']))?;
    let (bare, unit) = name.split_at(at);
    let unit = unit.trim_matches(['(', ')', '/', ',', '{', '}', '_', ' ']);
    let unit = if matches!(unit, "C" | "°C") { "degC" } else { unit };
    (!bare.trim().is_empty() && Unit::parse(unit).is_ok()).then_some((bare.trim(), unit))
}

/// What to do about a row with more values than the header has columns: with a decimal comma every number is two.
pub(crate) fn extra_help(row: &Row) -> &'static str {
    let whole = |i: usize| {
        let cell = row.cell(i).trim_start_matches(['+', '-']);
        !cell.is_empty() && cell.chars().all(|c| c.is_ascii_digit())
    };
    let halves = (1..row.cells.len()).any(|i| whole(i - 1) && whole(i));
    match halves {
        true => "write decimal points, not commas: `25.5`; with a comma every number is two",
        false => "name every column in the header",
    }
}

/// What to write in place of a text where a number is due.
pub(crate) fn text_help(name: &str, cell: &str) -> String {
    let point = cell.replacen(',', ".", 1);
    if cell.contains(',') && point.parse::<f64>().is_ok() {
        return format!("write numbers with a point: `{point}`");
    }
    if is_moment(cell) {
        return format!(
            "times are numbers counted from any moment, in one unit: `{name} [s]`, not clock times or dates"
        );
    }
    if cell.contains(';') {
        return "the columns are separated by `;` in this row: write commas".to_owned();
    }
    let number: String = cell.chars().take_while(|c| c.is_ascii_digit() || "+-.".contains(*c)).collect();
    let unit = cell.get(number.len()..).unwrap_or_default().trim();
    if !number.is_empty() && number.parse::<f64>().is_ok() && Unit::parse(unit).is_ok() {
        return format!("write the unit once, in the header: `{name} [{unit}]`");
    }
    "a cell holds one number; its unit stands in the header".to_owned()
}

/// A clock time or a date: `12:00:05`, `2024-05-03`, `03.05.2024`, `3/5/2024`.
fn is_moment(cell: &str) -> bool {
    let digits = cell.starts_with(|c: char| c.is_ascii_digit());
    let twice = |c: char| cell.matches(c).count() == 2;
    digits && (cell.contains(':') || twice('-') || twice('/') || twice('.')) && cell.parse::<f64>().is_err()
}

/// A file that is not text in UTF-8.
fn not_text(files: &Files, file: FileId, (name, bytes): (&str, &[u8])) -> Diagnostic {
    let text = files.text(file);
    let at = text.find(char::REPLACEMENT_CHARACTER).unwrap_or(0);
    let end = at + text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    let wide = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    let sheet = bytes.starts_with(b"PK\x03\x04");
    let why = match (wide, sheet) {
        (true, _) => ": it looks like UTF-16",
        (_, true) => ": it looks like a workbook or a zip file",
        _ => "",
    };
    // the degree sign of the encodings of Western Europe
    let degree = bytes.contains(&0xb0) || bytes.contains(&0xf8);
    let help = match degree && !wide && !sheet {
        true => "write `degC` for the degree sign, or save it as `CSV UTF-8`",
        false => "choose `CSV UTF-8` where your program saves it",
    };
    Diagnostic::error("netlist::not_text", format!("{name} is not a text file in UTF-8{why}"))
        .at(Span::new(file, at..end), "")
        .help(help)
}

/// The text of a CSV file, kept among others, or that it is not text.
pub(crate) fn text_of(files: &mut Files, name: &str, bytes: &[u8]) -> Result<(FileId, Arc<str>), Diagnostic> {
    match std::str::from_utf8(bytes) {
        Ok(text) if !text.contains('\0') => {
            let text: Arc<str> = text.into();
            Ok((files.add(name, Arc::clone(&text)), text))
        }
        _ => {
            let file = files.add(name, String::from_utf8_lossy(bytes).replace('\0', " "));
            Err(not_text(files, file, (name, bytes)))
        }
    }
}
