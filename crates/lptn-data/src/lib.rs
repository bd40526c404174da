//! Inputs and their diagnostics: texts with places ([`Files`], [`Span`]), the one [`Diagnostic`],
//! and the one reader of CSV files. Headers have units, `speed [rpm]`; errors name their line.
//!
//! A file need not be in lptn's own form: `dialect` finds the separator and the header of the file
//! of a logger, `numeral` its decimal sign, `decode` its encoding; `clock` turns dates into seconds.
//!
//! There are four ways to read a file, with the same header, numbers and checks of its form: as
//! columns over time ([`read_record`]), as points without an order ([`read_sheet`]), one column
//! after the other ([`CsvFile`]), or row by row without storing it ([`CsvRows`]). A matrix
//! ([`CsvMatrix`]) has arguments instead of a header. A record that
//! grows is read line by line ([`RecordLines`]).
//!
//! Diagnostics are in this crate because they refer to texts, and no lower crate has one.

mod ambiguous;
mod clock;
mod csv_file;
mod decimal;
mod decode;
mod diagnostic;
mod dialect;
mod file;
mod form;
mod gap;
mod head;
mod head_errors;
mod hints;
mod limits;
mod matrix;
mod moment;
mod numeral;
mod open;
mod options;
mod reader;
mod record;
mod rows;
mod spelling;
mod text;
mod words;

pub use csv_file::{CsvFile, PlacedNumbers, Places};
pub use decode::Encoding;
pub use diagnostic::{Diagnostic, Label, Severity, arrange};
pub use file::{CopyId, FileId, Files, Instance, Span, on_borders};
pub use head::{Asked, CsvColumn, Wrong, fit};
pub use hints::{revolutions_option, unit_option};
pub use limits::{
    MOST_BYTES, MOST_CSV_BYTES, MOST_PROBLEMS, ReadError, Rejected, read_bytes, read_named, shorten,
};
pub use matrix::CsvMatrix;
pub use moment::{DATE_ORDERS, DateOrder};
pub use numeral::{DECIMALS, Decimal};
pub use options::CsvOptions;
pub use record::{
    DataSheet, Record, RecordColumn, RecordLine, RecordLines, RecordName, RecordQuery, RecordRow,
    Saturation, read_record, read_sheet, read_text,
};
pub use rows::{CsvRows, Marks};
pub use text::CsvText;
pub use words::{list, nearest};
