//! `[capacitor]`: parts that are lumped into one node.

use lptn_network::{Field, Item};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::raw::RawEntry;
use crate::vocabulary::CAPACITOR;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    pub(crate) fn capacitors(&mut self) {
        for entry in self.elements(CAPACITOR.name) {
            if self.capacitor(entry).is_none() {
                self.doubts.parts = true;
            }
        }
    }

    fn capacitor(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element(CAPACITOR.name, &entry.key);
        let fields = Fields::of(&CAPACITOR, owner, entry, &mut self.problems)?;
        let node = self.node_end(&fields, "node");
        let capacity = self.capacity(&fields).unwrap_or_else(|| {
            fields.require("C", &mut self.problems);
            stand_in(Type::of(Dimension::CAPACITY))
        });
        let (node, at) = node?;
        let id = self.builder.capacitor(&entry.key, node, capacity);
        let item = Item::Capacitor(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map.part_of(node, at.span.clone());
        self.map_capacity(item, &fields);
        Some(())
    }
}
