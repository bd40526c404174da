//! Tables as CSV.

use std::io;

use lptn_solve::Table;

use crate::number::Shortest;
use crate::page::Rows;

/// Writes the rows of a page.
pub(crate) fn write(rows: &Rows<'_>, out: &mut dyn io::Write) -> io::Result<()> {
    match rows {
        Rows::Table(table) => write_csv(table, out),
        Rows::Words(rows) => write_rows(rows, out),
    }
}

/// Writes a table as CSV: one header, `time [s]`, `steel.T [degC]` and so on, columns of words
/// without a unit first, then one line a row. Every number reads back as the same `f64`.
///
/// # Errors
/// What `out` reports.
pub fn write_csv(table: &Table, out: impl io::Write) -> io::Result<()> {
    numbers(table, &mut csv::Writer::from_writer(out)).map_err(io_error)
}

/// Writes rows of texts, the heading first; all of one length.
///
/// # Errors
/// What the writer reports.
pub fn write_rows(rows: &[Vec<String>], out: impl io::Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    rows.iter().try_for_each(|row| writer.write_record(row)).map_err(io_error)?;
    writer.flush()
}

fn numbers(table: &Table, writer: &mut csv::Writer<impl io::Write>) -> csv::Result<()> {
    let labels = table.labels().iter().map(|label| label.name.clone());
    writer.write_record(labels.chain(table.columns().iter().map(lptn_solve::Column::header)))?;
    let mut number = Shortest::new();
    for row in 0..table.rows() {
        for label in table.labels() {
            writer.write_field(&label.cells[row])?;
        }
        for value in table.row(row) {
            writer.write_field(number.text(value))?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    Ok(writer.flush()?)
}

/// The error of the stream itself, so that a closed pipe is known as one.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
