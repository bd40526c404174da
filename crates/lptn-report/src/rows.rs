//! Rows of a page, column by column.

use std::borrow::Cow;

use lptn_solve::{Column, Table};

/// Rows of a result.
pub enum Rows<'a> {
    /// Columns of numbers with units, after those of words.
    Table(Cow<'a, Table>),
    /// Columns in any order, all of the same length.
    Columns(Vec<RowColumn<'a>>),
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

/// A column of rows.
pub struct RowColumn<'a> {
    /// The name.
    pub name: String,
    /// The unit of the numbers, `1` for plain ones; `None` for words.
    pub unit: Option<String>,
    /// One cell a row.
    pub cells: Cells<'a>,
}

/// The cells of a column.
pub enum Cells<'a> {
    /// Texts.
    Words(Cow<'a, [String]>),
    /// Numbers; NaN is an empty cell.
    Numbers(Cow<'a, [f64]>),
    /// Whole numbers from 0 on, written without an exponent; NaN is an empty cell.
    Counts(Cow<'a, [f64]>),
}

impl<'a> RowColumn<'a> {
    /// A column of words.
    pub fn words(name: impl Into<String>, cells: impl Into<Cow<'a, [String]>>) -> Self {
        Self { name: name.into(), unit: None, cells: Cells::Words(cells.into()) }
    }

    /// A column of numbers.
    pub fn numbers(
        name: impl Into<String>,
        unit: impl Into<String>,
        cells: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        let (name, unit) = (name.into(), Some(unit.into()));
        Self { name, unit, cells: Cells::Numbers(cells.into()) }
    }

    /// A column of whole numbers.
    pub fn counts(name: impl Into<String>, cells: impl Into<Cow<'a, [f64]>>) -> Self {
        Self { name: name.into(), unit: Some("1".into()), cells: Cells::Counts(cells.into()) }
    }

    /// The heading in a CSV file.
    pub fn header(&self) -> Cow<'_, str> {
        match &self.unit {
            Some(unit) => Column::heading(&self.name, unit).into(),
            None => self.name.as_str().into(),
        }
    }

    /// The numbers; `None` for words.
    pub fn values(&self) -> Option<&[f64]> {
        match &self.cells {
            Cells::Words(_) => None,
            Cells::Numbers(values) | Cells::Counts(values) => Some(values),
        }
    }

    /// The number of cells.
    pub fn rows(&self) -> usize {
        match &self.cells {
            Cells::Words(texts) => texts.len(),
            Cells::Numbers(values) | Cells::Counts(values) => values.len(),
        }
    }
}
