//! `[state]`: values of any unit with a given rate of change.

use lptn_network::{Field, Item, StateId, StateLaw};
use lptn_units::{Dimension, Expression, Type, Unit, written_quantity};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, akin};
use crate::names::ValueKind;
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::work::Elaboration;

pub(crate) const STATE: SectionDeclaration = SectionDeclaration {
    name: ValueKind::State.section(),
    sentence: "A value of any unit with a given rate: an integral, a state of charge, fuel.",
    role: Role::Value,
    keys: &[
        akin("rate", "quantity or expression", "its change per second", "\"-0.2 g/s\""),
        akin(
            "balance",
            "expression",
            "instead of `rate`: the sum that is zero at all times, and falls while the state rises",
            "\"inflow - p / R\"",
        ),
        akin(
            "next",
            "quantity or expression",
            "instead of `rate`: its value from each sample to the next",
            "\"if(body.T < 60 [degC], 1, 0)\"",
        ),
        akin("every", "time or expression", "the time between samples, with `next`", "\"0.1 s\""),
        akin("start", "quantity or expression", "its value at the start", "\"500 g\"").needed(),
        akin("min", "quantity or expression", "its least value, where it stops", "\"0 g\""),
        akin("max", "quantity or expression", "its greatest value, where it stops", "\"500 g\""),
        akin(
            "size",
            "quantity or expression",
            "the size of a usual change, from which its tolerance follows",
            "\"500 g\"",
        )
        .or("`max - min`, else the size of `start`"),
    ],
    either: &[&["rate", "balance", "next"]],
    example: "{ rate = \"-0.2 g/s\", start = \"500 g\", min = \"0 g\" }",
    elsewhere: &[
        ("initial", "the value at the start is `start`"),
        ("value", "the value at the start is `start`"),
        ("unit", "the unit follows from `start`: `start = \"0 kg\"`"),
        ("der", "the change per second is `rate`"),
        ("zero", "the sum that is zero is `balance`"),
        ("lower", "the least value is `min`"),
        ("upper", "the greatest value is `max`"),
        ("scale", "the size of a usual change is `size`"),
        ("C", "a body with a temperature is a [node]"),
        ("T0", "a body with a temperature is a [node]; the start of a state is `start`"),
    ],
    ..SectionDeclaration::NEW
};

/// A state whose name is known and whose rate is not read yet.
pub(crate) struct Named<'a> {
    name: &'a str,
    id: StateId,
    fields: Fields<'a>,
    ty: Type,
    start: Expression,
    bounds: [Option<Expression>; 2],
}

