//! The law of a path with its values, read as its kind declares it.

use std::sync::LazyLock;

use lptn_data::{Diagnostic, list};
use lptn_laws::{Field, Formula, Kind};
use lptn_network::{FluidId, Input, Path};
use lptn_units::{Quantity, Type};

use crate::fields::{Fields, sample};
use crate::place::{Place, Wanted};
use crate::raw::{RawKind, RawValue};
use crate::section::forms::check_forms;
use crate::vocabulary::Section;
use crate::work::{Elaboration, stand_in};

/// The sections of paths, in the order in which their columns stand.
pub(crate) static PATHS: LazyLock<Vec<(Section, Kind)>> =
    LazyLock::new(|| Kind::ALL.iter().map(|kind| (section(*kind), *kind)).collect());

fn section(kind: Kind) -> Section {
    let declared = kind.declaration();
    Section {
        name: declared.section,
        keys: keys(kind).leak(),
        later: declared.later,
        example: declared.example,
        elsewhere: declared.elsewhere,
    }
}

/// The ends, then its fields, with `material` before a property, `fluid` before a flow, and the key that chooses a law
/// behind what all laws take.
fn keys(kind: Kind) -> Vec<&'static str> {
    let mut keys = vec!["from", "to"];
    let mut selector = kind.declaration().selector;
    for field in kind.fields() {
        let laws = || kind.laws().filter(|law| law.field(field.key).is_some());
        keys.extend(selector.take_if(|_| !laws().eq(kind.laws())));
        let fluid = laws().any(|law| law.declaration().carries.is_of_fluid()) && !keys.contains(&"fluid");
        keys.extend(fluid.then_some("fluid"));
        keys.extend(field.property.then_some("material"));
        keys.push(field.key);
    }
    keys
}

/// Laws that begin with the same field, and the keys that all of them need.
struct Group {
    laws: Vec<Formula>,
    keys: Vec<&'static str>,
}

fn required(law: Formula) -> Vec<&'static str> {
    let declared = law.declaration();
    let fluid = declared.carries.is_of_fluid().then_some("fluid");
    let fields = declared.fields.iter().filter(|field| field.default.is_none()).map(|field| field.key);
    let mut keys: Vec<&str> = fluid.into_iter().chain(fields).collect();
    keys.dedup();
    keys
}

fn groups(kind: Kind) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for law in kind.laws() {
        let (first, keys) = (law.declaration().fields[0].key, required(law));
        match groups.iter_mut().find(|group| group.laws[0].declaration().fields[0].key == first) {
            Some(group) => {
                group.laws.push(law);
                group.keys.retain(|key| keys.contains(key));
            }
            None => groups.push(Group { laws: vec![law], keys }),
        }
    }
    groups
}

