//! The law of a path with its values, read as its kind declares it.

use std::sync::LazyLock;

use lptn_data::{Diagnostic, list};
use lptn_laws::{FieldDeclaration, Formula, Kind, Substance};
use lptn_network::{FluidId, Input, Path};
use lptn_units::{Quantity, Type};

use crate::fields::Fields;
use crate::format::{KeyDeclaration, Role, SectionDeclaration, key};
use crate::place::{Place, Wanted};
use crate::raw::{RawKind, RawValue};
use crate::section::fluid::UsedFluid;
use crate::section::forms::{begun, check_forms};
use crate::section::keys::{FLUID_OF, MATERIAL_OF};
use crate::section::path_law::{
    Read, most, of_values, types, with_article, without, written, wrong_count,
};
use crate::work::{Elaboration, stand_in};

/// A kind of path with what follows from its declaration, found once and not for every path.
pub(crate) struct PathSection {
    pub(crate) section: SectionDeclaration,
    pub(crate) kind: Kind,
    groups: Vec<Group>,
    /// Its values, each key once.
    values: Vec<PathValue>,
}

impl PathSection {
    /// The keys of its values.
    pub(super) fn values(&self) -> impl Iterator<Item = &'static str> {
        self.values.iter().map(|value| value.field.key)
    }
}

/// A value of a path.
pub(crate) struct PathValue {
    pub(crate) field: &'static FieldDeclaration,
    /// How many of them a list may have.
    most: usize,
    /// The types of which it may be, where its unit chooses the law.
    types: Vec<(Type, Formula)>,
    /// Whether a law takes it that no name chooses.
    plain: bool,
}

/// The sections of paths, in the order in which their columns stand.
pub(crate) static PATHS: LazyLock<Vec<PathSection>> =
    LazyLock::new(|| Kind::ALL.iter().map(|kind| path_section(*kind)).collect());

fn path_section(kind: Kind) -> PathSection {
    let declared = kind.declaration();
    let section = SectionDeclaration {
        name: declared.section,
        sentence: declared.sentence,
        role: Role::Element,
        keys: keys(kind).leak(),
        later: declared.later,
        example: declared.example,
        elsewhere: declared.elsewhere,
    };
    let value = |field: &'static FieldDeclaration| PathValue {
        field,
        most: most(field.key),
        types: types(field.key),
        plain: kind.laws_named(false).any(|law| law.field(field.key).is_some()),
    };
    let values = kind.fields().into_iter().map(value).collect();
    PathSection { section, kind, groups: groups(kind), values }
}

