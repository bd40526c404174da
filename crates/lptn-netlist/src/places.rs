//! The places of fields by item.
//!
//! The fields of one item come together, so that a chain through one list finds them: a hash map of
//! all fields took twice the memory and hashed each of them.

use std::num::NonZeroU32;

use foldhash::HashMap;
use lptn_data::Span;
use lptn_network::{Field, Item};

use crate::raw::{RawKind, RawValue};

/// The place of a value.
#[derive(Clone, Debug)]
pub(crate) struct Written {
    pub(crate) span: Span,
    /// Length of the quotes before the content of a string, if no escape changes the content.
    quotes: Option<u8>,
}

impl Written {
    /// A place without content.
    pub(crate) fn at(span: Span) -> Self {
        Self { span, quotes: None }
    }

    /// The place of a value of a file.
    pub(crate) fn of(value: &RawValue) -> Self {
        let span = value.span.clone();
        let start = match value.kind {
            RawKind::String { start, .. } => start,
            _ => None,
        };
        let quotes =
            start.and_then(|start| u8::try_from(start.checked_sub(span.range.start)?).ok());
        Self { span, quotes }
    }

    /// The byte at which the content of a string begins, if no escape changes it.
    pub(crate) fn content(&self) -> Option<usize> {
        self.quotes.map(|quotes| self.span.range.start + usize::from(quotes))
    }
}

#[derive(Clone, Debug)]
struct Noted {
    item: Item,
    field: Field,
    written: Written,
    /// The first field of the item, and the next one.
    first: u32,
    next: Option<NonZeroU32>,
}

/// Places by item and field.
#[derive(Clone, Debug, Default)]
pub(crate) struct FieldPlaces {
    firsts: HashMap<Item, u32>,
    all: Vec<Noted>,
}

impl FieldPlaces {
    /// Makes room for this number of places.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.all.reserve(count);
    }

    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// Every place, in the order in which they were noted.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Item, Field, &Span)> {
        self.all.iter().map(|noted| (noted.item, noted.field, &noted.written.span))
    }

    pub(crate) fn get(&self, item: Item, field: Field) -> Option<&Written> {
        let first = *self.firsts.get(&item)?;
        let mut chain = self.chain(first).map(|at| &self.all[at]);
        chain.find(|noted| noted.field == field).map(|noted| &noted.written)
    }

    /// Notes a place, instead of another one of the same field.
    pub(crate) fn insert(&mut self, item: Item, field: Field, written: Written) {
        // texts have fewer bytes than 2^32
        let Ok(new) = u32::try_from(self.all.len()) else { return };
        let last = self.all.last().filter(|last| last.item == item).map(|last| last.first);
        let first = last.unwrap_or_else(|| *self.firsts.entry(item).or_insert(new));
        let mut end = None;
        let mut next = Some(first as usize).filter(|_| first < new);
        while let Some(at) = next {
            let noted = &mut self.all[at];
            if noted.field == field {
                noted.written = written;
                return;
            }
            (end, next) = (Some(at), noted.next.map(|next| next.get() as usize));
        }
        if let Some(end) = end {
            self.all[end].next = NonZeroU32::new(new);
        }
        self.all.push(Noted { item, field, written, first, next: None });
    }

    /// The positions of the fields of an item, from the first on.
    fn chain(&self, first: u32) -> impl Iterator<Item = usize> {
        let next = |at: &usize| Some(self.all[*at].next?.get() as usize);
        std::iter::successors(Some(first as usize), next)
    }
}
