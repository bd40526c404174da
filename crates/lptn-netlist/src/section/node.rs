//! `[node]`.

use lptn_network::{End, Field, Input, Item};
use lptn_units::Type;

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner, sample, wrong_shape};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::section::default::Initial;
use crate::value::{Place, Wanted};
use crate::vocabulary::NODE;

impl<'a> Elaboration<'a> {
    pub(crate) fn nodes(&mut self, default: Option<&Initial<'a>>) {
        for entry in self.elements(NODE.name) {
            self.node(entry, default);
        }
    }

    fn node(&mut self, entry: &'a RawEntry, default: Option<&Initial<'a>>) {
        let owner = Owner::element(NODE.name, &entry.key);
        let fields = Fields::of(&NODE, owner, entry, &mut self.problems);
        let field = |key| fields.as_ref().and_then(|fields| fields.get(key));
        let initial_at = field("T0");
        let massless = self.massless(fields.as_ref());
        let capacity = fields.as_ref().and_then(|fields| self.capacity(fields));
        let own = fields.as_ref().and_then(|fields| self.initial(fields));
        let initial_at = initial_at.or(default.map(|(_, raw)| *raw));
        let initial = own.or_else(|| default.map(|(input, _)| input.clone()));
        let id = self.builder.add_node(&entry.key, capacity, initial, massless);
        let item = Item::Node(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        if let Some(fields) = &fields {
            self.map_capacity(item, fields);
        }
        if let Some(raw) = initial_at {
            self.map.value(item, Field::Initial, raw);
        }
        if fields.is_none_or(|fields| !fields.complete) {
            self.doubts.items.insert(item);
        }
        self.ends.entry(&entry.key).or_insert((End::Node(id), &entry.key_span));
    }

    fn massless(&mut self, fields: Option<&Fields<'_>>) -> bool {
        let Some((fields, raw)) = fields.and_then(|f| f.get("massless").map(|raw| (f, raw))) else {
            return false;
        };
        if let RawKind::Boolean(massless) = raw.kind {
            return massless;
        }
        let words = fields.owner.field("massless");
        self.report(wrong_shape(&words, raw, "`true` or `false`", &sample("massless")));
        false
    }

    fn initial(&mut self, fields: &Fields<'_>) -> Option<Input> {
        let raw = fields.get("T0")?;
        let ty = Type::ABSOLUTE_TEMPERATURE;
        if is_steady(raw) {
            self.report(steady(fields, raw));
            return Some(stand_in(ty));
        }
        let given = self.given(Place { owner: &fields.owner, key: "T0", raw }, Wanted::constant(ty));
        Some(given.map_or_else(|| stand_in(ty), |given| given.input()))
    }
}

fn is_steady(raw: &RawValue) -> bool {
    matches!(&raw.kind, RawKind::String { text, .. } if text.trim() == "steady")
}

fn steady(fields: &Fields<'_>, raw: &RawValue) -> Diagnostic {
    let message = format!("{} = \"steady\" is not supported yet", fields.owner.field("T0"));
    Diagnostic::error("netlist::not_supported_yet", message)
        .at(raw.span.clone(), "")
        .help("write the temperature at the start: `T0 = \"25 degC\"`")
}
