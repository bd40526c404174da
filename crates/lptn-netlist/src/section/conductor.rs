//! Paths between two ends, of every kind that is declared.

use lptn_laws::Kind;
use lptn_network::{Field, Input, Item, Path, Terminal};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawValue};
use crate::section::path::PATHS;
use crate::vocabulary::Section;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// Every path between two ends.
    pub(crate) fn conductors(&mut self) {
        for (section, kind) in PATHS.iter() {
            for entry in self.elements(section.name) {
                let read = self.conductor(entry, section, *kind);
                self.doubts.paths |= read.is_none();
            }
        }
    }

    fn conductor(&mut self, entry: &'a RawEntry, section: &'static Section, kind: Kind) -> Option<()> {
        let owner = Owner::element(section.name, &entry.key);
        let mut fields = Fields::of(section, owner, entry, &mut self.problems)?;
        let (from, to) = (self.terminal(&fields, "from"), self.terminal(&fields, "to"));
        fields.area = self.area_of(&fields, [&from, &to]);
        // a stand-in where the law is wrong, so that the ends still count
        let path = self.path(&fields, kind);
        let path = path.unwrap_or_else(|| Path::resistance(stand_in(Type::of(Dimension::RESISTANCE))));
        let (from, to) = (from?, to?);
        let before = self.builder.sizes();
        let item = self.builder.connect(&entry.key, kind, (from.0, to.0), path);
        match item {
            Item::Joint(_) => {
                self.map.joint(section.name);
                self.note_parts(before, item, section.name);
            }
            _ => self.map.conductor(section.name),
        }
        self.map_fields((item, kind), &fields, (from, to));
        self.map.insert(item, Field::Name, entry.key_span.clone());
        Some(())
    }

    fn map_fields(
        &mut self,
        (item, kind): (Item, Kind),
        fields: &Fields<'a>,
        (from, to): ((Terminal, &RawValue), (Terminal, &RawValue)),
    ) {
        self.map.value(item, Field::From, from.1);
        self.map.value(item, Field::To, to.1);
        let own = kind.fields().into_iter().filter_map(|field| Field::of_law(field.key));
        for field in own.chain([Field::Material, Field::Fluid]) {
            if let Some(raw) = fields.get(field.key()).filter(|_| fields.known(field.key())) {
                self.map.value(item, field, raw);
            }
        }
    }

    /// The value of a field of a path, which may depend on time and temperatures; a stand-in if it is wrong.
    pub(crate) fn law(&mut self, fields: &Fields<'a>, key: &str, ty: Type) -> Option<Input> {
        let known = fields.known(key);
        let Some(raw) = fields.get(key).filter(|_| known) else {
            return fields.area.clone().filter(|_| known && key == "area");
        };
        let given = self.given(Place { owner: &fields.owner, key, raw }, Wanted::of_link(ty));
        Some(given.map_or_else(|| stand_in(ty), |given| given.input()))
    }
}
