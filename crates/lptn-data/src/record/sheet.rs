//! CSV files of points: like records, but their rows have no order.

use std::path::Path;

use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Files, Span};
use crate::head::row;
use crate::hints;
use crate::limits::Rejected;
use crate::open::open;
use crate::options::CsvOptions;
use crate::record::RecordColumn;
use crate::record::cells::Cells;
use crate::record::columns::{all, each, of_any};
use crate::text::CsvText;

/// An example of a header.
const EXAMPLE: &str = "omega [rpm],P [W]";

/// Columns of numbers with units, and columns of words under headers without.
#[derive(Clone, Debug)]
pub struct DataSheet {
    /// The text it was read from.
    pub file: FileId,
    /// The place of the header.
    pub header: Span,
    /// The columns of numbers, each with a value for every row; as in a record, `K` alone is
    /// absolute and a gap is NaN.
    pub columns: Vec<RecordColumn>,
    /// The columns of words: name, and a text for every row.
    pub words: Vec<(String, Vec<String>)>,
    /// The place of each row.
    pub rows: Vec<Span>,
    /// The note about a file that is not in lptn's own form.
    pub note: Option<Diagnostic>,
}

impl DataSheet {
    /// The column of numbers of this name.
    pub fn column(&self, name: &str) -> Option<&RecordColumn> {
        self.columns.iter().find(|column| column.name == name)
    }
}

/// Reads a CSV file of points. Comments, gaps, separators and units are treated as in a record.
/// `options` are the statements about its form; dates have no place in it.
///
/// # Errors
/// [`Rejected`] with every problem, each with a code `record::problem` and its line.
pub fn read_sheet(
    path: &Path,
    bytes: &[u8],
    options: &CsvOptions,
) -> Result<(DataSheet, Files), Rejected> {
    let mut files = Files::new();
    match parse(&mut files, (&path.display().to_string(), bytes), options) {
        Ok(sheet) => Ok((sheet, files)),
        Err(diagnostics) => Err(Rejected::new(files, diagnostics)),
    }
}

fn parse(
    files: &mut Files,
    (name, bytes): (&str, &[u8]),
    options: &CsvOptions,
) -> Result<DataSheet, Vec<Diagnostic>> {
    let text = CsvText::of(files, name.to_owned(), bytes).map_err(|problem| vec![problem])?;
    let head = open(&text, options, (hints::RECORD, EXAMPLE));
    let head = head.map_err(|problem| vec![problem])?;
    let note = head.note(&text, Vec::new());
    let mut records = head.reader(&text.text).peekable();
    let numbers: Vec<usize> = all(&head, records.peek(), None).collect();
    let spoken: Vec<usize> =
        (0..head.columns.len()).filter(|index| !numbers.contains(index)).collect();
    let mut words: Vec<(String, Vec<String>)> =
        spoken.iter().map(|&index| (head.columns[index].name.clone(), Vec::new())).collect();
    let chosen = each(numbers.into_iter().map(|index| of_any(&head, index, false)))?;
    let (mut cells, mut rows) = (Cells::new(head, chosen), Vec::new());
    for record in records {
        let row = row(record, &text.text);
        if cells.is_whole(&row, "1000,,8.7") {
            rows.push(row.whole(text.file));
            cells.push(&row);
            for ((_, words), &index) in words.iter_mut().zip(&spoken) {
                words.push(row.cell(index).to_owned());
            }
        }
    }
    let (mut problems, columns, head) = cells.finish();
    if problems.is_empty() && rows.is_empty() {
        let problem = Diagnostic::error("record::no_rows", "the file has a header and no rows");
        let problem = problem.at(head.place.clone(), "nothing below it");
        problems.push(problem.help("write one point a line: `1000,8.7`"));
    }
    let sheet = DataSheet { file: text.file, header: head.place, columns, words, rows, note };
    if problems.is_empty() { Ok(sheet) } else { Err(problems) }
}
