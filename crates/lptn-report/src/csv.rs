//! Tables as CSV.

use std::io;

use lptn_solve::Table;

use crate::number::Shortest;

/// Writes a table as CSV: one header, `time [s]`, `steel.T [degC]` and so on, then one line a row. Every number
/// reads back as the same `f64`.
///
/// # Errors
/// What `out` reports.
pub fn write_csv(table: &Table, out: impl io::Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(table.columns().iter().map(lptn_solve::Column::header))?;
    let mut number = Shortest::new();
    for row in 0..table.rows() {
        for value in table.row(row) {
            writer.write_field(number.text(value))?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
}
