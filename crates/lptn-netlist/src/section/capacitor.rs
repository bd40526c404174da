//! `[capacitor]`: parts that are lumped into one node.

use lptn_network::Item;
use lptn_units::{Dimension, Type};

use crate::format::{Role, SectionDeclaration, text};
use crate::raw::RawEntry;
use crate::section::keys::{CAPACITY, MASS, MATERIAL_OF, VOLUME};
use crate::work::{Elaboration, stand_in};

pub(crate) const CAPACITOR: SectionDeclaration = SectionDeclaration {
    name: "capacitor",
    sentence: "A part of a node's capacity; the parts of a node add.",
    role: Role::Element,
    keys: &[
        text("node", "name of a node", "the node that it is a part of", "\"name of a node\"")
            .needed(),
        CAPACITY,
        MATERIAL_OF,
        MASS,
        VOLUME,
    ],
    either: &[&["C", "material"]],
    example: "{ node = \"a\", C = \"500 J/K\" }",
    elsewhere: &[("T0", "the temperature at the start belongs to the node")],
    ..SectionDeclaration::NEW
};

impl<'a> Elaboration<'a> {
    pub(crate) fn capacitors(&mut self) {
        for entry in self.elements(CAPACITOR.name) {
            if self.capacitor(entry).is_none() {
                self.left_out.parts = true;
            }
        }
    }

    fn capacitor(&mut self, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&CAPACITOR, entry)?;
        let node = self.node_end(&fields, "node");
        let capacity = self.capacity(&fields).unwrap_or_else(|| {
            self.require(&fields, "C");
            stand_in(Type::of(Dimension::CAPACITY))
        });
        let (node, at) = node?;
        let item = Item::Capacitor(self.builder.capacitor(&entry.key, node, capacity));
        self.note(item, &entry.key_span, &fields, &[]);
        self.map.part_of(node, at.span.clone());
        self.map_capacity(item, &fields);
        Some(())
    }
}
