//! The law of a path or source with its values, read as its kind declares it.

use std::sync::LazyLock;

use lptn_data::{Diagnostic, list};
use lptn_laws::{FieldDeclaration, Formula, Kind};
use lptn_network::{Context, FluidId, Input, Path};
use lptn_units::{Quantity, Type};

use crate::fields::Fields;
use crate::format::{KeyDeclaration, Role, SectionDeclaration, key};
use crate::place::{Place, Wanted};
use crate::raw::RawKind;
use crate::section::forms::{begun, check_forms};
use crate::section::keys::{AT, LUBRICANT_OF, MATERIAL_OF};
use crate::section::path_law::{Read, most, of_values, types, without, written, wrong_count};
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
    /// What expressions in it may name: the ends of a path, or the node of a source.
    context: Context,
}

/// The sections of paths and of sources, in the order in which their columns stand.
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
        most: most(kind, field.key),
        types: types(kind, field.key),
        context: if kind.is_source() { Context::Source } else { Context::Link },
    };
    let values = kind.fields().into_iter().map(value).collect();
    PathSection { section, kind, groups: groups(kind), values }
}

/// The ends or the nodes that are heated, then its fields, with `material` before a property, `fluid` before a flow, and the key
/// that chooses a law behind what all laws take.
fn keys(kind: Kind) -> Vec<KeyDeclaration> {
    let mut keys = if kind.is_source() { vec![INTO] } else { ENDS.into() };
    let first = kind.laws().next().map_or("", |law| law.declaration().name);
    let mut selector = kind
        .declaration()
        .selector
        .map(|name| key(name, "word", "the law", format!("\"{first}\"").leak()));
    for field in kind.fields() {
        let laws = || kind.laws().filter(|law| law.field(field.key).is_some());
        keys.extend(selector.take_if(|_| !laws().eq(kind.laws())));
        let of_fluid = laws().any(|law| law.declaration().carries.is_of_fluid());
        if of_fluid && keys.iter().all(|key| key.name != "fluid") {
            keys.push(key("fluid", "name of a fluid", "what streams", "\"water\""));
        }
        keys.extend(field.property.then_some(MATERIAL_OF));
        if field.of_lubricant && keys.iter().all(|key| key.name != LUBRICANT_OF.name) {
            keys.extend([LUBRICANT_OF, AT]);
        }
        let unit = if field.ty.is_scalar() { "number".to_owned() } else { field.ty.usual_unit() };
        keys.push(key(field.key, unit.leak(), field.meaning, field.example));
    }
    keys.extend(selector);
    keys
}

const END: &str = "name of a node or boundary";

const ENDS: [KeyDeclaration; 2] = [
    key(
        "from",
        END,
        "where heat comes from while it is positive",
        "\"name of a node or boundary\"",
    ),
    key("to", END, "where it goes", "\"name of another node or boundary\""),
];

const INTO: KeyDeclaration = key(
    "into",
    "name, or table of shares",
    "the node, grid or face that is heated",
    "\"name of a node\"",
);

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

