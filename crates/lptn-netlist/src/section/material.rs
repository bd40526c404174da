//! `[material]`, and the lumps that are made of materials.

use lptn_data::Diagnostic;
use lptn_network::{Field, Input, Item, MaterialId, Properties, Size};
use lptn_units::{Dimension, Quantity, Type, suggest};

use crate::fields::Fields;
use crate::format::{ABSOLUTE, Role, SectionDeclaration, Takes, key, property, shaped};
use crate::library::{self, LibrarySubstance};
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::section::fan::FAN;
use crate::section::fluid::{FLUID, table};
use crate::section::keys::{CP, DENSITY, SOURCE_OF};
use crate::section::lubricant::LUBRICANT;
use crate::section::winding::WINDING;
use crate::texture::Texture;
use crate::work::{Elaboration, Known, stand_in};

pub(crate) const MATERIAL: SectionDeclaration = SectionDeclaration {
    name: "material",
    sentence: "Properties of solids; each may be left out if it is not used.",
    role: Role::Substance,
    keys: &[
        DENSITY,
        CP,
        property("k", "W/(m K)", "thermal conductivity, in the same way", "\"46.6 W/(m K)\""),
        property(
            "k_through",
            "W/(m K)",
            "conductivity across layers, of which `k` is that in their plane",
            "\"0.3 W/(m K)\"",
        ),
        shaped(
            "winding",
            "table",
            Takes::Table(&WINDING),
            "instead of the properties: those of wires in resin",
            "{ fill = 0.45, wire = \"copper\", resin = \"peek\" }",
        ),
        key(
            "solidus",
            ABSOLUTE,
            "temperature at which melting begins; all three or \
            none",
            "\"55 degC\"",
        ),
        key(
            "liquidus",
            ABSOLUTE,
            "temperature at which it is molten; `solidus` and \
            above",
            "\"57 degC\"",
        ),
        key("latent_heat", "J/kg", "taken up evenly from `solidus` to `liquidus`", "\"200 kJ/kg\""),
        SOURCE_OF,
    ],
    example: "{ density = \"7850 kg/m^3\", cp = \"475 J/(kg K)\" }",
    elsewhere: &[
        ("c", "the specific heat capacity is `cp`"),
        ("rho", "the density is `density`"),
        ("lambda", "the thermal conductivity is `k`"),
        ("mass", "the mass belongs to the node or capacitor that is made of the material"),
        ("volume", "the volume belongs to the node or capacitor that is made of the material"),
    ],
    ..SectionDeclaration::NEW
};

/// The properties, by key.
const PROPERTIES: [Field; 7] = [
    Field::Density,
    Field::SpecificHeat,
    Field::Conductivity,
    Field::AxialConductivity,
    Field::Solidus,
    Field::Liquidus,
    Field::LatentHeat,
];

impl<'a> Elaboration<'a> {
    pub(crate) fn materials(&mut self) {
        let is_winding = |entry: &&RawEntry| match &entry.value.kind {
            RawKind::Table(table) => table.get(WINDING.name).is_some(),
            _ => false,
        };
        let all = self.elements(MATERIAL.name);
        // a winding is made of other materials
        for entry in all.iter().filter(|entry| !is_winding(entry)) {
            self.own_material(entry);
        }
        for entry in all.iter().filter(is_winding) {
            self.winding(entry);
        }
    }

    fn winding(&mut self, entry: &'a RawEntry) {
        let made = self.fields(&MATERIAL, entry).and_then(|fields| {
            let own = fields.declared().iter().map(|key| key.name);
            let others: Vec<&str> =
                own.filter(|key| !["winding", "source"].contains(key)).collect();
            self.refuse_keys(&fields, &others, "follows from the `winding`");
            let mixture = self.mixture(&fields)?;
            let source = self.word(&fields, "source").map(|(text, _)| text.to_owned());
            let properties = Properties {
                density: Some(mixture.density),
                cp: Some(mixture.cp),
                k: Some(mixture.k),
                k_axis: Some(mixture.k_axis),
                winding: Some(mixture.winding),
                melting: None,
                source,
            };
            let id = self.builder.material(&entry.key, properties);
            self.map.insert(Item::Material(id), Field::Name, entry.key_span.clone());
            self.note_winding(Item::Material(id), &fields);
            Some(id)
        });
        let Some(id) = made else {
            self.names.hide_substance(MATERIAL.name, &entry.key);
            return;
        };
        let known = Known { id, density: true, cp: true, k: true, texture: Texture::Wires };
        self.known.insert(entry.key.clone(), known);
    }

