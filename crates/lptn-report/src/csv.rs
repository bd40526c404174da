//! Tables as CSV.

use std::borrow::Cow;
use std::io;

use lptn_solve::{Column, Table};

use crate::number::Shortest;
use crate::rows::{Cells, RowColumn, Rows};

/// Size in bytes from which text is passed on.
const CHUNK: usize = 1 << 13;

/// Writes the rows of a page.
pub(crate) fn write(rows: &Rows<'_>, out: &mut dyn io::Write) -> io::Result<()> {
    match rows {
        Rows::Table(table) => write_csv(table, out),
        Rows::Columns(columns) => write_columns(columns, out),
    }
}

/// Writes a table as CSV: a header such as `time [s],steel.T [degC]`, then one line per row.
/// Columns of words come first and have no unit. Every number reads back as the same `f64`.
///
/// # Errors
/// Errors of `out`.
pub fn write_csv(table: &Table, out: impl io::Write) -> io::Result<()> {
    let mut lines = Lines::new(out);
    table.labels().iter().for_each(|label| lines.word(&label.name));
    table.columns().iter().for_each(|column| lines.word(&Column::header(column)));
    lines.end()?;
    for row in 0..table.rows() {
        table.labels().iter().for_each(|label| lines.word(&label.cells[row]));
        table.row(row).for_each(|value| lines.number(value));
        lines.end()?;
    }
    lines.finish()
}

impl RowColumn<'_> {
    /// These columns as the bytes of a CSV file.
    pub fn csv(columns: &[RowColumn<'_>]) -> Vec<u8> {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write_columns(columns, &mut bytes));
        bytes
    }
}

fn write_columns(columns: &[RowColumn<'_>], out: impl io::Write) -> io::Result<()> {
    if columns.is_empty() {
        return Ok(());
    }
    let mut lines = Lines::new(out);
    columns.iter().for_each(|column| lines.word(&column.header()));
    lines.end()?;
    for row in 0..columns.first().map_or(0, RowColumn::rows) {
        for column in columns {
            match &column.cells {
                Cells::Words(texts) => lines.word(&texts[row]),
                Cells::Numbers(values) if !values[row].is_nan() => lines.number(values[row]),
                Cells::Counts(values) if !values[row].is_nan() => lines.whole(values[row] as u64),
                Cells::Numbers(_) | Cells::Counts(_) => lines.word(""),
            }
        }
        lines.end()?;
    }
    lines.finish()
}

/// Writes rows of texts, the heading first; all have the same length.
///
/// # Errors
/// Errors of the writer.
pub fn write_rows(rows: &[Vec<String>], out: impl io::Write) -> io::Result<()> {
    let mut lines = Lines::new(out);
    for row in rows {
        row.iter().for_each(|text| lines.word(text));
        lines.end()?;
    }
    lines.finish()
}

/// Lines of cells as text, for rows that are made one by one.
#[derive(Default)]
pub struct CsvLines {
    text: Vec<u8>,
    /// Index in `text` of the start of the present line.
    begin: usize,
    number: Shortest,
}

impl CsvLines {
    /// No line yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// A cell of any text.
    pub fn word(&mut self, text: &str) {
        self.cell(&quoted(text));
    }

    /// A cell of a text that needs no quotes.
    fn cell(&mut self, text: &str) {
        self.text.extend_from_slice(text.as_bytes());
        self.text.push(b',');
    }

    /// A number that reads back as the same `f64`.
    pub fn number(&mut self, value: f64) {
        self.text.extend_from_slice(self.number.text(value).as_bytes());
        self.text.push(b',');
    }

    /// A whole number, never with an exponent.
    pub fn whole(&mut self, value: u64) {
        const DIGITS: usize = 20;
        let (mut digits, mut at, mut left) = ([b'0'; DIGITS], DIGITS - 1, value);
        loop {
            digits[at] += (left % 10) as u8;
            left /= 10;
            if left == 0 {
                break;
            }
            at -= 1;
        }
        self.text.extend_from_slice(&digits[at..]);
        self.text.push(b',');
    }

    /// Ends the line. An empty one becomes `""`: a reader would not count it as a row.
    pub fn end(&mut self) {
        self.text.pop();
        if self.text.len() == self.begin {
            self.text.extend_from_slice(b"\"\"");
        }
        self.text.push(b'\n');
        self.begin = self.text.len();
    }

    /// Every line that was ended.
    pub fn into_bytes(self) -> Vec<u8> {
        self.text
    }
}

/// Lines of cells that are written to a stream.
struct Lines<W> {
    out: W,
    lines: CsvLines,
}

impl<W: io::Write> Lines<W> {
    fn new(out: W) -> Self {
        let text = Vec::with_capacity(CHUNK + CHUNK / 8);
        Self { out, lines: CsvLines { text, ..CsvLines::default() } }
    }

    fn word(&mut self, text: &str) {
        self.lines.word(text);
    }

    fn number(&mut self, value: f64) {
        self.lines.number(value);
    }

    fn whole(&mut self, value: u64) {
        self.lines.whole(value);
    }

    /// Ends the line, and passes the text on once it reaches `CHUNK`.
    fn end(&mut self) -> io::Result<()> {
        self.lines.end();
        if self.lines.text.len() >= CHUNK {
            self.out.write_all(&self.lines.text)?;
            self.lines.text.clear();
            self.lines.begin = 0;
        }
        Ok(())
    }

    fn finish(mut self) -> io::Result<()> {
        self.out.write_all(&self.lines.text)?;
        self.out.flush()
    }
}

/// A text as a cell: in quotes if it contains a comma, a quote or a line break.
fn quoted(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        return format!("\"{}\"", text.replace('"', "\"\"")).into();
    }
    text.into()
}
