//! `[resistor]` and `[convection]`: paths between two ends.

use lptn_network::{ConductorKind, End, Field, Input, Item, Path};
use lptn_units::{Dimension, Type};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner, sample};
use crate::raw::{RawEntry, RawValue};
use crate::value::{Place, Wanted};
use crate::vocabulary::{CONVECTION, RESISTOR, Section};

/// The forms of a law, by their keys.
const RESISTOR_FORMS: &[&[&str]] = &[&["R"], &["G"]];
const CONVECTION_FORMS: &[&[&str]] = &[&["R"], &["h", "area"]];

impl<'a> Elaboration<'a> {
    pub(crate) fn resistors(&mut self) {
        for entry in self.elements(RESISTOR.name) {
            let read = self.conductor(entry, &RESISTOR, ConductorKind::Resistor);
            self.doubts.paths |= read.is_none();
        }
    }

    pub(crate) fn convections(&mut self) {
        for entry in self.elements(CONVECTION.name) {
            let read = self.conductor(entry, &CONVECTION, ConductorKind::Convection);
            self.doubts.paths |= read.is_none();
        }
    }

    fn conductor(&mut self, entry: &'a RawEntry, section: &Section, kind: ConductorKind) -> Option<()> {
        let owner = Owner::element(section.name, &entry.key);
        let fields = Fields::of(section, owner, entry, &mut self.problems)?;
        let (from, to) = (self.end(&fields, "from"), self.end(&fields, "to"));
        let path = self.path(&fields, kind);
        let (from, to) = (from?, to?);
        let id = self.builder.conductor(&entry.key, kind, (from.0, to.0), path);
        self.map.conductor(section.name);
        let item = Item::Conductor(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map_fields(item, &fields, (from, to));
        Some(())
    }

    fn map_fields(
        &mut self,
        item: Item,
        fields: &Fields<'a>,
        (from, to): ((End, &RawValue), (End, &RawValue)),
    ) {
        self.map.value(item, Field::From, from.1);
        self.map.value(item, Field::To, to.1);
        let laws = [Field::Resistance, Field::Conductance, Field::FilmCoefficient, Field::Area];
        for field in laws {
            if let Some(raw) = fields.get(field.key()) {
                self.map.value(item, field, raw);
            }
        }
    }

    /// The law; a stand-in where it is wrong, so that the ends still count.
    fn path(&mut self, fields: &Fields<'a>, kind: ConductorKind) -> Path {
        let forms = if kind == ConductorKind::Resistor { RESISTOR_FORMS } else { CONVECTION_FORMS };
        self.problems.extend(check_forms(fields, forms));
        let resistance = self.law(fields, "R", Dimension::RESISTANCE);
        let conductance = self.law(fields, "G", Dimension::CONDUCTANCE);
        let film = self.law(fields, "h", Dimension::FILM_COEFFICIENT);
        let area = self.law(fields, "area", Dimension::AREA);
        match (resistance, conductance, film, area) {
            (None, Some(conductance), ..) => Path::Conductance(conductance),
            (None, None, Some(film), Some(area)) => Path::Film(film, area),
            (resistance, ..) => {
                Path::Resistance(resistance.unwrap_or_else(|| stand_in(Type::of(Dimension::RESISTANCE))))
            }
        }
    }

    fn law(&mut self, fields: &Fields<'a>, key: &str, dimension: Dimension) -> Option<Input> {
        let known = fields.known(key);
        let raw = fields.get(key).filter(|_| known)?;
        let ty = Type::of(dimension);
        let given = self.given(Place { owner: &fields.owner, key, raw }, Wanted::constant(ty));
        Some(given.map_or_else(|| stand_in(ty), |given| given.input()))
    }
}

/// Exactly one form, and all of it.
fn check_forms(fields: &Fields<'_>, forms: &[&[&str]]) -> Option<Diagnostic> {
    let begun: Vec<&&[&str]> =
        forms.iter().filter(|form| form.iter().any(|key| fields.get(key).is_some())).collect();
    match begun.as_slice() {
        [] if fields.complete => Some(no_form(fields, forms)),
        [] => None,
        [form] => form.iter().find(|key| fields.get(key).is_none()).and_then(|key| half(fields, form, key)),
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
