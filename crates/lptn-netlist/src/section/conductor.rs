//! The sections of paths between two ends: `[resistor]`, `[convection]`, `[contact]` here, the others in files of
//! their own.

use lptn_network::{ConductorKind, Field, Input, Item, Path, Terminal};
use lptn_units::{Dimension, Type};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner, sample};
use crate::raw::{RawEntry, RawValue};
use crate::value::{Place, Wanted};
use crate::vocabulary::{ADVECTION, CONDUCTION, CONTACT, CONVECTION, RADIATION, RESISTOR, Section};

/// The forms of a law, by their keys.
const RESISTOR_FORMS: &[&[&str]] = &[&["R"], &["G"]];
const CONVECTION_FORMS: &[&[&str]] = &[&["R"], &["h", "area"]];
const CONTACT_FORMS: &[&[&str]] = &[&["h", "area"]];

/// The sections of paths, in the order in which their columns stand.
pub(crate) const PATHS: [(&Section, ConductorKind); 6] = [
    (&RESISTOR, ConductorKind::Resistor),
    (&CONDUCTION, ConductorKind::Conduction),
    (&CONVECTION, ConductorKind::Convection),
    (&CONTACT, ConductorKind::Contact),
    (&RADIATION, ConductorKind::Radiation),
    (&ADVECTION, ConductorKind::Advection),
];

/// Where the values of a path stand; `from` and `to` are noted by themselves.
const FIELDS: [Field; 18] = [
    Field::Resistance,
    Field::Conductance,
    Field::FilmCoefficient,
    Field::Area,
    Field::Material,
    Field::Conductivity,
    Field::Thickness,
    Field::InnerRadius,
    Field::OuterRadius,
    Field::Length,
    Field::Diameter,
    Field::Exchange,
    Field::Emissivity,
    Field::ViewFactor,
    Field::StreamCapacity,
    Field::Fluid,
    Field::Flow,
    Field::FlowTemperature,
];

impl<'a> Elaboration<'a> {
    /// Every path between two ends.
    pub(crate) fn conductors(&mut self) {
        for (section, kind) in PATHS {
            for entry in self.elements(section.name) {
                let read = self.conductor(entry, section, kind);
                self.doubts.paths |= read.is_none();
            }
        }
    }

    fn conductor(&mut self, entry: &'a RawEntry, section: &Section, kind: ConductorKind) -> Option<()> {
        let owner = Owner::element(section.name, &entry.key);
        let mut fields = Fields::of(section, owner, entry, &mut self.problems)?;
        let (from, to) = (self.terminal(&fields, "from"), self.terminal(&fields, "to"));
        fields.area = self.area_of(&fields, [&from, &to]);
        // a stand-in where the law is wrong, so that the ends still count
        let path = self.path(&fields, kind);
        let path = path.unwrap_or_else(|| Path::Resistance(stand_in(Type::of(Dimension::RESISTANCE))));
        let (from, to) = (from?, to?);
        let before = self.builder.sizes();
        let item = self.builder.connect(&entry.key, kind, (from.0, to.0), path);
        match item {
            Item::Joint(_) => {
                self.map.joint(section.name);
                self.note_parts(before, item, section.name);
            }
            _ => self.map.conductor(section.name),
        }
        self.map_fields(item, &fields, (from, to));
        self.map.insert(item, Field::Name, entry.key_span.clone());
        Some(())
    }

    fn map_fields(
        &mut self,
        item: Item,
        fields: &Fields<'a>,
        (from, to): ((Terminal, &RawValue), (Terminal, &RawValue)),
    ) {
        self.map.value(item, Field::From, from.1);
        self.map.value(item, Field::To, to.1);
        for field in FIELDS {
            if let Some(raw) = fields.get(field.key()) {
                self.map.value(item, field, raw);
            }
        }
    }

    fn path(&mut self, fields: &Fields<'a>, kind: ConductorKind) -> Option<Path> {
        match kind {
            ConductorKind::Resistor => self.simple(fields, RESISTOR_FORMS),
            ConductorKind::Convection => self.simple(fields, CONVECTION_FORMS),
            ConductorKind::Contact => self.simple(fields, CONTACT_FORMS),
            ConductorKind::Conduction => self.conduction(fields),
            ConductorKind::Radiation => self.radiation(fields),
            ConductorKind::Advection => self.advection(fields),
        }
    }

