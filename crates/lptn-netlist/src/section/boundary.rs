//! `[boundary]`.

use lptn_network::{Field, Item};
use lptn_units::Type;

use crate::format::{ABSOLUTE, Role, SectionDeclaration, key};
use crate::place::Wanted;
use crate::raw::RawEntry;
use crate::work::{Elaboration, stand_in};

pub(crate) const BOUNDARY: SectionDeclaration = SectionDeclaration {
    name: "boundary",
    sentence: "A place with a given temperature, at any heat flow.",
    role: Role::Element,
    keys: &[
        key("T", ABSOLUTE, "temperature, constant or a function of `t`", "\"25 degC\"").needed()
    ],
    example: "{ T = \"25 degC\" }",
    elsewhere: &[
        ("T0", "the temperature of a boundary is `T`"),
        (
            "C",
            "a boundary keeps its temperature at any heat flow; a place with a capacity is a \
             [node]",
        ),
    ],
    ..SectionDeclaration::NEW
};

impl<'a> Elaboration<'a> {
    pub(crate) fn boundaries(&mut self) {
        for entry in self.elements(BOUNDARY.name) {
            self.boundary(entry);
        }
    }

    /// A boundary keeps its name even if its temperature is wrong, so that paths to it are not
    /// reported too.
    fn boundary(&mut self, entry: &'a RawEntry) {
        let fields = self.fields(&BOUNDARY, entry);
        let ty = Type::ABSOLUTE_TEMPERATURE;
        let temperature = fields.as_ref().and_then(|fields| {
            self.require(fields, "T");
            self.input(fields, "T", Wanted::in_time(ty))
        });
        let id = self.builder.boundary(&entry.key, temperature.unwrap_or_else(|| stand_in(ty)));
        let item = Item::Boundary(id);
        match &fields {
            Some(fields) => self.note(item, &entry.key_span, fields, &[Field::Temperature]),
            None => self.map.insert(item, Field::Name, entry.key_span.clone()),
        }
    }
}