    fn own_material(&mut self, entry: &'a RawEntry) {
        let Some(fields) = self.fields(&MATERIAL, entry) else {
            self.names.hide_substance(MATERIAL.name, &entry.key);
            return;
        };
        // an unknown key may be the property that is missing
        let mut property = |key: &str, wanted: Wanted| {
            let own = self.property(&fields, key, wanted);
            own.or_else(|| (!fields.complete).then(|| stand_in(wanted.ty.unwrap_or(Type::SCALAR))))
        };
        let density = property("density", Wanted::constant(Type::of(Dimension::DENSITY)));
        let cp = property("cp", Wanted::own(Type::of(Dimension::SPECIFIC_HEAT)));
        let k = property("k", Wanted::own(Type::of(Dimension::CONDUCTIVITY)));
        let k_axis = property("k_through", Wanted::own(Type::of(Dimension::CONDUCTIVITY)));
        let layers = fields.get("k_through").is_some();
        if layers {
            self.require(&fields, "k");
        }
        let k_axis = k_axis.filter(|_| layers);
        let has = [&density, &cp, &k].map(Option::is_some);
        let melting = self.melting(&fields);
        let source = self.word(&fields, "source").map(|(text, _)| text.to_owned());
        let id = self.builder.material(
            &entry.key,
            Properties { density, cp, k, k_axis, winding: None, melting, source },
        );
        self.note(Item::Material(id), &entry.key_span, &fields, &PROPERTIES);
        let [density, cp, k] = has;
        let texture = if layers { Texture::Layers } else { Texture::Even };
        self.known.insert(entry.key.clone(), Known { id, density, cp, k, texture });
    }

    /// The capacity of a node or capacitor: `C`, or `material` with `mass` or `volume`; `None` if
    /// neither is given.
    pub(crate) fn capacity(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let ty = Type::of(Dimension::CAPACITY);
        let lump = ["material", "mass", "volume"].into_iter().find(|key| fields.get(key).is_some());
        match (fields.get("C"), lump) {
            (None, None) => None,
            (Some(_), None) => self.input(fields, "C", Wanted::capacity(ty)),
            (Some(_), Some(key)) => {
                let message = format!("has `C` as well as `{key}`");
                self.report(fields.several("netlist::two_capacities", message, ["C", key]).help(
                    "keep `C`, or `material` with `mass` or `volume`; more parts of a node are a \
                     [capacitor] each",
                ));
                Some(stand_in(ty))
            }
            (None, Some(_)) => Some(self.lump(fields).unwrap_or_else(|| stand_in(ty))),
        }
    }

    /// Notes the places of a capacity and of the material that gives it.
    pub(crate) fn map_capacity(&mut self, item: Item, fields: &Fields<'a>) {
        for field in [Field::Mass, Field::Volume, Field::Material, Field::Capacity] {
            if let Some(raw) = fields.get(field.key()) {
                self.map.value(item, field, raw);
            }
        }
    }

