//! Measured records: columns of numbers over time, from a CSV file with headers `name [unit]`.
//!
//! A problem with a record is an error with its line. If reading can go on, it does so in a stated
//! way, with a warning:
//!
//! | In the file | Treatment |
//! |---|---|
//! | lines that begin with `#`, empty lines, Windows line ends, a byte order mark | left out |
//! | an empty cell, `NaN`, `NA`, `N/A`, `null`, dashes | a gap: NaN, counted in a warning |
//! | a last line that breaks off | left out, with a warning |
//! | the same line twice in a row | dropped, with a warning |
//! | a time twice with other values, below the one before it, or none | an error with both lines |
//! | more than 5 times the usual time between two rows | a warning |
//! | a header without unit, a unit in a cell, text among numbers | an error |
//! | another separator, decimal commas, titles, dates | read, with a note |
//! | a value below absolute zero | an error |
//! | a jump by 273.15 K, or to 1.8 times the value + 32 | a warning: the unit seems to change |
//! | an extreme value kept after a steep rise or fall | a warning: the sensor may be at its end |
//! | a value far outside of those before and after it | a warning; a gap on request |
//! | a temperature that jumps to a number and repeats it | the same |
//! | a column that does not change | a warning |

mod cells;
mod columns;
mod doubts;
mod lines;
pub(crate) mod outliers;
mod rows;
mod sheet;
mod spikes;
mod stuck;
mod times;

pub use lines::{RecordLine, RecordLines, RecordRow};
pub use sheet::{DataSheet, read_sheet};

use std::path::Path;

use lptn_units::{Type, Unit};

use crate::diagnostic::{Diagnostic, Severity};
use crate::file::{FileId, Files, Span};
use crate::limits::Rejected;
use crate::options::CsvOptions;
use crate::text::CsvText;

/// A column to look for in a record.
#[derive(Clone, Debug)]
pub struct RecordName {
    /// The name of a column, as its header gives it without the unit.
    pub name: String,
    /// The type of its quantity, if that is known.
    pub ty: Option<Type>,
    /// The place of the request, for diagnostics.
    pub span: Option<Span>,
}

impl RecordName {
    /// A column of any type, without a place of the request.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ty: None, span: None }
    }
}

/// A request for parts of a record.
#[derive(Clone, Debug, Default)]
pub struct RecordQuery {
    /// The column of the times; by default the first in a unit of time, else the one named `t` or
    /// `time`.
    pub time: Option<RecordName>,
    /// The columns to read, in this order; by default all columns of numbers in the order of the
    /// file.
    pub columns: Vec<RecordName>,
    /// Rows before this time, in s, are left out, whatever their values.
    pub from: Option<f64>,
    /// Rows after this time, in s, are left out.
    pub to: Option<f64>,
    /// True if outliers become gaps.
    pub drop_outliers: bool,
    /// Statements about the form of the file.
    pub csv: CsvOptions,
    /// True for the result of a run, where `K` alone is a difference except in columns named
    /// `NODE.T`. A sensor does not measure differences.
    pub of_run: bool,
}

/// Columns of numbers over time.
#[derive(Clone, Debug)]
pub struct Record {
    /// The text it was read from.
    pub file: FileId,
    /// The times in s, each above the one before it; at least one.
    pub time: Vec<f64>,
    /// The name of the column of times.
    pub time_name: String,
    /// The other columns.
    pub columns: Vec<RecordColumn>,
    /// The lines that begin with `#`, without it and without blanks around.
    pub comments: Vec<String>,
    /// Warnings about what was left out or is doubtful.
    pub warnings: Vec<Diagnostic>,
    /// The names of columns that were left out because they have no unit.
    pub unitless: Vec<String>,
    /// The byte at which the reader started to look for each row.
    pub(crate) bytes: Vec<usize>,
}

/// One column of a [`Record`].
#[derive(Clone, Debug)]
pub struct RecordColumn {
    /// Its name, without the unit.
    pub name: String,
    /// Its unit; `K` alone is an absolute temperature, as degC is.
    pub unit: Unit,
    /// One value for each time, in SI units, absolute temperatures in K; NaN for a gap.
    pub values: Vec<f64>,
    /// Number of gaps.
    pub gaps: usize,
    /// An extreme value at which the sensor seems to be at its end.
    pub saturation: Option<Saturation>,
    /// The place of the header.
    pub span: Span,
}

/// A value that a column reaches steeply and at which it stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saturation {
    /// The value, in SI units.
    pub value: f64,
    /// The first row with it.
    pub first: usize,
    /// The last row of the same run.
    pub last: usize,
}

impl Record {
    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<&RecordColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// The columns of absolute temperatures, in order.
    pub fn temperatures(&self) -> impl Iterator<Item = &RecordColumn> {
        self.columns.iter().filter(|column| column.unit.ty.absolute)
    }

    /// The place of a row, counted from 0; `files` are those it was read with.
    pub fn line(&self, files: &Files, row: usize) -> Span {
        self.line_in(files.text(self.file), row)
    }

    /// The place of a row, in the text it was read from.
    pub(crate) fn line_in(&self, text: &str, row: usize) -> Span {
        let from = self.bytes.get(row).copied().unwrap_or(text.len());
        Span::new(self.file, crate::reader::line(text, from))
    }
}

/// The part of a record that a text contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    Whole,
    /// Some of its rows: no row, or no value of a column, is not an error.
    Part,
}

/// Reads a record from the bytes of a file; `path` is its name in diagnostics.
///
/// # Errors
/// [`Rejected`] with every problem, each with a code `record::problem` and its line.
pub fn read_record(
    path: &Path,
    bytes: &[u8],
    query: &RecordQuery,
) -> Result<(Record, Files), Rejected> {
    let mut files = Files::new();
    let text =
        CsvText::of(&mut files, path.display().to_string(), bytes).map_err(|problem| vec![problem]);
    match text.and_then(|text| read_text(&text, query)) {
        Ok(record) => Ok((record, files)),
        Err(diagnostics) => Err(Rejected::new(files, diagnostics)),
    }
}

/// Reads a record from a text, with warnings about doubtful values.
///
/// # Errors
/// Every problem, each with a code `record::problem` and its line.
pub fn read_text(text: &CsvText, query: &RecordQuery) -> Result<Record, Vec<Diagnostic>> {
    let mut record = rows::read(text, query, Extent::Whole)?;
    let text = &text.text;
    let holes = times::holes(&record, text);
    record.warnings.extend(holes);
    let gaps = doubts::gaps(&record, text);
    record.warnings.extend(gaps);
    for i in 0..record.columns.len() {
        let outliers = doubts::outliers(&record, &record.columns[i]);
        let (saturation, warnings) = doubts::of(&record, &record.columns[i], (&outliers, text));
        record.columns[i].saturation = saturation;
        record.warnings.extend(doubts::outlying(
            &record,
            i,
            (&outliers, query.drop_outliers),
            text,
        ));
        for row in outliers.into_iter().filter(|_| query.drop_outliers) {
            record.columns[i].values[row] = f64::NAN;
        }
        record.warnings.extend(warnings);
    }
    debug_assert!(record.warnings.iter().all(|warning| warning.severity != Severity::Error));
    record.warnings.sort_by_key(|warning| warning.place().map(Span::order));
    Ok(record)
}
