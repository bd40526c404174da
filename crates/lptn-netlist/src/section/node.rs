//! `[node]`.

use lptn_data::Diagnostic;
use lptn_network::{Field, Input, Item, NodeId};
use lptn_units::{Dimension, Type};

use crate::fields::Fields;
use crate::format::{ABSOLUTE, KeyDeclaration, Role, SectionDeclaration, flag, key};
use crate::names::ValueKind;
use crate::place::{Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind};
use crate::section::default::Initial;
use crate::section::keys::{CAPACITY, MASS, MATERIAL_OF, VOLUME};
use crate::work::{Elaboration, stand_in};

/// The initial temperature of a body.
pub(super) const START: KeyDeclaration =
    key("T0", ABSOLUTE, "temperature at the start", "\"25 degC\"").or("`T0` of `[default]`");

const CAPACITY_OF_MASS: &str = "write the product of mass and specific heat, `C = \"2 [kg] * 900 \
    [J/(kg K)]\"` instead of `mass`, or name a `material` with `mass`";

pub(crate) const NODE: SectionDeclaration = SectionDeclaration {
    name: "node",
    sentence: "A body of one temperature, or a junction that stores no heat.",
    role: Role::Element,
    keys: &[
        START,
        CAPACITY,
        MATERIAL_OF,
        MASS,
        VOLUME,
        key("L_char", "m", "volume over surface, to check whether the node is a lump", "\"12 mm\""),
        flag("massless", "whether it is a junction that stores no heat", "true").or("`false`"),
    ],
    example: "{ T0 = \"25 degC\", C = \"500 J/K\" }",
    elsewhere: &[
        (
            "T",
            "a node's temperature is solved for: `T0` is its start, and a given temperature is a \
             [boundary]",
        ),
        ("cp", CAPACITY_OF_MASS),
        ("m", "the mass is `mass`, with a `material`"),
        ("L", "the characteristic length is `L_char`"),
        ("P", "heat is put in by a [source]: `name = { into = \"node\", P = \"100 W\" }`"),
    ],
    ..SectionDeclaration::NEW
};

impl<'a> Elaboration<'a> {
    /// Adds the nodes; returns those whose capacity reads states, which are not known yet.
    pub(crate) fn nodes(&mut self, default: Option<&Initial<'a>>) -> Vec<(NodeId, Fields<'a>)> {
        let entries = self.elements(NODE.name).iter();
        entries.filter_map(|entry| self.node(entry, default)).collect()
    }

    /// Sets the capacities that read states.
    pub(crate) fn capacities_of_states(&mut self, nodes: Vec<(NodeId, Fields<'a>)>) {
        for (id, fields) in nodes {
            if let Some(capacity) = self.capacity(&fields) {
                self.builder.set_capacity(id, capacity);
            }
        }
    }

    /// True if the capacity reads states or named values.
    fn follows_states(&self, fields: &Fields<'a>) -> bool {
        let states = [ValueKind::State, ValueKind::Value].map(ValueKind::section);
        if states.into_iter().all(|section| self.elements(section).is_empty()) {
            return false;
        }
        let ty = Type::of(Dimension::CAPACITY);
        let Some(raw) = fields.get("C") else { return false };
        let place = Place { owner: &fields.owner, key: "C", raw };
        let Ok(Text::Expression(expression)) = self.names.text(place, Some(ty)) else {
            return false;
        };
        let kinds = expression.names().into_iter().map(|(name, _)| self.names.value_kind(&name));
        kinds.flatten().any(|kind| matches!(kind, ValueKind::State | ValueKind::Value))
    }

    fn node(
        &mut self,
        entry: &'a RawEntry,
        default: Option<&Initial<'a>>,
    ) -> Option<(NodeId, Fields<'a>)> {
        let fields = self.fields(&NODE, entry);
        let field = |key| fields.as_ref().and_then(|fields| fields.get(key));
        let (capacity_at, initial_at) = (field("C").or(field("material")), field("T0"));
        let massless = fields.as_ref().map_or(Some(false), |fields| self.massless(fields));
        let (doubtful, massless) = (massless.is_none(), massless.unwrap_or(false));
        if let (true, None, Some(raw)) = (massless, capacity_at, initial_at) {
            let message = format!(
                "`T0` of node `{}` is only the first guess of its balance: the node is massless",
                entry.key
            );
            let help = "leave `T0` out, unless tables do not reach to the other temperatures, or the balance has \
                 several solutions";
            self.report(Diagnostic::doubt("netlist::massless_initial", message, &raw.span, help));
        }
        let later = fields.as_ref().is_some_and(|fields| self.follows_states(fields));
        let capacity = match later {
            true => Some(stand_in(Type::of(Dimension::CAPACITY))),
            false => fields.as_ref().and_then(|fields| self.capacity(fields)),
        };
        let own = fields.as_ref().and_then(|fields| self.initial(fields));
        let (initial, in_state) = match self.start_of(entry, massless) {
            Some((input, place)) => (Some(input).filter(|_| !massless), place),
            None if massless => (own, None),
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
        if let Some(raw) = initial_at.or(default.map(|(_, raw)| *raw)) {
            self.map.value(item, Field::Initial, raw);
        }
        self.place_in_state(id, in_state);
        if doubtful || fields.as_ref().is_none_or(|fields| !fields.complete) {
            self.left_out.items.insert(item);
        }
        fields.filter(|_| later).map(|fields| (id, fields))
    }

    /// The characteristic length, for the Biot number.
    fn length(&mut self, fields: &Fields<'a>, (id, massless): (NodeId, bool)) {
        let Some(raw) = fields.get("L_char") else { return };
        let length =
            self.input_at(fields, "L_char", raw, Wanted::constant(Type::of(Dimension::LENGTH)));
        self.builder.length(id, length);
        self.map.value(Item::Node(id), Field::CharacteristicLength, raw);
        if massless {
            let message =
                format!("{} has no effect: the node is massless", fields.owner.field("L_char"));
            let help = "leave it out: a junction is not a body";
            self.report(Diagnostic::doubt("netlist::massless_length", message, &raw.span, help));
        }
    }

    /// True if it is declared massless; `None` if that cannot be read.
    fn massless(&mut self, fields: &Fields<'_>) -> Option<bool> {
        Some(self.yes_or_no(fields, "massless")?.unwrap_or(false))
    }

    pub(crate) fn initial(&mut self, fields: &Fields<'_>) -> Option<Input> {
        let (raw, ty) = (fields.get("T0")?, Type::ABSOLUTE_TEMPERATURE);
        if matches!(&raw.kind, RawKind::String { text, .. } if text.trim() == "steady") {
            let message = format!("{} = \"steady\" is not supported yet", fields.owner.field("T0"));
            let help = "write the temperature at the start: `T0 = \"25 degC\"`";
            self.refuse("netlist::not_supported_yet", message, &raw.span, help);
            return Some(stand_in(ty));
        }
        self.replaced_by_state(|work| work.input(fields, "T0", Wanted::constant(ty)))
    }

    /// Reads a temperature at the start, which the state of a run replaces if it has one.
    pub(crate) fn replaced_by_state<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        self.names.is_replaced = self.state.is_some();
        let found = read(self);
        self.names.is_replaced = false;
        found
    }
}
