//! `[fluid]`: the fluids of streams and films.

use lptn_data::Diagnostic;
use lptn_laws::{Carries, FieldDeclaration, Formula, Substance};
use lptn_network::{Field, FluidId, Input, Item, LawField};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, property};
use crate::library::{self, LibrarySubstance};
use crate::place::Wanted;
use crate::raw::{RawEntry, RawValue};
use crate::section::keys::{CP_OF_FLUID, SOURCE_OF};
use crate::section::table::{of_temperature, symbol};
use crate::work::{Elaboration, KnownFluid, stand_in};

pub(crate) const FLUID: SectionDeclaration = SectionDeclaration {
    name: "fluid",
    sentence: "Properties of a fluid that flows.",
    role: Role::Substance,
    keys: &[
        property(
            "density",
            "kg/m^3",
            "density, for volume flows; may depend on `T`",
            "\"870 kg/m^3\"",
        ),
        CP_OF_FLUID,
        property(
            "k",
            "W/(m K)",
            "thermal conductivity, for convection; may depend on `T`",
            "\"0.14 W/(m K)\"",
        ),
        property(
            "viscosity",
            "Pa s",
            "dynamic, for convection; may depend on \
            `T`",
            "\"0.07 Pa s\"",
        ),
        property(
            "expansion",
            "1/K",
            "volumetric, for natural convection; may depend on `T`, 1/T for an ideal gas",
            "\"0.0007 1/K\"",
        ),
        SOURCE_OF,
    ],
    example: "{ density = \"870 kg/m^3\", cp = \"2000 J/(kg K)\" }",
    elsewhere: &[
        ("c", "the specific heat capacity is `cp`"),
        ("rho", "the density is `density`"),
        ("flow", "the flow belongs to the [advection] that carries the fluid"),
    ],
    ..SectionDeclaration::NEW
};

/// Properties of a fluid that films need in addition to density and specific heat.
const FILM: [&str; 3] = ["k", "viscosity", "expansion"];

/// A fluid, with its name and the value that names it.
pub(super) type UsedFluid<'a> = (KnownFluid, &'a str, &'a RawValue);

impl<'a> Elaboration<'a> {
    pub(crate) fn fluids(&mut self) {
        for entry in self.elements(FLUID.name) {
            if self.fluid(entry).is_none() {
                self.names.hide_substance(FLUID.name, &entry.key);
            }
        }
    }

