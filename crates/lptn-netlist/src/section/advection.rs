//! `[advection]` and `[fluid]`: streams and what they are made of.

use lptn_network::{Field, FluidId, Input, Item, Path, Stream};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner, sample};
use crate::library::{self, Record};
use crate::raw::{RawEntry, RawValue};
use crate::section::conductor::check_forms;
use crate::value::{Given, Place, Wanted};
use crate::vocabulary::FLUID;

const FORMS: &[&[&str]] = &[&["mcp"], &["fluid", "flow"]];

const MASS_FLOW: Type = Type::of(Dimension::MASS_FLOW);
const VOLUME_FLOW: Type = Type::of(Dimension::VOLUME_FLOW);

/// A fluid in use or ready to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KnownFluid {
    id: FluidId,
    density: bool,
}

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

    /// The law of a stream.
    pub(crate) fn advection(&mut self, fields: &Fields<'a>) -> Option<Path> {
        self.problems.extend(check_forms(fields, FORMS));
        let rate = self.law(fields, "mcp", Type::of(Dimension::CONDUCTANCE));
        let fluid = fields.get("fluid").and_then(|raw| self.used_fluid(fields, raw));
        let flow = fields.get("flow").and_then(|raw| self.flow(fields, raw));
        let measured = self.law(fields, "flow_T", Type::ABSOLUTE_TEMPERATURE);
        let begun = ["fluid", "flow"].into_iter().any(|key| fields.get(key).is_some());
        if let Some(rate) = rate.filter(|_| !begun) {
            self.refuse_keys(fields, &["flow_T"], "belongs to a volume flow of a fluid");
            return Some(Path::Advection(Stream::Capacity(rate)));
        }
        let flow = flow?;
        if flow.ty().conforms_to(MASS_FLOW) {
            self.refuse_keys(fields, &["flow_T"], "has no effect: `flow` is a mass flow");
            return Some(Path::Advection(Stream::Mass { fluid: fluid?.0.id, flow: flow.input() }));
        }
        let Some(at) = measured else {
            if fields.complete {
                self.report(no_flow_temperature(fields));
            }
            return None;
        };
        let (fluid, name, raw) = fluid?;
        if !fluid.density {
            let message =
                format!("{} needs `density` of fluid `{name}`, which has none", fields.owner.words());
            let problem = Diagnostic::error("netlist::no_property", message).at(raw.span.clone(), "");
            self.report(
                problem.help(format!("add `{}` to the fluid, or give a mass flow", sample("density"))),
            );
            return None;
        }
        Some(Path::Advection(Stream::Volume { fluid: fluid.id, flow: flow.input(), at }))
    }

    /// A mass flow or a volume flow.
    fn flow(&mut self, fields: &Fields<'a>, raw: &'a RawValue) -> Option<Given> {
        let place = Place { owner: &fields.owner, key: "flow", raw };
        let given = self.given(place, Wanted::of_link(None))?;
        let found = given.ty();
        if found.conforms_to(MASS_FLOW) || found.conforms_to(VOLUME_FLOW) {
            return Some(given);
        }
        let message =
            format!("{} must be a mass flow or a volume flow, got {}", place.words(), found.with_article());
        let problem = Diagnostic::error("netlist::flow_unit", message).at(raw.span.clone(), "");
        self.report(problem.help(
            "write it like this: `flow = \"0.05 kg/s\"`, or `flow = \"3 L/min\"` with `flow_T = \"20 degC\"`",
        ));
        None
    }

    /// A fluid of the file, else of the library.
    fn used_fluid(
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

fn no_flow_temperature(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} is a volume flow without `flow_T`", fields.owner.field("flow"));
    let problem = Diagnostic::error("netlist::flow_temperature", message);
    let span = fields.get("flow").map_or(fields.place, |raw| &raw.span);
    problem.at(span.clone(), "").help(format!(
        "say at which temperature the volume is measured, `{}`, or give a mass flow",
        sample("flow_T")
    ))
}
