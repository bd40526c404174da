//! Paths between two ends, of every kind that is declared.

use lptn_network::{Field, Item, Path, Terminal};
use lptn_units::{Dimension, Type};

use crate::fields::Fields;
use crate::raw::{RawEntry, RawValue};
use crate::section::path_section::{ALONG, DIRECTION, OFFSET, PATHS, PathSection};
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// Every path between two ends.
    pub(crate) fn conductors(&mut self) {
        for path in PATHS.iter().filter(|path| !path.kind.is_source()) {
            for entry in self.elements(path.section.name) {
                let read = self.conductor(entry, path);
                self.left_out.paths |= read.is_none();
            }
        }
    }

    fn conductor(&mut self, entry: &'a RawEntry, of: &'static PathSection) -> Option<()> {
        let section = &of.section;
        let mut fields = self.fields(section, entry)?;
        if fields.known(ALONG) && fields.get(ALONG).is_some() {
            return self.flow_along(entry, of, &fields);
        }
        if fields.known(ALONG) {
            self.refuse_keys(&fields, &[DIRECTION], "has no effect without `along`");
        }
        let (from, to) = (self.terminal(&fields, "from"), self.terminal(&fields, "to"));
        let placement = self.placement(&fields, [&from, &to]);
        fields.area = self.area_of(&fields, [&from, &to], &placement);
        // a stand-in if the law is wrong, so that the ends still count
        let path = self.path(&fields, of);
        let formula = path.as_ref().map(|path| path.formula());
        self.names.learn_results(&entry.key, of.kind, formula);
        let path =
            path.unwrap_or_else(|| Path::resistance(stand_in(Type::of(Dimension::RESISTANCE))));
        let (from, to) = (from?, to?);
        let before = self.builder.sizes();
        let placed = (path, placement);
        let item = self.builder.connect_at(&entry.key, of.kind, (from.0, to.0), placed);
        match item {
            Item::FacePath(_) => {
                self.map.face_path(section.name);
                self.note_parts(before, item, section.name);
                self.check_surface_area(item, &entry.key);
            }
            _ => self.map.conductor(section.name),
        }
        self.map_fields((item, of), &fields, (from, to));
        self.map.insert(item, Field::Name, entry.key_span.clone());
        Some(())
    }

    /// A surface of an enclosure that is a face has the area of the face.
    fn check_surface_area(&mut self, item: Item, name: &str) {
        let (Item::FacePath(id), Some((area, at))) = (item, self.structure.surface_area(name))
        else {
            return;
        };
        self.builder.declare_face_area(id, *area);
        if let Some(field) = Field::of_law("area") {
            self.map.insert(item, field, at.clone());
        }
    }

    pub(super) fn map_fields(
        &mut self,
        (item, path): (Item, &PathSection),
        fields: &Fields<'a>,
        (from, to): ((Terminal, &RawValue), (Terminal, &RawValue)),
    ) {
        self.map.value(item, Field::From, from.1);
        self.map.value(item, Field::To, to.1);
        if let Some(raw) = fields.get(OFFSET).filter(|_| fields.known(OFFSET)) {
            self.map.value(item, Field::Offset, raw);
        }
        // most keys of a section are not written: names of fields are looked up for the others only
        let written = |key: &&str| fields.get(key).is_some() && fields.known(key);
        let own = path.values().filter(written).filter_map(Field::of_law);
        for field in own.chain([Field::Material, Field::Fluid]) {
            if let Some(raw) = fields.get(field.key()).filter(|_| fields.known(field.key())) {
                self.map.value(item, field, raw);
            }
        }
    }
}
