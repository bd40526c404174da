//! Names and the checks of them.

use lptn_units::{RESERVED, is_function};

use super::NetworkBuilder;
use crate::build_error::BuildError;
use crate::error::BuildErrorKind;
use crate::id::{End, Item};
use crate::names::is_path;
use crate::parts::label::is_numbered;

/// True for a table with the name of a function.
fn is_called(name: &str, item: Item) -> bool {
    matches!(item, Item::Table(_)) && is_function(name)
}

impl NetworkBuilder {
    pub(crate) fn register(&mut self, name: &str, item: Item) {
        self.check_name(name, item);
        match self.parts.item(name) {
            Some(first) => self.duplicate(name, first, item),
            None => self.parts.names.insert(name, item),
        }
    }

    pub(crate) fn register_value(&mut self, name: &str, item: Item) {
        self.check_name(name, item);
        match self.parts.value_names.get(name) {
            Some(&first) => self.duplicate(name, first, item),
            None => drop(self.parts.value_names.insert(name.to_owned(), item)),
        }
    }

    pub(crate) fn check_end(&mut self, name: &str, item: Item, end: End) {
        if !self.knows(end) {
            self.error(name, BuildErrorKind::ForeignId { item });
        }
    }

    pub(crate) fn knows(&self, end: End) -> bool {
        match end {
            End::Node(id) => id.index() < self.parts.nodes.len(),
            End::Boundary(id) => id.index() < self.parts.boundaries.len(),
        }
    }

    pub(crate) fn check_name(&mut self, name: &str, item: Item) {
        if !is_path(name) {
            self.error(name, BuildErrorKind::BadName { item });
        } else if is_numbered(name) || RESERVED.contains(&name) || is_called(name, item) {
            self.error(name, BuildErrorKind::ReservedName { item });
        }
    }

    fn duplicate(&mut self, name: &str, first: Item, second: Item) {
        self.error(name, BuildErrorKind::DuplicateName { first, second });
    }

    pub(crate) fn error(&mut self, name: &str, kind: BuildErrorKind) {
        self.errors.push(BuildError { kind, name: name.to_owned() });
    }
}
