//! CSV files of points: like records, but their rows have no order.

use std::path::Path;

use crate::csv_form;
use crate::csv_head::{Head, Row, Wrong, number, reader, row};
use crate::diagnostic::{Diagnostic, arrange};
use crate::file::{FileId, Files, Span};
use crate::limits::shorten;
use crate::netlist::Rejected;
use crate::record::cells::{cold, extra_value, is_gap, no_number};
use crate::record::columns::{Chosen, all, of_any};
use crate::record::{Counted, RecordColumn};

/// A header as it could be.
const EXAMPLE: &str = "omega [rpm],P [W]";

/// Columns of numbers with units, and columns of words under headers without.
#[derive(Clone, Debug)]
pub struct DataSheet {
    /// The text it was read from.
    pub file: FileId,
    /// The place of the header.
    pub header: Span,
    /// The columns of numbers, each with a value for every row; as in a record, `K` alone is absolute and a gap is NaN.
    pub columns: Vec<RecordColumn>,
    /// The columns of words: name, and a text for every row.
    pub words: Vec<(String, Vec<String>)>,
    /// The place of each row.
    pub rows: Vec<Span>,
}

impl DataSheet {
    /// The column of numbers of this name.
    pub fn column(&self, name: &str) -> Option<&RecordColumn> {
        self.columns.iter().find(|column| column.name == name)
    }
}

/// Reads a CSV file of points. Comments, gaps, separators and units are treated as in a record.
///
/// # Errors
/// [`Rejected`] with every problem, each with a code `record::problem` and its line.
pub fn read_sheet(path: &Path, bytes: &[u8]) -> Result<(DataSheet, Files), Rejected> {
    let mut files = Files::new();
    match parse(&mut files, &path.display().to_string(), bytes) {
        Ok(sheet) => Ok((sheet, files)),
        Err(mut diagnostics) => {
            arrange(&files, &mut diagnostics);
            shorten(&mut diagnostics, 0);
            Err(Rejected { files, diagnostics, syntax: false })
        }
    }
}

fn parse(files: &mut Files, name: &str, bytes: &[u8]) -> Result<DataSheet, Vec<Diagnostic>> {
    let (file, text) = csv_form::text_of(files, name, bytes).map_err(|problem| vec![problem])?;
    let text = text.as_ref();
    let mut reader = reader(text);
    let mut records = reader.records().filter_map(Result::ok).peekable();
    let Some(head) = records.next() else { return Err(vec![empty(file, name)]) };
    let head = Head::new(file, &row(head, text));
    if let Some(problem) = csv_form::check(&head, (name, text), (csv_form::RECORD, EXAMPLE)) {
        return Err(vec![problem]);
    }
    let mut work = Work::new(head, records.peek())?;
    for cells in records {
        work.row(&row(cells, text));
    }
    work.finish()
}

fn empty(file: FileId, name: &str) -> Diagnostic {
    Diagnostic::error("record::empty", format!("{name} is empty"))
        .at(Span::new(file, 0..0), "the header belongs here")
        .help(format!("begin it with the names of the columns and their units: `{EXAMPLE}`"))
}

/// A file that is being read.
struct Work {
    head: Head,
    chosen: Vec<Chosen>,
    /// Positions of the columns of words.
    spoken: Vec<usize>,
    sheet: DataSheet,
    /// By column of numbers, then rows of the wrong length.
    wrong: Vec<Counted>,
}

impl Work {
    fn new(head: Head, first: Option<&csv::StringRecord>) -> Result<Self, Vec<Diagnostic>> {
        let numbers: Vec<usize> = all(&head, first, None).collect();
        let (mut chosen, mut problems) = (Vec::new(), Vec::new());
        for &index in &numbers {
            match of_any(&head, index) {
                Ok(column) => chosen.push(column),
                Err(problem) => problems.push(problem),
            }
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        let column = |chosen: &Chosen| RecordColumn {
            name: head.columns[chosen.index].name.clone(),
            unit: chosen.unit.clone(),
            values: Vec::new(),
            gaps: 0,
            saturation: None,
            span: head.columns[chosen.index].place.clone(),
        };
        let spoken: Vec<usize> = (0..head.columns.len()).filter(|index| !numbers.contains(index)).collect();
        let sheet = DataSheet {
            file: head.file(),
            header: head.place.clone(),
            columns: chosen.iter().map(column).collect(),
            words: spoken.iter().map(|&index| (head.columns[index].name.clone(), Vec::new())).collect(),
            rows: Vec::new(),
        };
        let wrong = (0..=chosen.len()).map(|_| Counted::default()).collect();
        Ok(Self { head, chosen, spoken, sheet, wrong })
    }

    fn row(&mut self, row: &Row) {
        let columns = self.head.columns.len();
        let file = self.sheet.file;
        let lengths = self.chosen.len();
        if let Some(extra) = (columns..row.cells.len()).find(|&index| !row.cell(index).is_empty()) {
            self.wrong[lengths].add(|| extra_value(&self.head, row, extra));
            return;
        }
        if row.cells.len() < columns {
            let message = format!("this row has {} of {columns} values", row.cells.len());
            self.wrong[lengths].add(|| {
                Diagnostic::error("record::short_row", message)
                    .at(row.whole(file), "")
                    .also(self.head.place.clone(), "the header")
                    .help("what was not measured is an empty cell between commas: `1000,,8.7`")
            });
            return;
        }
        self.sheet.rows.push(row.whole(file));
        for i in 0..self.chosen.len() {
            let value = self.value(i, row);
            let column = &mut self.sheet.columns[i];
            column.gaps += usize::from(value.is_nan());
            column.values.push(value);
        }
        for (words, &index) in self.sheet.words.iter_mut().zip(&self.spoken) {
            words.1.push(row.cell(index).to_owned());
        }
    }

    fn value(&mut self, i: usize, row: &Row) -> f64 {
        let Chosen { index, unit } = &self.chosen[i];
        let (head, cell) = (&self.head, row.cell(*index));
        match number(cell) {
            Ok(number) if !unit.ty.absolute || unit.to_si(number) >= 0.0 => return unit.to_si(number),
            Err(Wrong::Missing) => {}
            Err(_) if is_gap(cell) => {}
            Ok(_) => self.wrong[i].add(|| cold(head, row, (*index, &unit.text))),
            Err(wrong) => self.wrong[i].add(|| no_number(head, row, (*index, wrong))),
        }
        f64::NAN
    }

    fn finish(self) -> Result<DataSheet, Vec<Diagnostic>> {
        let told = self.wrong.into_iter().filter_map(|wrong| wrong.told("cell of this column"));
        let mut problems: Vec<Diagnostic> = told.collect();
        if problems.is_empty() && self.sheet.rows.is_empty() {
            let problem = Diagnostic::error("record::no_rows", "the file has a header and no rows");
            let problem = problem.at(self.head.place.clone(), "nothing stands below");
            problems.push(problem.help("write one point a line: `1000,8.7`"));
        }
        if problems.is_empty() { Ok(self.sheet) } else { Err(problems) }
    }
}
