//! What a command has to say, and the formats in which it can say it.

use std::borrow::Cow;
use std::io::{self, Write};

use lptn_solve::Table;

use crate::json::Json;
use crate::text::Text;
use crate::{csv, json, text};

/// What a command has to say, for readers and for programs. Each format asks only for what it writes.
pub trait Page {
    /// For reading: title, tables, notes, verdict.
    fn text(&self) -> Text;

    /// For spreadsheets and plots: rows of exact numbers. There are none unless this is given.
    fn rows(&self) -> Rows<'_> {
        Rows::Words(Vec::new())
    }

    /// For programs: the members of one object, in their order.
    ///
    /// # Errors
    /// What the stream reports.
    fn json(&self, json: &mut Json<'_>) -> io::Result<()>;

    /// Why the answer is no, where the question has one: the text ends with it, and other formats have it said beside them.
    fn no(&self) -> Option<String> {
        None
    }
}

/// Rows of a result.
pub enum Rows<'a> {
    /// Columns of numbers with units.
    Table(Cow<'a, Table>),
    /// Rows of texts, the heading first; all of one length.
    Words(Vec<Vec<String>>),
}

impl From<Table> for Rows<'_> {
    fn from(table: Table) -> Self {
        Self::Table(Cow::Owned(table))
    }
}

impl<'a> From<&'a Table> for Rows<'a> {
    fn from(table: &'a Table) -> Self {
        Self::Table(Cow::Borrowed(table))
    }
}

/// How a result is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Text for a terminal of 80 columns.
    Table,
    /// Comma-separated values.
    Csv,
    /// One JSON object.
    Json,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Table, Self::Csv, Self::Json];

    /// Its name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Csv => "csv",
            Self::Json => "json",
        }
    }
}

/// Writes a page in a format; titles of texts are bold where that is `styled`.
///
/// # Errors
/// What the stream reports.
pub fn write(page: &dyn Page, format: Format, styled: bool, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => text::write(&page.text(), styled, out),
        Format::Csv => csv::write(&page.rows(), out),
        Format::Json => json::write(page, out),
    }
}