    /// A resistance, a conductance, or a film coefficient with its area.
    fn simple(&mut self, fields: &Fields<'a>, forms: &[&[&str]]) -> Option<Path> {
        self.problems.extend(check_forms(fields, forms));
        let resistance = self.law(fields, "R", Type::of(Dimension::RESISTANCE));
        let conductance = self.law(fields, "G", Type::of(Dimension::CONDUCTANCE));
        let film = self.law(fields, "h", Type::of(Dimension::FILM_COEFFICIENT));
        let area = self.law(fields, "area", Type::of(Dimension::AREA));
        match (resistance, conductance, film, area) {
            (None, Some(conductance), ..) => Some(Path::Conductance(conductance)),
            (None, None, Some(film), Some(area)) => Some(Path::Film(film, area)),
            (resistance, ..) => resistance.map(Path::Resistance),
        }
    }

    /// The value of a field of a path, which may depend on time and temperatures; a stand-in if it is wrong.
    pub(crate) fn law(&mut self, fields: &Fields<'a>, key: &str, ty: Type) -> Option<Input> {
        let known = fields.known(key);
        let Some(raw) = fields.get(key).filter(|_| known) else {
            return fields.area.clone().filter(|_| known && key == "area");
        };
        let given = self.given(Place { owner: &fields.owner, key, raw }, Wanted::of_link(ty));
        Some(given.map_or_else(|| stand_in(ty), |given| given.input()))
    }
}

/// Exactly one form, and all of it.
pub(crate) fn check_forms(fields: &Fields<'_>, forms: &[&[&str]]) -> Option<Diagnostic> {
    let begun: Vec<&&[&str]> =
        forms.iter().filter(|form| form.iter().any(|key| fields.get(key).is_some())).collect();
    match begun.as_slice() {
        [] if fields.complete => Some(no_form(fields, forms)),
        [] => None,
        [form] => form.iter().find(|key| !fields.has(key)).and_then(|key| half(fields, form, key)),
        _ => Some(two_forms(fields, &begun)),
    }
}

fn words(form: &[&str]) -> String {
    form.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(" and ")
}

fn written(form: &[&str]) -> String {
    form.iter().map(|key| sample(key)).collect::<Vec<_>>().join(", ")
}

fn no_form(fields: &Fields<'_>, forms: &[&[&str]]) -> Diagnostic {
    let either: Vec<String> = forms.iter().map(|form| words(form)).collect();
    let message = format!("{} has neither {}", fields.owner.words(), either.join(" nor "));
    let samples: Vec<String> = forms.iter().map(|form| format!("`{}`", written(form))).collect();
    Diagnostic::error("netlist::no_law", message)
        .at(fields.place.clone(), "does not say how much heat it carries")
        .help(format!("add {}", samples.join(" or ")))
}

fn half(fields: &Fields<'_>, form: &[&str], missing: &str) -> Option<Diagnostic> {
    if !fields.complete {
        return None;
    }
    let given = form.iter().find(|key| **key != missing)?;
    let message = format!("{} has `{given}` but no `{missing}`", fields.owner.words());
    Some(
        Diagnostic::error("netlist::missing_field", message)
            .at(fields.place.clone(), format!("`{missing}` is missing"))
            .help(format!("add `{}`", sample(missing))),
    )
}

fn two_forms(fields: &Fields<'_>, begun: &[&&[&str]]) -> Diagnostic {
    let both: Vec<String> = begun.iter().map(|form| words(form)).collect();
    let message = format!("{} has {} as well as {}", fields.owner.words(), both[0], both[1..].join(" and "));
    let mut error = Diagnostic::error("netlist::two_laws", message);
    let keys = begun.iter().flat_map(|form| form.iter()).filter_map(|key| Some((*key, fields.key(key)?)));
    for (n, (key, span)) in keys.enumerate() {
        let span = span.clone();
        error = if n == 0 {
            error.at(span, format!("`{key}` here"))
        } else {
            error.also(span, format!("`{key}` here"))
        };
    }
    error.help("keep one of them; two paths side by side are two elements")
}
