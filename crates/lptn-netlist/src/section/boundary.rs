//! `[boundary]`.

use lptn_network::{Field, Item};
use lptn_units::Type;

use crate::fields::{Fields, Owner};
use crate::place::{Place, Wanted};
use crate::raw::RawEntry;
use crate::vocabulary::BOUNDARY;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    pub(crate) fn boundaries(&mut self) {
        for entry in self.elements(BOUNDARY.name) {
            self.boundary(entry);
        }
    }

    /// A boundary keeps its name even if its temperature is wrong, so that paths to it are not reported too.
    fn boundary(&mut self, entry: &'a RawEntry) {
        let owner = Owner::element(BOUNDARY.name, &entry.key);
        let fields = Fields::of(&BOUNDARY, owner, entry, &mut self.problems);
        let raw = fields.as_ref().and_then(|fields| fields.require("T", &mut self.problems));
        let ty = Type::ABSOLUTE_TEMPERATURE;
        let given = match (&fields, raw) {
            (Some(fields), Some(raw)) => {
                self.given(Place { owner: &fields.owner, key: "T", raw }, Wanted::in_time(ty))
            }
            _ => None,
        };
        let temperature = given.map_or_else(|| stand_in(ty), |given| given.input());
        let id = self.builder.boundary(&entry.key, temperature);
        let item = Item::Boundary(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        if let Some(raw) = raw {
            self.map.value(item, Field::Temperature, raw);
        }
    }
}
