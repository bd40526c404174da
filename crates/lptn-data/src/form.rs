//! The form of a CSV file: an error if its first lines are not one header with commas and decimal
//! points. Records, sheets of points, signals, tables and imports share these messages.

use lptn_units::Unit;

use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::file::{FileId, Span};
use crate::head::{Head, Row, row};
use crate::hints::{Codes, RECORD};
use crate::reader::Reader;
use crate::text::CsvText;

/// Greatest length of a logger's title, in lines.
const LONGEST_TITLE: usize = 30;

/// The error that the first lines show: another separator, no names, a title above the header.
/// `example` is an example of a header.
fn check(head: &Head, text: &CsvText, (codes, example): (&Codes, &str)) -> Option<Diagnostic> {
    if head.columns.iter().all(|header| header.written.replace(',', ".").parse::<f64>().is_ok()) {
        let problem = Diagnostic::error(
            codes.no_header,
            "the first line contains numbers, not \
            names",
        )
        .at(head.place.clone(), "the header belongs above this line");
        return Some(
            problem
                .help(format!("begin with the names of the columns and their units: `{example}`")),
        );
    }
    if let Some(problem) = matrix(head, codes) {
        return Some(problem);
    }
    if let Some(problem) = foreign(head, &text.name, codes) {
        return Some(problem);
    }
    let records = Reader::rows(&text.text, &Dialect::PLAIN).take(LONGEST_TITLE);
    let rows: Vec<Row> = records.map(|cells| row(cells, &text.text)).collect();
    separator(head, &text.name, (&rows, codes)).or_else(|| title(head, &rows, codes))
}

/// A matrix that is read as columns: numbers from the second column on.
fn matrix(head: &Head, codes: &Codes) -> Option<Diagnostic> {
    let (_, numbers) = head.columns.split_first()?;
    let is_number = |text: &str| text.replace(',', ".").parse::<f64>().is_ok();
    let is_matrix = numbers.len() > 1 && numbers.iter().all(|header| is_number(&header.written));
    if codes.of_record || !is_matrix {
        return None;
    }
    let message = "the first line contains numbers, not names";
    let problem = Diagnostic::error(codes.no_header, message).at(head.place.clone(), "");
    Some(problem.help(
        "for a [table] with arguments in its first row and column write `layout = \"matrix\"`, with \
         headings such as `x = \"speed [rpm]\"`, `y = \"torque [N m]\"`, `value = \"loss [W]\"`",
    ))
}

/// A netlist, or a file of another kind.
fn foreign(head: &Head, name: &str, codes: &Codes) -> Option<Diagnostic> {
    let first = head.columns.first()?.written.as_str();
    let heading = first.starts_with('[') && first.ends_with(']');
    let (is, help) = if heading || first.starts_with("format = ") || first.starts_with("format=") {
        let help = match codes.of_record {
            true => format!(
                "`lptn fit network {name}` fits a netlist to the records that it names below \
                 [fit.NAME]"
            ),
            false => "name a CSV file here; other netlists belong in `include`".to_owned(),
        };
        ("a netlist", help)
    } else if first.starts_with('{') || first == "[" {
        ("JSON", "name a CSV file, such as the `result.csv` that `lptn run` writes".to_owned())
    } else {
        return None;
    };
    let problem =
        Diagnostic::error(codes.no_header, format!("{name} is not a CSV file: it looks like {is}"));
    Some(problem.at(head.place.clone(), "taken for the header").help(help))
}

/// The error of another separator between the columns.
pub(crate) fn separator(
    head: &Head,
    name: &str,
    (rows, codes): (&[Row], &Codes),
) -> Option<Diagnostic> {
    let [one] = head.columns.as_slice() else { return None };
    let other = [';', '\t', '|'].into_iter().find(|c| one.written.contains(*c))?;
    let words = if other == '\t' { "tabs".to_owned() } else { format!("`{other}`") };
    let pattern = if other == '\t' { "\\t".to_owned() } else { other.to_string() };
    let decimal = rows.first().is_some_and(|row| row.cells.len() > 1);
    let typed = name.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
    let name = if typed { name } else { "record.csv" };
    let message = format!("the columns are separated by {words}, not by commas");
    let problem =
        Diagnostic::error(codes.separator, message).at(one.place.clone(), "one column, as written");
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
fn title(head: &Head, rows: &[Row], codes: &Codes) -> Option<Diagnostic> {
    if head.columns.iter().any(|header| header.unit.is_some()) {
        return None;
    }
    let below = rows.iter().find(|row| names_columns(row, head.file()))?;
    let problem = Diagnostic::error(
        codes.no_header,
        "the first line is not the header: another one names the columns",
    )
    .at(head.place.clone(), "taken for the header")
    .also(below.whole(head.file()), "the header");
    Some(problem.help("put `#` before the lines above the header, or remove them"))
}

/// A line of names with units.
fn names_columns(row: &Row, file: FileId) -> bool {
    let columns = Head::new(file, row, RECORD).columns;
    let named = columns.iter().all(|header| header.written.parse::<f64>().is_err());
    let unit = |unit: &str| unit == "-" || Unit::parse(unit).is_ok();
    named && columns.iter().any(|header| header.unit.as_deref().is_some_and(unit))
}

/// The header of a text in lptn's own form; `example` is an example of a header.
pub(crate) fn plain_header(
    text: &CsvText,
    (codes, example): (&'static Codes, &str),
) -> Result<Head, Diagnostic> {
    let Some(first) = Reader::header(&text.text, &Dialect::PLAIN).next() else {
        let problem = Diagnostic::error(codes.empty, format!("{} has no header", text.name))
            .at(Span::new(text.file, 0..0), "the header belongs here");
        return Err(problem
            .help(format!("begin it with the names of the columns and their units: `{example}`")));
    };
    let head = Head::new(text.file, &row(first, &text.text), codes);
    match check(&head, text, (codes, example)) {
        Some(problem) => Err(problem),
        None => Ok(head),
    }
}
