//! The law of a path or source with its values, read as its kind declares it.

use lptn_data::{Diagnostic, list};
use lptn_laws::{FieldDeclaration, Formula, Kind, Substance};
use lptn_network::{Context, FluidId, Input, Path};
use lptn_units::{Expression, Quantity, Type, suggest};
use smallvec::{SmallVec, smallvec};

use crate::fields::Fields;
use crate::place::{Place, Wanted};
use crate::raw::{RawKind, RawValue};
use crate::section::direction::DIRECTION_OF;
use crate::section::fluid::UsedFluid;
use crate::section::forms::{begun, check_forms};
use crate::section::keys::{AT, LUBRICANT_OF};
use crate::section::path_law::{
    Read, Values, not_a_list, of_values, types, with_article, without, written, wrong_count,
};
use crate::section::path_section::{PathSection, PathValue};
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The law of a path with its values.
    pub(crate) fn path(&mut self, fields: &Fields<'a>, path: &'static PathSection) -> Option<Path> {
        let (groups, forms) = (&path.groups, path.forms.as_slice());
        if let Some(selector) = path.kind.declaration().selector {
            if groups.is_empty() || fields.has(selector) {
                return self.named(fields, path, selector);
            }
            self.refuse_named(fields, path, selector);
        }
        let group = begun(forms, |key| fields.has(key)).first().map(|&first| &groups[first]);
        match forms {
            [keys] if path.kind.is_source() => keys.iter().for_each(|key| {
                self.require(fields, key);
            }),
            forms => self.problems.extend(check_forms(fields, forms)),
        }
        let fluid = fields.get("fluid").filter(|_| path.kind.is_stream());
        let fluid = fluid.map(|raw| self.used_fluid(fields, raw));
        let read = self.read(fields, path.values.iter().filter(|value| value.plain), (None, None));
        let one = || begun(forms, |key| fields.get(key).is_some()).len() == 1;
        let law = of_values(&group?.laws, &read)?;
        let idle = law.declaration().idle.iter().filter(|_| one());
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
            if fields.get("material").is_none() {
                self.refuse_keys(fields, &[DIRECTION_OF.name], "has no effect without `material`");
            }
        }
        let fluid = self.film_fluid(fields, law);
        let own = path.values.iter().filter(|value| law.field(value.field.key).is_some());
        let read = self.read(fields, own, (Some(law), fluid));
        self.complete(fields, law, read, None)
    }

    /// Refuses keys that have no effect unless a word chooses a law that takes them.
    fn refuse_named(&mut self, fields: &Fields<'a>, path: &PathSection, selector: &str) {
        let named = path.values.iter().filter(|value| !value.plain).map(|value| value.field.key);
        let given = ["fluid"].into_iter().chain(named).filter(|key| fields.get(key).is_some());
        let given: Vec<&str> = given.collect();
        if !given.is_empty() {
            self.refuse_keys(fields, &given, &format!("has no effect without `{selector}`"));
        }
    }

    /// The law that a word chooses; fields of other laws have no effect with it.
    fn selected(
        &mut self,
        fields: &Fields<'a>,
        path: &PathSection,
        selector: &str,
    ) -> Option<Formula> {
        let mut words: Vec<(&str, Formula)> =
            path.kind.laws().map(|law| (law.declaration().name, law)).collect();
        // of laws with one word, the one that takes the given keys
        let useless = |law: Formula| {
            path.values().filter(|key| fields.has(key) && law.field(key).is_none()).count()
        };
        words.sort_by_key(|(_, law)| useless(*law));
        let order = |word: &str| path.kind.laws().position(|law| law.declaration().name == word);
        words.sort_by_key(|(word, _)| order(word));
        words.dedup_by_key(|(word, _)| *word);
        let given = self.require(fields, selector).is_some();
        let law = self.choice(fields, selector, &words).filter(|_| given)?;
        let name = law.declaration().name;
        let what = match path.kind.is_source() {
            true => format!("`{selector} = \"{name}\"`"),
            false => with_article(name),
        };
        let own = law.declaration().fields.iter().filter(|field| match field.property {
            Some(Substance::Lubricant) | None => true,
            Some(Substance::Material | Substance::Fluid) => false,
        });
        let takes: Vec<&str> = own.clone().map(|field| field.key).collect();
        let others: Vec<&str> = path.values().filter(|key| law.field(key).is_none()).collect();
        self.refuse_keys(
            fields,
            &others,
            &format!("has no effect for {what}, which takes {}", list(&takes)),
        );
        self.check_oil(fields, (path.kind, law), &what);
        let mut needed = own.filter(|field| {
            let oil = field.property.is_some() && fields.has(LUBRICANT_OF.name);
            !(oil || fields.has(field.key) || field.default.is_some())
        });
        if let Some(field) = needed.next().filter(|_| fields.complete) {
            self.report(law_without(fields, field, (&what, path.kind.is_source())));
        }
        Some(law)
    }

    /// Reports a lubricant without effect, and a place without a lubricant.
    fn check_oil(&mut self, fields: &Fields<'a>, (kind, law): (Kind, Formula), what: &str) {
        if !kind.is_source() {
            return;
        }
        let of_oil = |field: &FieldDeclaration| field.property == Some(Substance::Lubricant);
        let open = |field: &FieldDeclaration| {
            of_oil(field) && !fields.has(field.key) || word_of(fields, field).is_some()
        };
        if !law.declaration().fields.iter().any(open) {
            let why = format!("has no effect: {what} does not use it");
            self.refuse_keys(fields, &[LUBRICANT_OF.name], &why);
        }
        if !fields.has(LUBRICANT_OF.name) {
            let why = "has no effect without a `lubricant`";
            self.refuse_keys(fields, &[AT.name], why);
        }
    }

    /// The given values, of a law that is known if a word chose it; stand-ins for those that are
    /// wrong. Fields without values are left out.
    fn read(
        &mut self,
        fields: &Fields<'a>,
        wanted: impl Iterator<Item = &'static PathValue>,
        of: (Option<Formula>, Option<UsedFluid<'a>>),
    ) -> SmallVec<[Read; 2]> {
        let read = wanted.map(|value| (value.field, self.values(fields, value, of)));
        read.filter(|(_, values)| !values.is_empty()).collect()
    }

    fn values(
        &mut self,
        fields: &Fields<'a>,
        value: &PathValue,
        (law, fluid): (Option<Formula>, Option<UsedFluid<'a>>),
    ) -> Values {
        let PathValue { field, types, context, .. } = value;
        let [least, most] = value.counts(law);
        let wanted = |ty: Option<Type>| Wanted::of_law(ty, *context);
        let raw = fields.get(field.key).filter(|_| fields.known(field.key));
        if let (None, Some(of)) = (raw, field.property) {
            let found = match of {
                Substance::Material => self.property_of_material(fields),
                Substance::Fluid => fluid.and_then(|of| self.property_of_fluid(fields, field, of)),
                Substance::Lubricant => self.property_of_oil(fields, (field.key, field.ty)),
            };
            return smallvec![found.unwrap_or_else(|| stand_in(field.ty))];
        }
        if let Some(raw) = raw.filter(|_| !field.words.is_empty())
            && self.misspelt(fields, field, raw)
        {
            return smallvec![stand_in(field.ty)];
        }
        if let Some((word, expression)) = word_of(fields, field) {
            let found = self.meant_by(fields, field, (word, expression));
            return smallvec![found.unwrap_or_else(|| stand_in(field.ty))];
        }
        let Some(raw) = raw else {
            let area = fields.area.clone().filter(|_| field.key == "area");
            return area.into_iter().collect();
        };
        if let (RawKind::Array(items), 2..) = (&raw.kind, most) {
            let values: Values = items
                .iter()
                .map(|raw| self.input_at(fields, field.key, raw, wanted(Some(field.ty))))
                .collect();
            if values.len() == most {
                return values;
            }
            let told = if least > 1 { not_a_list } else { wrong_count };
            self.report(told(fields, (field, most), raw, values.len()));
            return Values::new();
        }
        if least > 1 {
            self.report(not_a_list(fields, (field, most), raw, 1));
            return Values::new();
        }
        match types.as_slice() {
            [_] => smallvec![self.input_at(fields, field.key, raw, wanted(Some(field.ty)))],
            types => {
                let place = Place { owner: &fields.owner, key: field.key, raw };
                self.of_types(place, wanted(None), types).into_iter().collect()
            }
        }
    }

    /// A value of one of several types, which chooses the law.
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
        let known = self.known_material(fields, ("material", name), raw)?;
        if !known.k {
            let problem = self.without_property(fields, (name, raw), known.id, "k");
            self.report(problem);
            return None;
        }
        self.directed(fields, (name, known))
    }

    /// True if a word is similar to one that may replace a number in a field; this is reported.
    fn misspelt(&mut self, fields: &Fields<'a>, field: &FieldDeclaration, raw: &RawValue) -> bool {
        let RawKind::String { text, .. } = &raw.kind else { return false };
        let text = text.as_str();
        let words = field.words.iter().map(|(word, _)| *word);
        let near = suggest(text, words.clone()).filter(|_| words.clone().all(|word| word != text));
        let Some(near) = near.filter(|_| self.names.value_kind(text).is_none()) else {
            return false;
        };
        let message = format!("{} cannot be \"{text}\"", fields.owner.field(field.key));
        let help = format!("did you mean `{} = \"{near}\"`?", field.key);
        self.refuse("netlist::unknown_word", message, &raw.span, help);
        true
    }

    /// The meaning of a word in a field of the lubricant.
    fn meant_by(
        &mut self,
        fields: &Fields<'a>,
        field: &FieldDeclaration,
        (word, expression): (&str, &str),
    ) -> Option<Input> {
        let Some(oil) = &fields.oil else {
            if !fields.has(LUBRICANT_OF.name) {
                let words = fields.owner.field(field.key);
                let message = format!("{words} is \"{word}\", but no `lubricant` is named");
                let [value, oil] = [field.key, LUBRICANT_OF.name].map(|key| fields.sample(key));
                let help = format!("name the oil: `{oil}`; or give the number: `{value}`");
                let place = fields.get(field.key).map_or(fields.place, |raw| &raw.span);
                self.refuse("netlist::no_property", message, place, help);
            }
            return None;
        };
        let expression = Expression::parse(&expression.replace("OIL", &oil.name)).ok()?;
        let scope = self.builder.scope(Context::Source);
        Some(expression.compile(&scope, Some(field.ty)).ok()?.into())
    }

    /// A law with all its values, and defaults for those that may be left out.
    fn complete(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
        mut read: SmallVec<[Read; 2]>,
        fluid: Option<FluidId>,
    ) -> Option<Path> {
        let declared = law.declaration();
        let mut values: Vec<Input> = Vec::with_capacity(declared.fields.len());
        for same in declared.fields.chunk_by(|a, b| a.key == b.key) {
            let found = read.iter_mut().find(|(field, _)| field.key == same[0].key);
            let given = found.map(|(_, values)| std::mem::take(values)).unwrap_or_default();
            match (given, same[0].default) {
                (given, _) if given.len() == same.len() => values.extend(given),
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

    /// Reports a field that this law needs in addition to those that chose it.
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

/// The word instead of a number in a field, with the expression that it means.
fn word_of(fields: &Fields<'_>, field: &FieldDeclaration) -> Option<(&'static str, &'static str)> {
    let RawKind::String { text, .. } = &fields.get(field.key)?.kind else { return None };
    field.words.iter().find(|(word, _)| word == text).copied()
}

/// Error for a missing field of the law that a word chooses.
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
    if field.property != Some(Substance::Lubricant) {
        return problem;
    }
    let [value, oil] = [key, LUBRICANT_OF.name].map(|key| fields.sample(key));
    problem.help(format!("add `{value}`, or the oil itself: `{oil}`"))
}
