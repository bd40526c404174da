//! `[node]`.

use lptn_data::Diagnostic;
use lptn_network::{Field, Input, Item, NodeId};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner, sample, wrong_shape};
use crate::place::{Given, Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::section::default::Initial;
use crate::vocabulary::NODE;
use crate::work::{Elaboration, stand_in};

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
        let (capacity_at, initial_at) = (field("C").or(field("material")), field("T0"));
        let doubtful = field("massless").is_some_and(|raw| !matches!(raw.kind, RawKind::Boolean(_)));
        let massless = self.massless(fields.as_ref());
        if let (true, None, Some(raw)) = (massless, capacity_at, initial_at) {
            self.report(follows(&entry.key, raw));
        }
        let capacity = fields.as_ref().and_then(|fields| self.capacity(fields));
        let own = fields.as_ref().and_then(|fields| self.initial(fields));
        let initial_at = initial_at.or(default.map(|(_, raw)| *raw));
        let (initial, in_state) = match self.start_of(entry, massless) {
            Some((input, place)) => (Some(input), place),
            None => (own.or_else(|| default.map(|(input, _)| input.clone())), None),
        };
        let id = self.builder.add_node(&entry.key, capacity, initial, massless);
        self.molten(&entry.key, id);
        let item = Item::Node(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        if let Some(fields) = &fields {
            self.map_capacity(item, fields);
            self.length(fields, (id, massless));
        }
        if let Some(raw) = initial_at {
            self.map.value(item, Field::Initial, raw);
        }
        self.place_in_state(id, in_state);
        if doubtful || fields.is_none_or(|fields| !fields.complete) {
            self.doubts.items.insert(item);
        }
    }

    /// The characteristic length, for the Biot number.
    fn length(&mut self, fields: &Fields<'a>, (id, massless): (NodeId, bool)) {
        let Some(raw) = fields.get("L_char") else { return };
        let ty = Type::of(Dimension::LENGTH);
        let place = Place { owner: &fields.owner, key: "L_char", raw };
        let given = self.given(place, Wanted::constant(ty));
        self.builder.length(id, given.map_or_else(|| stand_in(ty), Given::input));
        self.map.value(Item::Node(id), Field::CharacteristicLength, raw);
        if massless {
            let message = format!("{} has no effect: the node is massless", fields.owner.field("L_char"));
            self.report(
                Diagnostic::warning("netlist::massless_length", message)
                    .at(raw.span.clone(), "")
                    .help("leave it out: a junction is no body"),
            );
        }
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

    pub(crate) fn initial(&mut self, fields: &Fields<'_>) -> Option<Input> {
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

fn follows(name: &str, raw: &RawValue) -> Diagnostic {
    let message = format!("`T0` of node `{name}` has no effect: the node is massless");
    Diagnostic::warning("netlist::massless_initial", message)
        .at(raw.span.clone(), "")
        .help("leave `T0` out: a massless node takes the temperature that its neighbours give it")
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
