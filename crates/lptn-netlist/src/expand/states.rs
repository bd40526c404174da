//! `[state]` and `[value]`.

use lptn_network::{Field, State, Value};
use lptn_units::{Dimension, Type, Unit, parse_quantity};

use super::Writer;
use crate::toml_text::{TomlFields, like, string};

impl Writer<'_> {
    pub(super) fn states(&mut self) {
        let mut section = TomlFields::default();
        let states = self.network.state_ids().zip(self.network.states());
        for (_, state) in states.filter(|(id, _)| !self.network.counts_fluid(*id)) {
            section.put(&state.name, self.state(state));
        }
        self.section("state", &section);
    }

    fn state(&self, state: &State) -> String {
        let mut fields = TomlFields::default();
        let per_second = state.ty.dimension.checked_div(Dimension::TIME).map_or(state.ty, Type::of);
        let source = state.source.map(|id| &self.network.sources()[id.index()]);
        let rate = source.and_then(|source| source.power());
        let key = state.law().key();
        let ty = if state.every.is_some() { state.ty } else { per_second };
        rate.into_iter().for_each(|rate| fields.put(key, like(rate, ty)));
        let every = state.every.as_ref();
        every.into_iter().for_each(|every| {
            fields.put(Field::Every.key(), like(every, Type::of(Dimension::TIME)));
        });
        let values =
            [("start", &state.start), ("min", &state.bounds[0]), ("max", &state.bounds[1])];
        for (key, given) in values {
            let shown = state.unit.as_ref().filter(|_| key == "start");
            let text = |given: &Value| shown.and_then(|unit| in_unit(given, unit));
            given.iter().for_each(|given| {
                fields.put(key, text(given).unwrap_or_else(|| like(given, state.ty)));
            });
        }
        if !state.ty.is_temperature() {
            let size = Value::Constant(state.size());
            fields.put("size", like(&size, Type::of(state.ty.dimension)));
        }
        fields.inline()
    }

    pub(super) fn named_values(&mut self) {
        let mut section = TomlFields::default();
        for value in self.network.named_values() {
            section.put(&value.name, string(&value.text));
        }
        self.section("value", &section);
    }
}

/// A constant in the unit in which a state is shown, if that gives back the same number.
fn in_unit(value: &Value, unit: &Unit) -> Option<String> {
    let Value::Constant(si) = value else { return None };
    let text = format!("{} {}", unit.from_si(*si), unit.text);
    let back = parse_quantity(&text, Some(unit.ty)).ok()?.value;
    (back.to_bits() == si.to_bits()).then(|| string(&text))
}