/// The ends, then its fields, with `material` before a property, `fluid` before a flow, and the key
/// that chooses a law behind what all laws take.
fn keys(kind: Kind) -> Vec<KeyDeclaration> {
    let end = "name of a node or boundary";
    let mut keys = vec![
        key(
            "from",
            end,
            "where heat comes from while it is positive",
            "\"name of a node or boundary\"",
        ),
        key("to", end, "where it goes", "\"name of another node or boundary\""),
    ];
    let first = kind.laws_named(true).next().map_or("", |law| law.declaration().name);
    let mut selector = kind
        .declaration()
        .selector
        .map(|name| key(name, "word", "the law", format!("\"{first}\"").leak()));
    for field in kind.fields() {
        let laws = || kind.laws().filter(|law| law.field(field.key).is_some());
        let chosen = |law: Formula| law.declaration().named;
        keys.extend(selector.take_if(|_| laws().all(chosen) && !laws().eq(kind.laws())));
        let of_fluid = laws().any(|law| law.declaration().carries.is_of_fluid());
        let substance = match field.property {
            _ if of_fluid => Some(key("fluid", "name of a fluid", "what streams", "\"water\"")),
            Some(Substance::Material) => Some(MATERIAL_OF),
            Some(Substance::Fluid) => Some(FLUID_OF),
            None => None,
        };
        keys.extend(substance.filter(|new| keys.iter().all(|known| known.name != new.name)));
        let unit = if field.ty.is_scalar() { "number".to_owned() } else { field.ty.usual_unit() };
        keys.push(key(field.key, unit.leak(), field.meaning, field.example));
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
    let fields =
        declared.fields.iter().filter(|field| field.default.is_none()).map(|field| field.key);
    let mut keys: Vec<&str> = fluid.into_iter().chain(fields).collect();
    keys.dedup();
    keys
}

fn groups(kind: Kind) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for law in kind.laws_named(false) {
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

impl<'a> Elaboration<'a> {
    /// The law of a path with its values.
    pub(crate) fn path(&mut self, fields: &Fields<'a>, path: &'static PathSection) -> Option<Path> {
        let groups = &path.groups;
        let forms: Vec<&[&str]> = groups.iter().map(|group| group.keys.as_slice()).collect();
        if let Some(selector) = path.kind.declaration().selector {
            if groups.is_empty() || fields.has(selector) {
                return self.named(fields, path, selector);
            }
            self.refuse_named(fields, path, selector);
        }
        let group = begun(&forms, |key| fields.has(key)).first().map(|&first| &groups[first]);
        self.problems.extend(check_forms(fields, &forms));
        let fluid = fields.get("fluid").filter(|_| path.kind.is_stream());
        let fluid = fluid.map(|raw| self.used_fluid(fields, raw));
        let read = self.read(fields, path.values.iter().filter(|value| value.plain), None);
        let one = begun(&forms, |key| fields.get(key).is_some()).len() == 1;
        let law = of_values(&group?.laws, &read)?;
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

    /// The law that a word chooses, with its values.
    fn named(
        &mut self,
        fields: &Fields<'a>,
        path: &'static PathSection,
        selector: &str,
    ) -> Option<Path> {
        let law = self.selected(fields, path, selector)?;
        let mut declared = law.declaration().fields.iter();
        let material = declared.find(|field| field.property == Some(Substance::Material));
        if let Some(field) = material {
            self.problems.extend(check_forms(fields, &[&["material"], &[field.key]]));
        }
        let fluid = self.film_fluid(fields, law);
        let own = path.values.iter().filter(|value| law.field(value.field.key).is_some());
        let read = self.read(fields, own, fluid);
        self.complete(fields, law, read, None)
    }

    /// That keys mean nothing where no word chooses a law that takes them.
    fn refuse_named(&mut self, fields: &Fields<'a>, path: &PathSection, selector: &str) {
        let named = path.values.iter().filter(|value| !value.plain).map(|value| value.field.key);
        let keys: Vec<&str> = ["fluid"].into_iter().chain(named).collect();
        self.refuse_keys(fields, &keys, &format!("means nothing without `{selector}`"));
    }

    /// The law that a word chooses; fields of others mean nothing beside it.
    fn selected(
        &mut self,
        fields: &Fields<'a>,
        path: &PathSection,
        selector: &str,
    ) -> Option<Formula> {
        let words: Vec<(&str, Formula)> =
            path.kind.laws().map(|law| (law.declaration().name, law)).collect();
        let given = self.require(fields, selector).is_some();
        let law = self.choice(fields, selector, &words).filter(|_| given)?;
        let name = with_article(law.declaration().name);
        let own = law.declaration().fields.iter().filter(|field| field.property.is_none());
        let takes: Vec<&str> = own.clone().map(|field| field.key).collect();
        let others: Vec<&str> = path.values().filter(|key| law.field(key).is_none()).collect();
        self.refuse_keys(
            fields,
            &others,
            &format!("means nothing for {name}, which takes {}", list(&takes)),
        );
        let mut needed = own.filter(|field| field.default.is_none()).map(|field| field.key);
        if let Some(key) = needed.find(|key| !fields.has(key)).filter(|_| fields.complete) {
            let message = format!("{} is {name} without `{key}`", fields.owner.words());
            self.report(fields.missing(key, message));
        }
        Some(law)
    }

    /// The values as far as they are given; stand-ins for those that are wrong.
    fn read(
        &mut self,
        fields: &Fields<'a>,
        wanted: impl Iterator<Item = &'static PathValue>,
        fluid: Option<UsedFluid<'a>>,
    ) -> Vec<Read> {
        wanted.map(|value| (value.field, self.values(fields, value, fluid))).collect()
    }

    fn values(
        &mut self,
        fields: &Fields<'a>,
        value: &PathValue,
        fluid: Option<UsedFluid<'a>>,
    ) -> Vec<Input> {
        let PathValue { field, most, types, .. } = value;
        let raw = fields.get(field.key).filter(|_| fields.known(field.key));
        if let (None, Some(of)) = (raw, field.property) {
            let found = match of {
                Substance::Material => self.property_of_material(fields),
                Substance::Fluid => fluid.and_then(|of| self.property_of_fluid(fields, field, of)),
            };
            return vec![found.unwrap_or_else(|| stand_in(field.ty))];
        }
        let Some(raw) = raw else {
            let area = fields.area.clone().filter(|_| field.key == "area");
            return area.into_iter().collect();
        };
        if let (RawKind::Array(items), 2..) = (&raw.kind, most) {
            let values: Vec<Input> =
                items.iter().map(|raw| self.link(fields, field, raw)).collect();
            if values.len() == *most {
                return values;
            }
            self.report(wrong_count(fields, (field, *most), raw, values.len()));
            return Vec::new();
        }
        match types.as_slice() {
            [_] => vec![self.link(fields, field, raw)],
            types => self.of_types(fields, field.key, raw, types).into_iter().collect(),
        }
    }

    /// The value of a field of a path, which may depend on time and temperatures; a stand-in if it
    /// is wrong.
    fn link(&mut self, fields: &Fields<'a>, field: &FieldDeclaration, raw: &'a RawValue) -> Input {
        self.input_at(fields, field.key, raw, Wanted::of_link(field.ty))
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
        let message = format!(
            "{} must be {}, got {}",
            place.words(),
            names.join(" or "),
            found.with_article()
        );
        let problem = Diagnostic::error("netlist::flow_unit", message).at(raw.span.clone(), "");
        let written: Vec<String> = types.iter().map(|(_, law)| written(*law)).collect();
        self.report(problem.help(format!("write it like this: {}", written.join(", or "))));
        None
    }

    /// The conductivity of the material.
    fn property_of_material(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let (name, raw) = self.word(fields, "material")?;
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
                (_, Some(value)) => {
                    values.push(Quantity { value, deviation: None, ty: same[0].ty }.into())
                }
                (_, None) => return self.lacks(fields, law, same[0]),
            }
        }
        Some(match fluid {
            Some(fluid) => Path::of_fluid(law, fluid, values),
            None => Path::new(law, values),
        })
    }

    /// A field that this law needs beside those that chose it.
    fn lacks(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
        field: FieldDeclaration,
    ) -> Option<Path> {
        let first = law.declaration().fields[0].key;
        if fields.complete && !fields.has(field.key) && fields.has(first) && types(first).len() > 1
        {
            self.report(without(fields, law, field.key));
        }
        None
    }
}
