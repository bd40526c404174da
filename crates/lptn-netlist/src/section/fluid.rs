//! `[fluid]`: what streams are made of.

use lptn_data::Diagnostic;
use lptn_laws::{Carries, Formula};
use lptn_network::{Field, FluidId, Input, Item};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, key};
use crate::library::{self, LibrarySubstance};
use crate::place::Wanted;
use crate::raw::{RawEntry, RawValue};
use crate::section::keys::{CP, SOURCE_OF};
use crate::work::{Elaboration, KnownFluid, stand_in};

pub(crate) const FLUID: SectionDeclaration = SectionDeclaration {
    name: "fluid",
    sentence: "What streams are made of.",
    role: Role::Substance,
    keys: &[
        key("density", "kg/m^3", "density, for volume flows; may depend on `T`", "\"870 kg/m^3\""),
        CP,
        SOURCE_OF,
    ],
    later: &["k", "viscosity"],
    example: "{ density = \"870 kg/m^3\", cp = \"2000 J/(kg K)\" }",
    elsewhere: &[
        ("c", "the specific heat capacity is `cp`"),
        ("rho", "the density is `density`"),
        ("flow", "the flow belongs to the [advection] that carries the fluid"),
    ],
};

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
        self.note(
            Item::Fluid(id),
            &entry.key_span,
            &fields,
            &[Field::Density, Field::SpecificHeat],
        );
        self.known_fluids.insert(entry.key.clone(), KnownFluid { id, density: known });
        Some(())
    }

    /// The fluid of a stream; one whose volume is given needs a density.
    pub(crate) fn fluid_for(
        &mut self,
        fields: &Fields<'a>,
        law: Formula,
        (fluid, name, raw): (KnownFluid, &'a str, &'a RawValue),
    ) -> Option<FluidId> {
        let Carries::VolumeFlow(measured) = law.declaration().carries else {
            return Some(fluid.id);
        };
        if fluid.density || !fields.has(measured) {
            return Some(fluid.id);
        }
        let message =
            format!("{} needs `density` of fluid `{name}`, which has none", fields.owner.words());
        let problem = Diagnostic::error("netlist::no_property", message).at(raw.span.clone(), "");
        self.report(
            problem.help(format!(
                "add `{}` to the fluid, or give a mass flow",
                FLUID.sample("density")
            )),
        );
        None
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
        let density = record.density.map(|density| input(density, Dimension::DENSITY));
        let cp = input(cp, Dimension::SPECIFIC_HEAT);
        let id = self.builder.fluid(&record.name, density, cp, Some(record.source.clone()));
        KnownFluid { id, density: record.density.is_some() }
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
            return problem.help(format!("`{name}` is a material: what flows is a [fluid]"));
        }
        problem.help(format!(
            "`lptn materials` lists the library; your own belong below [fluid], for example \
             `{name} = {}`",
            FLUID.example
        ))
    }
}