/// What stands in the place of a field: nothing, a value, or as many as a list has.
type Read = (&'static Field, Vec<Input>);

impl<'a> Elaboration<'a> {
    /// The law of a path with its values.
    pub(crate) fn path(&mut self, fields: &Fields<'a>, kind: Kind) -> Option<Path> {
        let groups = groups(kind);
        let law = match kind.declaration().selector {
            Some(selector) => {
                self.check_property(fields, kind);
                let law = self.selected(fields, kind, selector);
                let read = self.read(fields, law.map_or_else(Vec::new, |law| distinct(&[law])));
                return self.complete(fields, law?, read, None);
            }
            None => groups.iter().find(|group| group.keys.iter().any(|key| fields.has(key))),
        };
        let forms: Vec<&[&str]> = groups.iter().map(|group| group.keys.as_slice()).collect();
        self.problems.extend(check_forms(fields, &forms));
        let fluid = fields.get("fluid").filter(|_| fields.known("fluid"));
        let fluid = fluid.map(|raw| self.used_fluid(fields, raw));
        let read = self.read(fields, kind.fields());
        let begun = groups.iter().filter(|group| group.keys.iter().any(|key| fields.get(key).is_some()));
        let one = begun.count() == 1;
        let law = of_values(&law?.laws, &read)?;
        let idle = law.declaration().idle.iter().filter(|_| one);
        idle.for_each(|(key, why)| self.refuse_keys(fields, &[key], why));
        let fluid = match fluid {
            Some(fluid) if law.declaration().carries.is_of_fluid() => {
                Some(self.fluid_for(fields, law, fluid?)?)
            }
            _ => None,
        };
        self.complete(fields, law, read, fluid)
    }

    /// A property is given, or the material that has it.
    fn check_property(&mut self, fields: &Fields<'a>, kind: Kind) {
        if let Some(field) = kind.fields().into_iter().find(|field| field.property) {
            self.problems.extend(check_forms(fields, &[&["material"], &[field.key]]));
        }
    }

    /// The law that a word chooses; fields of others mean nothing beside it.
    fn selected(&mut self, fields: &Fields<'a>, kind: Kind, selector: &str) -> Option<Formula> {
        let words: Vec<(&str, Formula)> = kind.laws().map(|law| (law.declaration().name, law)).collect();
        let given = fields.require(selector, &mut self.problems).is_some();
        let law = self.choice(fields, selector, &words).filter(|_| given)?;
        let name = law.declaration().name;
        let own: Vec<&str> =
            law.declaration().fields.iter().filter(|field| !field.property).map(|field| field.key).collect();
        let others: Vec<&str> =
            kind.fields().iter().map(|field| field.key).filter(|key| law.field(key).is_none()).collect();
        self.refuse_keys(fields, &others, &format!("means nothing for a {name}, which takes {}", list(&own)));
        if let Some(key) = own.iter().find(|key| !fields.has(key)).filter(|_| fields.complete) {
            let message = format!("{} is a {name} without `{key}`", fields.owner.words());
            let problem = Diagnostic::error("netlist::missing_field", message)
                .at(fields.place.clone(), format!("`{key}` is missing"));
            self.report(problem.help(format!("add `{}`", sample(key))));
        }
        Some(law)
    }

    /// The values of these fields as far as they are given; stand-ins for those that are wrong.
    fn read(&mut self, fields: &Fields<'a>, wanted: Vec<&'static Field>) -> Vec<Read> {
        wanted.into_iter().map(|field| (field, self.values(fields, field))).collect()
    }

    fn values(&mut self, fields: &Fields<'a>, field: &'static Field) -> Vec<Input> {
        let raw = fields.get(field.key).filter(|_| fields.known(field.key));
        if let (None, true) = (raw, field.property) {
            return vec![self.property_of_material(fields).unwrap_or_else(|| stand_in(field.ty))];
        }
        let Some(raw) = raw else { return self.law(fields, field.key, field.ty).into_iter().collect() };
        if let (RawKind::Array(items), 2..) = (&raw.kind, most(field.key)) {
            let one = |raw: &'a RawValue| self.link(fields, field, raw);
            let values: Vec<Input> = items.iter().map(one).collect();
            if values.len() == most(field.key) {
                return values;
            }
            self.report(wrong_count(fields, field, raw, values.len()));
            return Vec::new();
        }
        match types(field.key).as_slice() {
            [_] => vec![self.link(fields, field, raw)],
            types => self.of_types(fields, field.key, raw, types).into_iter().collect(),
        }
    }

    /// The value of a field of a path, which may depend on time and temperatures; a stand-in if it is wrong.
    fn link(&mut self, fields: &Fields<'a>, field: &Field, raw: &'a RawValue) -> Input {
        let place = Place { owner: &fields.owner, key: field.key, raw };
        let given = self.given(place, Wanted::of_link(field.ty));
        given.map_or_else(|| stand_in(field.ty), |given| given.input())
    }

    /// A value of one of several types: which it is chooses the law.
    fn of_types(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        raw: &'a RawValue,
        types: &[(Type, Formula)],
    ) -> Option<Input> {
        let place = Place { owner: &fields.owner, key, raw };
        let given = self.given(place, Wanted::of_link(None))?;
        let found = given.ty();
        if types.iter().any(|(ty, _)| found.conforms_to(*ty)) {
            return Some(given.input());
        }
        let names: Vec<String> = types.iter().map(|(ty, _)| ty.with_article()).collect();
        let message =
            format!("{} must be {}, got {}", place.words(), names.join(" or "), found.with_article());
        let problem = Diagnostic::error("netlist::flow_unit", message).at(raw.span.clone(), "");
        let written: Vec<String> = types.iter().map(|(_, law)| written(*law)).collect();
        self.report(problem.help(format!("write it like this: {}", written.join(", or "))));
        None
    }

    /// The conductivity of the material.
    fn property_of_material(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let raw = fields.get("material")?;
        let name = fields.text("material", raw, &mut self.problems)?;
        let known = self.known_material(fields, name, raw)?;
        if !known.k {
            let problem = self.without_property(fields, (name, raw), known.id, "k");
            self.report(problem);
            return None;
        }
        self.builder.conductivity(known.id)
    }

    /// A law with all its values, defaults in place of those that may be left out.
    fn complete(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
        read: Vec<Read>,
        fluid: Option<FluidId>,
    ) -> Option<Path> {
        let declared = law.declaration();
        let mut values: Vec<Input> = Vec::with_capacity(declared.fields.len());
        for same in declared.fields.chunk_by(|a, b| a.key == b.key) {
            let found = read.iter().find(|(field, _)| field.key == same[0].key);
            match (found.map_or(&[][..], |(_, values)| values), same[0].default) {
                (given, _) if given.len() == same.len() => values.extend_from_slice(given),
                (_, Some(value)) => values.push(Quantity { value, deviation: None, ty: same[0].ty }.into()),
                (_, None) => return self.lacks(fields, law, same[0]),
            }
        }
        Some(match fluid {
            Some(fluid) => Path::of_fluid(law, fluid, values),
            None => Path::new(law, values),
        })
    }

    /// A field that this law needs beside those that chose it.
    fn lacks(&mut self, fields: &Fields<'a>, law: Formula, field: Field) -> Option<Path> {
        let first = law.declaration().fields[0].key;
        if fields.complete && !fields.has(field.key) && fields.has(first) && types(first).len() > 1 {
            self.report(without(fields, law, field.key));
        }
        None
    }
}

/// The fields of some laws, each key once.
fn distinct(laws: &[Formula]) -> Vec<&'static Field> {
    let mut fields: Vec<&'static Field> = laws.iter().flat_map(|law| law.declaration().fields).collect();
    fields.dedup_by_key(|field| field.key);
    fields
}