impl<'a> Elaboration<'a> {
    /// Names every state, so that everything read afterwards may use it.
    pub(crate) fn states(&mut self) -> Vec<Named<'a>> {
        let entries = self.elements(STATE.name).iter();
        entries
            .filter_map(|entry| {
                let named = self.named_state(entry);
                if named.is_none() {
                    self.names.fail(&entry.key);
                }
                named
            })
            .collect()
    }

    fn named_state(&mut self, entry: &'a RawEntry) -> Option<Named<'a>> {
        let fields = self.fields(&STATE, entry)?;
        let raw = self.require(&fields, "start")?;
        let (start, given) = self.written(&fields, "start", Wanted::parameter())?;
        let ty = given.ty();
        let least = self.bound_of_state(&fields, "min", ty);
        let most = self.bound_of_state(&fields, "max", ty);
        let size = self.usual_size(&fields, ty, (&given, &least, &most));
        let (least, most, size) = (least?, most?, size?);
        let id = match self.is_balanced(&fields) {
            true => self.builder.balanced_state(&entry.key, ty, size),
            false => self.builder.state(&entry.key, ty, size),
        };
        shown_in(raw).into_iter().for_each(|unit| self.builder.show_state_in(id, unit));
        let own = [
            Field::Start,
            Field::Rate,
            Field::Balance,
            Field::Next,
            Field::Every,
            Field::Least,
            Field::Most,
            Field::UsualSize,
        ];
        self.note(Item::State(id), &entry.key_span, &fields, &own);
        let node = self.builder.node_of_state(id);
        self.map.state(node, &entry.key_span, raw);
        let bounds = [least, most].map(|bound| bound.map(|(bound, _)| bound));
        Some(Named { name: &entry.key, id, fields, ty, start, bounds })
    }

    /// True for a state with a balance; keys that have no effect with it are reported.
    fn is_balanced(&mut self, fields: &Fields<'a>) -> bool {
        let balanced = fields.has("balance");
        if balanced {
            let others = ["rate", "next", "every", "min", "max"];
            self.refuse_keys(fields, &others, "has no effect with `balance`");
        } else if fields.has("next") {
            self.refuse_keys(fields, &["rate", "min", "max"], "has no effect with `next`");
        } else {
            self.refuse_keys(fields, &["every"], "has no effect without `next`");
        }
        balanced
    }

    /// A bound with its value; `Some(None)` if there is none.
    fn bound_of_state(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        ty: Type,
    ) -> Option<Option<(Expression, Given)>> {
        match fields.get(key) {
            Some(_) => self.written(fields, key, Wanted::like(ty)).map(Some),
            None => Some(None),
        }
    }

    /// The usual size in SI units: as given, or from bounds or start; 1 K for a temperature.
    fn usual_size(
        &mut self,
        fields: &Fields<'a>,
        ty: Type,
        (start, least, most): (&Given, &Bound, &Bound),
    ) -> Option<f64> {
        if fields.get("size").is_some() {
            let plain = Wanted::like(Type::of(ty.dimension));
            let (_, size) = self.written(fields, "size", plain)?;
            return Some(self.builder.nominal(&size.input()).unwrap_or(f64::NAN));
        }
        if ty.is_temperature() {
            return Some(1.0);
        }
        let value = |given: &Given| self.builder.nominal(&given.clone().input());
        let between = match (least, most) {
            (Some(Some((_, least))), Some(Some((_, most)))) => {
                value(most).zip(value(least)).map(|(most, least)| (most - least).abs())
            }
            _ => None,
        };
        let size = between.or_else(|| value(start).map(f64::abs)).filter(|size| *size > 0.0);
        if size.is_none() {
            let message = format!(
                "{} starts at zero and has not both `min` and `max`, so its size is not known",
                fields.owner.words()
            );
            let size = match ty.dimension == Dimension::NONE {
                true => "1".to_owned(),
                false => format!("\"1 {}\"", ty.dimension.si_unit()),
            };
            let help = format!(
                "add the size of a usual change, `size = {size}`: the tolerance of the state is \
                 1e-7 of it"
            );
            let place = fields.place.clone();
            self.refuse("network::state_size", message, &place, help);
        }
        size
    }

    /// Gives each state its rate, once everything is named that it may read.
    pub(crate) fn state_laws(&mut self, named: Vec<Named<'a>>) {
        for state in named {
            if self.state_law(&state).is_none() {
                // its errors have been reported
                self.left_out.items.insert(Item::State(state.id));
            }
        }
    }

    fn state_law(&mut self, state: &Named<'a>) -> Option<()> {
        let fields = &state.fields;
        let given = ["balance", "next"].into_iter().find(|key| fields.has(key));
        let key = given.unwrap_or("rate");
        let raw = self.require(fields, key)?;
        let per_second = state.ty.dimension.checked_div(Dimension::TIME).map(Type::of);
        let wanted = match key {
            "rate" => per_second,
            "next" => Some(state.ty),
            _ => None,
        };
        let every = match key {
            "next" => Some(self.every(fields)?),
            _ => None,
        };
        let wanted = Wanted::of_law(wanted, lptn_network::Context::Control);
        let (rate, _) = self.written(fields, key, wanted)?;
        let bounds = [0, 1].map(|side: usize| state.bounds[side].as_ref());
        let every = every.as_ref();
        let law = StateLaw { start: &state.start, rate: &rate, every, bounds };
        let place = Place { owner: &fields.owner, key, raw };
        match self.builder.state_law(state.id, law) {
            Ok(source) => {
                self.start_state(state.name, state.id);
                self.map.source(STATE.name);
                self.map.value(Item::Source(source), Field::POWER, raw);
                let name = self.map.name(Item::State(state.id));
                name.into_iter().for_each(|name| {
                    self.map.insert(Item::Source(source), Field::Name, name);
                });
                Some(())
            }
            Err(problems) => {
                let told = problems.iter().map(|problem| place.unit_error(problem));
                let told: Vec<_> = told.collect();
                self.problems.extend(told);
                None
            }
        }
    }

    /// The time between samples.
    fn every(&mut self, fields: &Fields<'a>) -> Option<Expression> {
        self.require(fields, "every")?;
        let time = Wanted::like(Type::of(Dimension::TIME));
        self.written(fields, "every", time).map(|(every, _)| every)
    }

    /// The expression of a key, whose value and type were checked.
    pub(crate) fn written(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        wanted: Wanted,
    ) -> Option<(Expression, Given)> {
        let place = Place { owner: &fields.owner, key, raw: fields.get(key)? };
        let kelvin = wanted.derived.then(|| place.kelvin_for(wanted.ty)).flatten();
        let text = self.kept(kelvin.map_or_else(|| self.names.text(place, wanted.ty), Err))?;
        let given = self.resolve(place, text.clone(), wanted)?;
        Some(match text {
            Text::Quantity(quantity) => (Expression::literal(quantity.value, quantity.ty), given),
            Text::Expression(expression) => (expression, given),
        })
    }
}

type Bound = Option<Option<(Expression, Given)>>;

/// The unit in which a start is written.
fn shown_in(raw: &RawValue) -> Option<Unit> {
    let RawKind::String { text, .. } = &raw.kind else { return None };
    written_quantity(text).map(|written| written.unit)
}