    fn fluid(&mut self, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&FLUID, entry)?;
        let cp_type = Type::of(Dimension::SPECIFIC_HEAT);
        self.require(&fields, "cp");
        let cp =
            self.property(&fields, "cp", Wanted::own(cp_type)).unwrap_or_else(|| stand_in(cp_type));
        let ty = Type::of(Dimension::DENSITY);
        let density = self.property(&fields, "density", Wanted::own(ty));
        // an unknown key may be the property that is missing
        let density = density.or_else(|| (!fields.complete).then(|| stand_in(ty)));
        let source = self.word(&fields, "source").map(|(text, _)| text.to_owned());
        let known = density.is_some();
        let id = self.builder.fluid(&entry.key, density, cp, source);
        let mut noted = vec![Field::Density, Field::SpecificHeat];
        for property in FILM.into_iter().filter_map(LawField::any) {
            let own = self.property(&fields, property.key, Wanted::own(property.ty));
            let own = own.or_else(|| (!fields.complete).then(|| stand_in(property.ty)));
            own.into_iter().for_each(|value| self.builder.film_property(id, property, value));
            noted.push(Field::Law(property));
        }
        self.note(Item::Fluid(id), &entry.key_span, &fields, &noted);
        self.known_fluids.insert(entry.key.clone(), KnownFluid { id, density: known });
        Some(())
    }

    /// The fluid of a stream; one whose volume is given needs a density.
    pub(crate) fn fluid_for(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
        (fluid, name, raw): UsedFluid<'a>,
    ) -> Option<FluidId> {
        let Carries::VolumeFlow(measured) = law.declaration().carries else {
            return Some(fluid.id);
        };
        if fluid.density || !fields.has(measured) {
            return Some(fluid.id);
        }
        self.report(lacks(fields, (name, raw), ("density", "a mass flow")));
        None
    }

    /// The fluid of a film, unless all its properties are given otherwise.
    pub(super) fn film_fluid(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
    ) -> Option<UsedFluid<'a>> {
        let properties = law.declaration().fields.iter();
        let mut missing = properties
            .filter(|field| field.property == Some(Substance::Fluid))
            .map(|field| field.key)
            .filter(|key| !fields.has(key));
        let given = fields.get("fluid").filter(|_| fields.known("fluid"));
        match (given, missing.next()) {
            (Some(raw), Some(_)) => self.used_fluid(fields, raw),
            (Some(raw), None) => {
                self.refuse_keys(fields, &["fluid"], "has no effect: its properties are all given");
                self.used_fluid(fields, raw)
            }
            (None, Some(key)) => {
                let message = format!("{} has neither `fluid` nor `{key}`", fields.owner.words());
                let problem = fields.complete.then(|| fields.missing("fluid", message));
                self.problems.extend(problem);
                None
            }
            (None, None) => None,
        }
    }

    /// A property of the fluid of a film.
    pub(super) fn property_of_fluid(
        &mut self,
        fields: &Fields<'a>,
        field: &FieldDeclaration,
        (fluid, name, raw): UsedFluid<'a>,
    ) -> Option<Input> {
        let found = self.builder.property_of(fluid.id, LawField::any(field.key)?);
        if found.is_none() {
            let itself = format!("`{}` of the convection itself", fields.sample(field.key));
            self.report(lacks(fields, (name, raw), (field.key, &itself)));
        }
        found
    }

    /// A fluid of the file, else of the library.
    pub(crate) fn used_fluid(
        &mut self,
        fields: &Fields<'a>,
        raw: &'a RawValue,
    ) -> Option<(KnownFluid, &'a str, &'a RawValue)> {
        let name = fields.text("fluid", raw, &mut self.problems)?;
        self.used.insert((FLUID.name, name.to_owned()));
        if let Some(known) = self.known_fluids.get(name) {
            return Some((*known, name, raw));
        }
        if self.names.is_hidden_substance(FLUID.name, name) {
            return None;
        }
        let record = library::fluids().iter().find(|record| record.name == name);
        let Some((record, cp)) = record.and_then(|record| Some((record, record.cp?))) else {
            let problem = self.unknown_fluid(fields, (name, raw));
            self.report(problem);
            return None;
        };
        let known = self.fluid_of_library(record, cp);
        self.map.insert(Item::Fluid(known.id), Field::Name, raw.span.clone());
        self.known_fluids.insert(name.to_owned(), known);
        Some((known, name, raw))
    }

    fn fluid_of_library(&mut self, record: &LibrarySubstance, cp: f64) -> KnownFluid {
        let input = |value: f64, dimension| -> Input {
            Quantity { value, deviation: None, ty: Type::of(dimension) }.into()
        };
        let density = table(record, "density")
            .or_else(|| record.density.map(|density| input(density, Dimension::DENSITY)));
        let known = density.is_some();
        let cp = table(record, "cp").unwrap_or_else(|| input(cp, Dimension::SPECIFIC_HEAT));
        let id = self.builder.fluid(&record.name, density, cp, Some(record.source.clone()));
        let constant = record.k.filter(|_| record.film.is_empty());
        if let (Some(k), Some(property)) = (constant, LawField::any("k")) {
            self.builder.film_property(id, property, input(k, Dimension::CONDUCTIVITY));
        }
        for property in FILM.into_iter().filter_map(LawField::any) {
            if let Some(value) = table(record, property.key) {
                self.builder.film_property(id, property, value);
            }
        }
        KnownFluid { id, density: known }
    }

    fn unknown_fluid(&self, fields: &Fields<'_>, (name, raw): (&str, &RawValue)) -> Diagnostic {
        let message =
            format!("no fluid named `{name}`, which {} refers to", fields.owner.field("fluid"));
        let problem = Diagnostic::error("netlist::unknown_fluid", message)
            .at(raw.span.clone(), "neither in [fluid] nor in the library");
        let own = self.elements(FLUID.name).iter().map(|entry| entry.key.as_str());
        let shipped = library::fluids().iter().map(|record| record.name.as_str());
        if let Some(near) = suggest(name, own.chain(shipped)) {
            return problem.help(format!("did you mean `{near}`?"));
        }
        if self.elements("material").iter().any(|entry| entry.key == name) {
            return problem.help(format!("`{name}` is a material: a flow needs a [fluid]"));
        }
        problem.help(format!(
            "`lptn materials` lists the library; your own belong below [fluid], with their own \
             numbers instead of `?`: `{name} = {{ density = \"? kg/m^3\", cp = \"? J/(kg K)\" }}`"
        ))
    }
}

/// A property of a substance of the library over its temperature, if there is a table; streams and
/// films share one.
pub(super) fn table(record: &LibrarySubstance, key: &str) -> Option<Input> {
    let (property, table) = record.film.iter().find(|(own, _)| own == key)?;
    let ty = LawField::any(key)?.ty;
    of_temperature(property, symbol(table, ty), ty)
}

/// Error for a fluid without such a property; `instead` names an alternative.
fn lacks(
    fields: &Fields<'_>,
    (name, raw): (&str, &RawValue),
    (key, instead): (&str, &str),
) -> Diagnostic {
    let message =
        format!("{} needs `{key}` of fluid `{name}`, which has none", fields.owner.words());
    Diagnostic::error("netlist::no_property", message)
        .at(raw.span.clone(), "")
        .help(format!("add `{}` to the fluid, or give {instead}", FLUID.sample(key)))
}
