//! `[material]`, and the lumps that are made of materials.

use lptn_data::Diagnostic;
use lptn_network::{Field, Input, Item, MaterialId, Properties, Size};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::fields::{Fields, Owner, sample};
use crate::library::{self, Record};
use crate::place::{Given, Place, Wanted};
use crate::raw::{RawEntry, RawValue};
use crate::vocabulary::{FLUID, MATERIAL};
use crate::work::{Elaboration, Known, stand_in};

/// The properties, by key.
const PROPERTIES: [(&str, Field); 6] = [
    ("density", Field::Density),
    ("cp", Field::SpecificHeat),
    ("k", Field::Conductivity),
    ("solidus", Field::Solidus),
    ("liquidus", Field::Liquidus),
    ("latent_heat", Field::LatentHeat),
];

impl<'a> Elaboration<'a> {
    pub(crate) fn materials(&mut self) {
        for entry in self.elements(MATERIAL.name) {
            self.own_material(entry);
        }
    }

    fn own_material(&mut self, entry: &'a RawEntry) {
        let owner = Owner::element(MATERIAL.name, &entry.key);
        let Some(fields) = Fields::of(&MATERIAL, owner, entry, &mut self.problems) else {
            self.names.hide_material(&entry.key);
            return;
        };
        let density = self.property(&fields, "density", Wanted::constant(Type::of(Dimension::DENSITY)));
        let cp = self.property(&fields, "cp", Wanted::own(Type::of(Dimension::SPECIFIC_HEAT)));
        let k = self.property(&fields, "k", Wanted::own(Type::of(Dimension::CONDUCTIVITY)));
        let melting = self.melting(&fields);
        let source = fields.get("source").and_then(|raw| fields.text("source", raw, &mut self.problems));
        // an unknown key may be the property that is missing
        let known = |property: &Option<Input>| property.is_some() || !fields.complete;
        let (has_density, has_cp, has_k) = (known(&density), known(&cp), known(&k));
        let density = density.or_else(|| (!fields.complete).then(|| stand_in(Type::of(Dimension::DENSITY))));
        let cp = cp.or_else(|| (!fields.complete).then(|| stand_in(Type::of(Dimension::SPECIFIC_HEAT))));
        let k = k.or_else(|| (!fields.complete).then(|| stand_in(Type::of(Dimension::CONDUCTIVITY))));
        let properties = Properties { density, cp, k, melting, source: source.map(str::to_owned) };
        let id = self.builder.material(&entry.key, properties);
        let item = Item::Material(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        for (key, field) in PROPERTIES {
            if let Some(raw) = fields.get(key) {
                self.map.value(item, field, raw);
            }
        }
        self.known.insert(entry.key.clone(), Known { id, density: has_density, cp: has_cp, k: has_k });
    }

    /// The capacity of a node or capacitor: `C`, or `material` with `mass` or `volume`; `None` where neither is.
    pub(crate) fn capacity(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let ty = Type::of(Dimension::CAPACITY);
        let lump = ["material", "mass", "volume"].into_iter().find(|key| fields.get(key).is_some());
        match (fields.get("C"), lump) {
            (None, None) => None,
            (Some(raw), None) => {
                let place = Place { owner: &fields.owner, key: "C", raw };
                let given = self.given(place, Wanted::own(ty));
                Some(given.map_or_else(|| stand_in(ty), Given::input))
            }
            (Some(_), Some(key)) => {
                self.report(two_capacities(fields, key));
                Some(stand_in(ty))
            }
            (None, Some(_)) => Some(self.lump(fields).unwrap_or_else(|| stand_in(ty))),
        }
    }

    /// Notes where a capacity and what it is made of stand.
    pub(crate) fn map_capacity(&mut self, item: Item, fields: &Fields<'a>) {
        let places = [
            (Field::Mass, "mass"),
            (Field::Volume, "volume"),
            (Field::Material, "material"),
            (Field::Capacity, "C"),
        ];
        for (field, key) in places {
            if let Some(raw) = fields.get(key) {
                self.map.value(item, field, raw);
            }
        }
    }

    fn lump(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let size = self.size(fields);
        let raw = fields.require("material", &mut self.problems)?;
        let name = fields.text("material", raw, &mut self.problems)?;
        let known = self.known_material(fields, name, raw)?;
        let size = size?;
        let missing = match size {
            _ if !known.cp => Some("cp"),
            Size::Volume(_) if !known.density => Some("density"),
            _ => None,
        };
        if let Some(property) = missing {
            let problem = self.without_property(fields, (name, raw), known.id, property);
            self.report(problem);
            return None;
        }
        self.builder.lump(known.id, size)
    }

    /// Exactly one of `mass` and `volume`.
    fn size(&mut self, fields: &Fields<'a>) -> Option<Size<Input>> {
        let (mass, volume) = (fields.get("mass"), fields.get("volume"));
        if mass.is_some() && volume.is_some() {
            self.report(two_sizes(fields));
        } else if mass.is_none() && volume.is_none() {
            if fields.complete {
                self.report(no_size(fields));
            }
            return None;
        }
        let mut value = |key, raw, dimension| {
            self.given(Place { owner: &fields.owner, key, raw }, Wanted::constant(Type::of(dimension)))
        };
        let mass = mass.map(|raw| value("mass", raw, Dimension::MASS));
        let volume = volume.map(|raw| value("volume", raw, Dimension::VOLUME));
        match (mass, volume) {
            (Some(mass), None) => Some(Size::Mass(mass?.input())),
            (None, Some(volume)) => Some(Size::Volume(volume?.input())),
            _ => None,
        }
    }

    /// A material of the file, else of the library; a sump is a lump of a fluid.
    pub(crate) fn known_material(
        &mut self,
        fields: &Fields<'_>,
        name: &'a str,
        raw: &RawValue,
    ) -> Option<Known> {
        self.used_materials.insert(name.to_owned());
        if let Some(known) = self.known.get(name) {
            return Some(*known);
        }
        if self.names.is_hidden_material(name) {
            return None;
        }
        let Some(record) = library::find(name) else {
            let own: Vec<&str> =
                self.elements(MATERIAL.name).iter().map(|entry| entry.key.as_str()).collect();
            let is_fluid = self.elements(FLUID.name).iter().any(|entry| entry.key == name);
            self.report(unknown(fields, (name, raw), (&own, is_fluid)));
            return None;
        };
        let id = self.builder.material(name, properties(record));
        self.map.insert(Item::Material(id), Field::Name, raw.span.clone());
        let (density, cp, k) = (record.density.is_some(), record.cp.is_some(), record.k.is_some());
        let known = Known { id, density, cp, k };
        self.known.insert(name.to_owned(), known);
        Some(known)
    }

    pub(crate) fn without_property(
        &self,
        fields: &Fields<'_>,
        (name, raw): (&str, &RawValue),
        id: MaterialId,
        property: &str,
    ) -> Diagnostic {
        let message =
            format!("{} needs `{property}` of material `{name}`, which has none", fields.owner.words());
        let problem = Diagnostic::error("netlist::no_property", message).at(raw.span.clone(), "");
        let own = self.map.name(Item::Material(id)).filter(|span| *span != raw.span);
        let problem = match &own {
            Some(span) => problem.also(span.clone(), format!("`{property}` is missing")),
            None => problem,
        };
        match own {
            Some(_) => problem.help(format!("add `{}` to the material", sample(property))),
            None if property == "k" => {
                problem.help(format!("give the conductivity itself, `{}`", sample("k")))
            }
            None => problem.help("give the capacity itself, for example `C = \"500 J/K\"`"),
        }
    }

    /// The materials of the file that nothing uses.
    pub(crate) fn unused_materials(&self) -> Vec<Diagnostic> {
        let unused = self.elements(MATERIAL.name).iter().filter(|e| !self.used_materials.contains(&e.key));
        let warning = |entry: &RawEntry| {
            let message = format!("nothing uses material `{}`", entry.key);
            Diagnostic::warning("netlist::unused_material", message)
                .at(entry.key_span.clone(), "")
                .help("use it or remove it; a misspelt name elsewhere may be the cause")
        };
        // a file of materials is there to be chosen from
        let main = self.raw.top.span.file;
        unused.filter(|entry| entry.key_span.file == main).map(warning).collect()
    }
}

fn properties(record: &Record) -> Properties {
    let input = |value: Option<f64>, dimension| {
        value.map(|value| Quantity { value, deviation: None, ty: Type::of(dimension) }.into())
    };
    Properties {
        density: input(record.density, Dimension::DENSITY),
        cp: input(record.cp, Dimension::SPECIFIC_HEAT),
        k: input(record.k, Dimension::CONDUCTIVITY),
        melting: None,
        source: Some(record.source.clone()),
    }
}

fn unknown(
    fields: &Fields<'_>,
    (name, raw): (&str, &RawValue),
    (own, is_fluid): (&[&str], bool),
) -> Diagnostic {
    let message = format!("no material named `{name}`, which {} refers to", fields.owner.field("material"));
    let problem = Diagnostic::error("netlist::unknown_material", message)
        .at(raw.span.clone(), "neither in [material] nor in the library");
    let shipped = library::materials().iter().chain(library::fluids()).map(|record| record.name.as_str());
    if is_fluid {
        return problem.help(format!(
            "`{name}` is a fluid of this file: give the capacity itself, or write a [material] of this name as well"
        ));
    }
    match suggest(name, own.iter().copied().chain(shipped)) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem.help(
            "`lptn materials` lists the library; your own belong below [material], for example \
             `steel = { density = \"7850 kg/m^3\", cp = \"475 J/(kg K)\" }`",
        ),
    }
}

fn two_capacities(fields: &Fields<'_>, key: &str) -> Diagnostic {
    let message = format!("{} has `C` as well as `{key}`", fields.owner.words());
    two(Diagnostic::error("netlist::two_capacities", message), fields, ("C", key))
        .help("keep `C`, or `material` with `mass` or `volume`; more parts of a node are a [capacitor] each")
}

fn two_sizes(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} has `mass` as well as `volume`", fields.owner.words());
    two(Diagnostic::error("netlist::two_sizes", message), fields, ("mass", "volume"))
        .help("keep one of them; the material's density gives the other")
}

fn two(mut error: Diagnostic, fields: &Fields<'_>, (first, second): (&str, &str)) -> Diagnostic {
    if let Some(span) = fields.key(first) {
        error = error.at(span.clone(), format!("`{first}` here"));
    }
    match fields.key(second) {
        Some(span) => error.also(span.clone(), format!("`{second}` here")),
        None => error,
    }
}

fn no_size(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} has a `material` but neither `mass` nor `volume`", fields.owner.words());
    Diagnostic::error("netlist::no_size", message)
        .at(fields.place.clone(), "does not say how much of it there is")
        .help(format!("add `{}` or `{}`", sample("mass"), sample("volume")))
}