    fn lump(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let size = self.size(fields);
        let (name, raw) = self.required_word(fields, "material")?;
        let known = self.known_material(fields, ("material", name), raw)?;
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
        match ["mass", "volume"].map(|key| fields.get(key).is_some()) {
            [true, true] => {
                let message = "has `mass` as well as `volume`".to_owned();
                let problem = fields.several("netlist::two_sizes", message, ["mass", "volume"]);
                self.report(
                    problem.help("keep one of them; the material's density gives the other"),
                );
            }
            [false, false] if fields.complete => self.report(no_size(fields)),
            _ => {}
        }
        let mut value = |key: &str, dimension| {
            let place = Place { owner: &fields.owner, key, raw: fields.get(key)? };
            Some(self.given(place, Wanted::constant(Type::of(dimension))))
        };
        let (mass, volume) = (value("mass", Dimension::MASS), value("volume", Dimension::VOLUME));
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
        (key, name): (&str, &'a str),
        raw: &RawValue,
    ) -> Option<Known> {
        self.used.insert((MATERIAL.name, name.to_owned()));
        if let Some(known) = self.known.get(name) {
            return Some(*known);
        }
        if self.names.is_hidden_substance(MATERIAL.name, name) {
            return None;
        }
        let Some(record) = library::find(name) else {
            let own: Vec<&str> =
                self.elements(MATERIAL.name).iter().map(|entry| entry.key.as_str()).collect();
            let is_fluid = self.elements(FLUID.name).iter().any(|entry| entry.key == name);
            self.report(unknown(fields, (key, name, raw), (&own, is_fluid)));
            return None;
        };
        let id = self.builder.material(name, properties(record));
        self.map.insert(Item::Material(id), Field::Name, raw.span.clone());
        let (density, cp, k) = (record.density.is_some(), record.cp.is_some(), record.k.is_some());
        let layers = record.k_through.is_some();
        let texture = if layers { Texture::Layers } else { Texture::Even };
        let known = Known { id, density, cp, k, texture };
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
        let message = format!(
            "{} needs `{property}` of material `{name}`, which has none",
            fields.owner.words()
        );
        let problem = Diagnostic::error("netlist::no_property", message).at(raw.span.clone(), "");
        let own = self.map.name(Item::Material(id)).filter(|span| *span != raw.span);
        let problem = problem.also(own.clone(), format!("`{property}` is missing"));
        match own {
            Some(_) => problem.help(format!("add `{}` to the material", MATERIAL.sample(property))),
            None if property == "k" => {
                problem.help(format!("give the conductivity itself, `{}`", MATERIAL.sample("k")))
            }
            None => problem.help("give the capacity itself, for example `C = \"500 J/K\"`"),
        }
    }

    /// The materials and fluids of the file that nothing uses.
    pub(crate) fn unused_substances(&self) -> Vec<Diagnostic> {
        // a file of materials is a selection to choose from
        let main = self.raw.top.span.file;
        let named = [
            (&MATERIAL, "netlist::unused_material"),
            (&FLUID, "netlist::unused_fluid"),
            (&LUBRICANT, "netlist::unused_lubricant"),
            (&FAN, "netlist::unused_fan"),
        ];
        let entries = named.into_iter().flat_map(|(section, code)| {
            self.elements(section.name).iter().map(move |entry| (section.name, code, entry))
        });
        let unused = entries.filter(|(section, _, entry)| {
            entry.key_span.file == main && !self.used.contains(&(*section, entry.key.clone()))
        });
        let help = "use it or remove it; a misspelt name elsewhere may be the cause";
        let warning = |(section, code, entry): (&str, &'static str, &RawEntry)| {
            Diagnostic::doubt(
                code,
                format!("nothing uses {section} `{}`", entry.key),
                &entry.key_span,
                help,
            )
        };
        unused.map(warning).collect()
    }
}

fn properties(record: &LibrarySubstance) -> Properties {
    // a lump of a fluid has the constants of the fluid
    let is_solid = record.temperature.is_none();
    let input = |key: &str, value: Option<f64>, dimension| {
        let over_temperature = table(record, key).filter(|_| is_solid);
        let constant = |value| Quantity { value, deviation: None, ty: Type::of(dimension) }.into();
        over_temperature.or(value.map(constant))
    };
    Properties {
        density: input("density", record.density, Dimension::DENSITY),
        cp: input("cp", record.cp, Dimension::SPECIFIC_HEAT),
        k: input("k", record.k, Dimension::CONDUCTIVITY),
        k_axis: input("k_through", record.k_through, Dimension::CONDUCTIVITY),
        winding: None,
        melting: None,
        source: Some(record.source.clone()),
    }
}

fn unknown(
    fields: &Fields<'_>,
    (key, name, raw): (&str, &str, &RawValue),
    (own, is_fluid): (&[&str], bool),
) -> Diagnostic {
    let message =
        format!("no material named `{name}`, which {} refers to", fields.owner.field(key));
    let problem = Diagnostic::error("netlist::unknown_material", message)
        .at(raw.span.clone(), "neither in [material] nor in the library");
    let shipped =
        library::materials().iter().chain(library::fluids()).map(|record| record.name.as_str());
    if is_fluid {
        return problem.help(format!(
            "`{name}` is a fluid of this file: give the capacity itself, or write a [material] of \
             this name as well"
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

fn no_size(fields: &Fields<'_>) -> Diagnostic {
    let message =
        format!("{} has a `material` but neither `mass` nor `volume`", fields.owner.words());
    Diagnostic::error("netlist::no_size", message)
        .at(fields.place.clone(), "has no amount")
        .help(format!("add `{}` or `{}`", fields.sample("mass"), fields.sample("volume")))
}