/// How many values a key may have in a list.
fn most(key: &str) -> usize {
    let count = |law: &Formula| law.declaration().fields.iter().filter(|field| field.key == key).count();
    Formula::ALL.iter().map(count).max().unwrap_or(1)
}

/// The types that a key has in the laws of streams and the like, where one key chooses the law by its unit.
fn types(key: &str) -> Vec<(Type, Formula)> {
    let mut types: Vec<(Type, Formula)> = Vec::new();
    for law in Formula::ALL {
        if let Some(field) = law.field(key).filter(|field| types.iter().all(|(ty, _)| *ty != field.ty)) {
            types.push((field.ty, *law));
        }
    }
    types
}

/// The law of a group that takes as many values of these types.
fn of_values(laws: &[Formula], read: &[Read]) -> Option<Formula> {
    let fits = |law: &&Formula| {
        read.iter().filter(|(_, values)| !values.is_empty()).all(|(field, values)| {
            let own: Vec<&Field> =
                law.declaration().fields.iter().filter(|own| own.key == field.key).collect();
            own.is_empty()
                || own.len() == values.len()
                    && own.iter().zip(values).all(|(own, v)| v.ty().conforms_to(own.ty))
        })
    };
    laws.iter().find(fits).copied()
}

/// `flow = "3 L/min"` with `flow_T = "20 degC"`
fn written(law: Formula) -> String {
    let fields = law.declaration().fields.iter();
    let all: Vec<String> = fields.map(|field| format!("`{} = {}`", field.key, field.example)).collect();
    all.join(" with ")
}

fn wrong_count(fields: &Fields<'_>, field: &Field, raw: &RawValue, count: usize) -> Diagnostic {
    let message = format!("{} has {count} values", fields.owner.field(field.key));
    let most = most(field.key);
    let laws = Formula::ALL
        .iter()
        .filter(|law| law.declaration().fields.iter().filter(|own| own.key == field.key).count() == most);
    let of = laws.map(|law| law.declaration().name.replace('_', " ")).next().unwrap_or_default();
    let list = vec![field.example; most].join(", ");
    let count_of_list = if most == 2 { "two".to_owned() } else { most.to_string() };
    Diagnostic::error("netlist::emissivities", message).at(raw.span.clone(), "").help(format!(
        "give one for the exchange as a whole, `{}`, or {count_of_list} for {of}, `{} = [{list}]`",
        sample(field.key),
        field.key
    ))
}

fn without(fields: &Fields<'_>, law: Formula, key: &str) -> Diagnostic {
    let first = law.declaration().fields[0];
    let is = first.ty.with_article();
    let message = format!("{} is {is} without `{key}`", fields.owner.field(first.key));
    let span = fields.get(first.key).map_or(fields.place, |raw| &raw.span);
    let meaning = law.field(key).map_or("", |field| field.meaning);
    let others: Vec<String> =
        types(first.key).iter().filter(|(ty, _)| *ty != first.ty).map(|(ty, _)| ty.with_article()).collect();
    Diagnostic::error("netlist::flow_temperature", message).at(span.clone(), "").help(format!(
        "give the {meaning}, `{}`, or {}",
        sample(key),
        others.join(" or ")
    ))
}
