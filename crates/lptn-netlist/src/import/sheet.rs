//! A CSV file that is read row by row.

use crate::csv_file::CsvText;
use crate::csv_head::{Head, Row, position, reader, row};
use crate::file::Span;
use crate::import::places::{Kind, Places, STRIDE};
use crate::value::Place;
use lptn_network::Field;

/// One file of `[import]`, standing at a row.
pub(crate) struct Sheet<'s> {
    pub(crate) head: Head,
    /// What names the file.
    pub(crate) ask: Place<'s>,
    /// How many elements of the kind there were before its own.
    pub(crate) first: usize,
    /// How many problems of its cells were found.
    pub(crate) problems: usize,
    /// Whether the row has as many cells as the header.
    pub(crate) sound: bool,
    text: &'s CsvText,
    reader: csv::Reader<&'s [u8]>,
    record: csv::StringRecord,
    rows: usize,
    marks: Vec<usize>,
    skipped: Vec<usize>,
}

impl<'s> Sheet<'s> {
    /// A file, standing before its first row; `None` if it has no header.
    pub(crate) fn open(text: &'s CsvText, ask: Place<'s>) -> Option<Self> {
        let mut reader = reader(&text.text);
        let mut record = csv::StringRecord::new();
        if !reader.read_record(&mut record).unwrap_or(false) {
            return None;
        }
        let head = Head::new(text.file, &row(record.clone(), &text.text));
        let (marks, skipped) = (Vec::new(), Vec::new());
        Some(Self {
            head,
            ask,
            first: 0,
            problems: 0,
            sound: true,
            text,
            reader,
            record,
            rows: 0,
            marks,
            skipped,
        })
    }

    /// Goes to the next row; false at the end.
    pub(crate) fn next(&mut self) -> bool {
        // the text is UTF-8 and rows may be of any length: nothing else can fail
        if !self.reader.read_record(&mut self.record).unwrap_or(false) {
            return false;
        }
        if self.rows.is_multiple_of(STRIDE) {
            self.marks.push(position(&self.record));
        }
        self.rows += 1;
        true
    }

    /// Leaves out the row: it becomes no element.
    pub(crate) fn skip(&mut self) {
        self.skipped.push(self.rows - 1 - self.skipped.len());
    }

    /// The text of a cell without blanks around it.
    pub(crate) fn cell(&self, index: usize) -> &str {
        self.record.get(index).unwrap_or_default().trim()
    }

    /// How many cells the row has.
    pub(crate) fn cells(&self) -> usize {
        self.record.len()
    }

    /// The row, for what is said about it.
    pub(crate) fn row(&self) -> Row {
        row(self.record.clone(), &self.text.text)
    }

    /// The place of a cell of the row.
    pub(crate) fn place(&self, index: usize) -> Span {
        self.row().place(self.head.file(), index)
    }

    /// Whether there is a column of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.head.columns.iter().any(|column| column.name == name)
    }

    /// The name of the row's element, if it has one.
    pub(crate) fn name(&self, column: Option<usize>) -> Option<&str> {
        column.map(|index| self.cell(index)).filter(|name| !name.is_empty())
    }

    /// The number of the row below the header, from 1.
    pub(crate) fn number(&self) -> u32 {
        u32::try_from(self.rows).unwrap_or(u32::MAX)
    }

    /// The way back from the elements to their rows.
    pub(crate) fn places(self, kind: Kind, name: Option<usize>, fields: &[(Field, Option<usize>)]) -> Places {
        let columns = fields.iter().filter_map(|(field, column)| Some((*field, (*column)?)));
        let columns = columns.chain(name.map(|column| (Field::Name, column))).collect();
        Places {
            kind,
            first: self.first,
            count: self.rows - self.skipped.len(),
            columns,
            text: self.text.clone(),
            marks: self.marks,
            skipped: self.skipped,
        }
    }
}
