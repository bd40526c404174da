//! The way back from imported elements to their rows, without a place for each of them.

use lptn_network::{Field, Item};

use crate::csv_file::CsvText;
use crate::csv_head::{Row, reader, row};
use crate::file::Span;

/// The place of every so manyeth row is kept; the others are counted from there.
pub(crate) const STRIDE: usize = 256;

/// What the rows of a file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Node,
    Boundary,
    Conductor,
    Source,
}

impl Kind {
    /// The position of an item of this kind.
    fn index(self, item: Item) -> Option<usize> {
        match (self, item) {
            (Self::Node, Item::Node(id)) => Some(id.index()),
            (Self::Boundary, Item::Boundary(id)) => Some(id.index()),
            (Self::Conductor, Item::Conductor(id)) => Some(id.index()),
            (Self::Source, Item::Source(id)) => Some(id.index()),
            _ => None,
        }
    }
}

/// Where the elements of one file stand: as many of one kind, one after the other, as it has rows.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    pub(crate) kind: Kind,
    /// The position of the first of them in the network.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// The columns in which fields stand.
    pub(crate) columns: Vec<(Field, usize)>,
    pub(crate) text: CsvText,
    /// The bytes of the rows 0, [`STRIDE`], 2 [`STRIDE`] and so on.
    pub(crate) marks: Vec<usize>,
    /// How many elements came before each row that is none.
    pub(crate) skipped: Vec<usize>,
}

impl Places {
    /// The place of a field; that of an automatic name is the row. `None` if the item is not one of these or has no
    /// such cell.
    pub(crate) fn get(&self, item: Item, field: Field) -> Option<Span> {
        let element =
            self.kind.index(item)?.checked_sub(self.first).filter(|element| *element < self.count)?;
        let column = self.columns.iter().find(|(of, _)| *of == field).map(|(_, column)| *column);
        if column.is_none() && field != Field::Name {
            return None;
        }
        let row = self.row(element + self.skipped.partition_point(|before| *before <= element))?;
        let cell = column.filter(|&column| !row.cell(column).is_empty());
        match (cell, field) {
            (None, Field::Name) => Some(row.whole(self.text.file)),
            (None, _) => None,
            (Some(column), _) => Some(row.place(self.text.file, column)),
        }
    }

    /// Whether the item is one of these.
    pub(crate) fn holds(&self, item: Item) -> bool {
        self.element(item).is_some()
    }

    fn element(&self, item: Item) -> Option<usize> {
        self.kind.index(item)?.checked_sub(self.first).filter(|element| *element < self.count)
    }

    /// How many places there are.
    pub(crate) fn len(&self) -> usize {
        self.count * self.columns.len()
    }

    /// The row of this number below the header.
    fn row(&self, number: usize) -> Option<Row> {
        let mark = *self.marks.get(number / STRIDE)?;
        let mut records = reader(self.text.text.get(mark..)?).into_records();
        let mut cells = records.nth(number % STRIDE)?.ok()?;
        let mut position = cells.position()?.clone();
        position.set_byte(position.byte() + u64::try_from(mark).ok()?);
        cells.set_position(Some(position));
        Some(row(cells, &self.text.text))
    }
}