impl<'a> Elaboration<'a> {
    /// The law of a path with its values.
    pub(crate) fn path(&mut self, fields: &Fields<'a>, path: &'static PathSection) -> Option<Path> {
        let (groups, values) = (&path.groups, path.values.iter());
        let forms: Vec<&[&str]> = groups.iter().map(|group| group.keys.as_slice()).collect();
        let group = match path.kind.declaration().selector {
            Some(selector) => {
                self.check_property(fields, path);
                let law = self.selected(fields, path, selector);
                let own = values
                    .filter(|value| law.is_some_and(|law| law.field(value.field.key).is_some()));
                let read = self.read(fields, own);
                return self.complete(fields, law?, read, None);
            }
            None => begun(&forms, |key| fields.has(key)).first().map(|&first| &groups[first]),
        };
        match forms.as_slice() {
            [keys] if path.kind.is_source() => keys.iter().for_each(|key| {
                self.require(fields, key);
            }),
            forms => self.problems.extend(check_forms(fields, forms)),
        }
        let fluid = fields.get("fluid").filter(|_| fields.known("fluid"));
        let fluid = fluid.map(|raw| self.used_fluid(fields, raw));
        let read = self.read(fields, values);
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

    /// A property is given, or the material that has it.
    fn check_property(&mut self, fields: &Fields<'a>, path: &PathSection) {
        if let Some(value) = path.values.iter().find(|value| value.field.property) {
            self.problems.extend(check_forms(fields, &[&["material"], &[value.field.key]]));
        }
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
        let name = law.declaration().name;
        let own: Vec<&str> = law
            .declaration()
            .fields
            .iter()
            .filter(|field| !field.property)
            .map(|field| field.key)
            .collect();
        let what = match path.kind.is_source() {
            true => format!("`{selector} = \"{name}\"`"),
            false => format!("a {name}"),
        };
        let others: Vec<&str> = path.values().filter(|key| law.field(key).is_none()).collect();
        self.refuse_keys(
            fields,
            &others,
            &format!("means nothing for {what}, which takes {}", list(&own)),
        );
        self.check_oil(fields, law, &what);
        let is_given = |field: &FieldDeclaration| {
            fields.has(field.key)
                || field.default.is_some()
                || field.property
                || field.of_lubricant && fields.has(LUBRICANT_OF.name)
        };
        let missing = law.declaration().fields.iter().find(|field| !is_given(field));
        if let Some(field) = missing.filter(|_| fields.complete) {
            self.report(law_without(fields, field, (&what, path.kind.is_source())));
        }
        Some(law)
    }

    /// A lubricant that says nothing, and a place of none.
    fn check_oil(&mut self, fields: &Fields<'a>, law: Formula, what: &str) {
        let open = |field: &FieldDeclaration| field.of_lubricant && !fields.has(field.key);
        if !law.declaration().fields.iter().any(open) {
            let why = format!("gives nothing that {what} takes");
            self.refuse_keys(fields, &[LUBRICANT_OF.name], &why);
        }
        if !fields.has(LUBRICANT_OF.name) {
            let why = "says where a `lubricant` is, which is not named";
            self.refuse_keys(fields, &[AT.name], why);
        }
    }

    /// The values as far as they are given; stand-ins for those that are wrong.
    fn read(
        &mut self,
        fields: &Fields<'a>,
        wanted: impl Iterator<Item = &'static PathValue>,
    ) -> Vec<Read> {
        wanted.map(|value| (value.field, self.values(fields, value))).collect()
    }

    fn values(&mut self, fields: &Fields<'a>, value: &PathValue) -> Vec<Input> {
        let PathValue { field, most, types, context } = value;
        let wanted = |ty: Option<Type>| Wanted::of_law(ty, *context);
        let raw = fields.get(field.key).filter(|_| fields.known(field.key));
        if let (None, true) = (raw, field.property) {
            return vec![self.property_of_material(fields).unwrap_or_else(|| stand_in(field.ty))];
        }
        if raw.is_none() && field.of_lubricant && fields.has("lubricant") {
            let property = self.property_of_oil(fields, (field.key, field.ty));
            return vec![property.unwrap_or_else(|| stand_in(field.ty))];
        }
        let Some(raw) = raw else {
            let area = fields.area.clone().filter(|_| field.key == "area");
            return area.into_iter().collect();
        };
        if let (RawKind::Array(items), 2..) = (&raw.kind, most) {
            let values: Vec<Input> = items
                .iter()
                .map(|raw| self.input_at(fields, field.key, raw, wanted(Some(field.ty))))
                .collect();
            if values.len() == *most {
                return values;
            }
            self.report(wrong_count(fields, (field, *most), raw, values.len()));
            return Vec::new();
        }
        match types.as_slice() {
            [_] => vec![self.input_at(fields, field.key, raw, wanted(Some(field.ty)))],
            types => {
                let place = Place { owner: &fields.owner, key: field.key, raw };
                self.of_types(place, wanted(None), types).into_iter().collect()
            }
        }
    }

    /// A value of one of several types: which it is chooses the law.
    fn of_types(
        &mut self,
        place: Place<'_>,
        wanted: Wanted,
        types: &[(Type, Formula)],
    ) -> Option<Input> {
        let given = self.given(place, wanted)?;
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
        let problem = Diagnostic::error("netlist::flow_unit", message);
        let problem = problem.at(place.raw.span.clone(), "");
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
        let by_unit = types(law.declaration().kinds[0], first).len() > 1;
        if fields.complete && !fields.has(field.key) && fields.has(first) && by_unit {
            self.report(without(fields, law, field.key));
        }
        None
    }
}

/// That a field of the law that a word chooses is missing.
fn law_without(
    fields: &Fields<'_>,
    field: &FieldDeclaration,
    (what, is_source): (&str, bool),
) -> Diagnostic {
    let (owner, key) = (fields.owner.words(), field.key);
    let message = match is_source {
        true => format!("{owner} has {what} but no `{key}`"),
        false => format!("{owner} is {what} without `{key}`"),
    };
    let problem = fields.missing(key, message);
    if !field.of_lubricant {
        return problem;
    }
    let [value, oil] = [key, LUBRICANT_OF.name].map(|key| fields.sample(key));
    problem.help(format!("add `{value}`, or the oil itself: `{oil}`"))
}
