//! `[source]`.

use lptn_network::{Field, Item};
use lptn_units::{Dimension, Type};

use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner};
use crate::raw::RawEntry;
use crate::value::{Place, Wanted};
use crate::vocabulary::SOURCE;

impl<'a> Elaboration<'a> {
    pub(crate) fn sources(&mut self) {
        for entry in self.elements(SOURCE.name) {
            self.source(entry);
        }
    }

    fn source(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element(SOURCE.name, &entry.key);
        let fields = Fields::of(&SOURCE, owner, entry, &mut self.problems)?;
        let into = self.end(&fields, "into");
        let raw = fields.require("P", &mut self.problems);
        let ty = Type::of(Dimension::POWER);
        let given = raw
            .and_then(|raw| self.given(Place { owner: &fields.owner, key: "P", raw }, Wanted::in_time(ty)));
        let (into, at) = into?;
        let power = given.map_or_else(|| stand_in(ty), |given| given.input());
        let item = Item::Source(self.builder.source(&entry.key, into, power));
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map.value(item, Field::Into, at);
        if let Some(raw) = raw {
            self.map.value(item, Field::Power, raw);
        }
        Some(())
    }
}
