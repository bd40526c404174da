//! `[fluid]`: what streams are made of.

use lptn_data::Diagnostic;
use lptn_laws::{Carries, Formula};
use lptn_network::{Field, FluidId, Input, Item};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::fields::{Fields, Owner, sample};
use crate::library::{self, Record};
use crate::place::Wanted;
use crate::raw::{RawEntry, RawValue};
use crate::vocabulary::FLUID;
use crate::work::{Elaboration, KnownFluid, stand_in};

impl<'a> Elaboration<'a> {
    pub(crate) fn fluids(&mut self) {
        for entry in self.elements(FLUID.name) {
            if self.fluid(entry).is_none() {
                self.names.hide_fluid(&entry.key);
            }
        }
    }

    fn fluid(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element(FLUID.name, &entry.key);
        let fields = Fields::of(&FLUID, owner, entry, &mut self.problems)?;
        let cp = fields.require("cp", &mut self.problems);
        let cp_type = Type::of(Dimension::SPECIFIC_HEAT);
        let cp = cp.and_then(|_| self.property(&fields, "cp", Wanted::own(cp_type)));
        let density = self.property(&fields, "density", Wanted::own(Type::of(Dimension::DENSITY)));
        let source = fields.get("source").and_then(|raw| fields.text("source", raw, &mut self.problems));
        // an unknown key may be the property that is missing
        let known = density.is_some() || !fields.complete;
        let density = density.or_else(|| (!fields.complete).then(|| stand_in(Type::of(Dimension::DENSITY))));
        let cp = cp.unwrap_or_else(|| stand_in(cp_type));
        let id = self.builder.fluid(&entry.key, density, cp, source.map(str::to_owned));
        let item = Item::Fluid(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        for (key, field) in [("density", Field::Density), ("cp", Field::SpecificHeat)] {
            if let Some(raw) = fields.get(key) {
                self.map.value(item, field, raw);
            }
        }
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
        let Carries::VolumeFlow(measured) = law.declaration().carries else { return Some(fluid.id) };
        if fluid.density || !fields.has(measured) {
            return Some(fluid.id);
        }
        let message = format!("{} needs `density` of fluid `{name}`, which has none", fields.owner.words());
        let problem = Diagnostic::error("netlist::no_property", message).at(raw.span.clone(), "");
        self.report(problem.help(format!("add `{}` to the fluid, or give a mass flow", sample("density"))));
        None
    }

    /// A fluid of the file, else of the library.
    pub(crate) fn used_fluid(
        &mut self,
        fields: &Fields<'a>,
        raw: &'a RawValue,
    ) -> Option<(KnownFluid, &'a str, &'a RawValue)> {
        let name = fields.text("fluid", raw, &mut self.problems)?;
        self.used_fluids.insert(name.to_owned());
        if let Some(known) = self.known_fluids.get(name) {
            return Some((*known, name, raw));
        }
        if self.names.is_hidden_fluid(name) {
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

    fn fluid_of_library(&mut self, record: &Record, cp: f64) -> KnownFluid {
        let input = |value: f64, dimension| -> Input {
            Quantity { value, deviation: None, ty: Type::of(dimension) }.into()
        };
        let density = record.density.map(|density| input(density, Dimension::DENSITY));
        let cp = input(cp, Dimension::SPECIFIC_HEAT);
        let id = self.builder.fluid(&record.name, density, cp, Some(record.source.clone()));
        KnownFluid { id, density: record.density.is_some() }
    }

    fn unknown_fluid(&self, fields: &Fields<'_>, (name, raw): (&str, &RawValue)) -> Diagnostic {
        let message = format!("no fluid named `{name}`, which {} refers to", fields.owner.field("fluid"));
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
            "`lptn materials` lists the library; your own belong below [fluid], for example `{name} = {}`",
            FLUID.example
        ))
    }

    /// The fluids of the file that nothing uses.
    pub(crate) fn unused_fluids(&self) -> Vec<Diagnostic> {
        let unused = self.elements(FLUID.name).iter().filter(|e| !self.used_fluids.contains(&e.key));
        let warning = |entry: &RawEntry| {
            Diagnostic::warning("netlist::unused_fluid", format!("nothing uses fluid `{}`", entry.key))
                .at(entry.key_span.clone(), "")
                .help("use it or remove it; a misspelt name elsewhere may be the cause")
        };
        // a file of fluids is there to be chosen from
        let main = self.raw.top.span.file;
        unused.filter(|entry| entry.key_span.file == main).map(warning).collect()
    }
}
