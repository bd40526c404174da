//! The way back from imported elements to their rows, without a place for each of them.

use lptn_data::{Marks, Span};
use lptn_network::{Field, Item};

/// The kind of the rows of a file.
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

/// The places of the elements of one file: one element of one kind for each row, in order.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    pub(crate) kind: Kind,
    /// The position of the first of them in the network.
    pub(crate) first: usize,
    /// The columns that contain fields.
    pub(crate) columns: Vec<(Field, usize)>,
    pub(crate) marks: Marks,
}

impl Places {
    /// The place of a field; that of an automatic name is the row. `None` if the item is not one of
    /// these or has no such cell.
    pub(crate) fn get(&self, item: Item, field: Field) -> Option<Span> {
        let element = self.element(item)?;
        let column = self.columns.iter().find(|(of, _)| *of == field).map(|(_, column)| *column);
        let cell = column.and_then(|column| self.marks.cell(element, column));
        cell.or_else(|| if field == Field::Name { self.marks.line(element) } else { None })
    }

    /// True if the item is one of these.
    pub(crate) fn holds(&self, item: Item) -> bool {
        self.element(item).is_some()
    }

    fn element(&self, item: Item) -> Option<usize> {
        self.kind.index(item)?.checked_sub(self.first).filter(|element| *element < self.marks.count)
    }

    /// Number of places.
    pub(crate) fn len(&self) -> usize {
        self.marks.count * self.columns.len()
    }
}
