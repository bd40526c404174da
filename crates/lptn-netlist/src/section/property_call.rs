//! Properties of fluids and materials as functions in expressions: `water.density(T)`.
//!
//! A property that is tabulated over temperature becomes a table of the network, as the functions
//! of a lubricant are. Range, units, derivative and sensitivities are therefore those of tables. A
//! constant is refused: a call would show a dependence on temperature that the number does not
//! have.

use lptn_data::{Diagnostic, Span, list};
use lptn_network::{Field, Item, LawField};
use lptn_units::{Expression, TableSymbol, Type, suggest};

use crate::fields::{Fields, Owner};
use crate::format::SectionDeclaration;
use crate::library;
use crate::place::Place;
use crate::raw::{RawEntry, RawKind};
use crate::section::fluid::FLUID;
use crate::section::lubricant::{self, LUBRICANT};
use crate::section::material::MATERIAL;
use crate::section::table::symbol;
use crate::work::Elaboration;

/// Keys of [fluid] and [material] that may be tables over temperature.
const TABULATED: [&str; 6] = ["density", "cp", "k", "k_through", "viscosity", "expansion"];

/// Symbols of properties, with their keys.
const SYMBOLS: [(&str, &str); 8] = [
    ("rho", "density"),
    ("c", "cp"),
    ("c_p", "cp"),
    ("lambda", "k"),
    ("conductivity", "k"),
    ("mu", "viscosity"),
    ("eta", "viscosity"),
    ("beta", "expansion"),
];

/// True for the key of a property that may be a function.
fn is_key(property: &str) -> bool {
    TABULATED.contains(&property) || lubricant::PROPERTIES.contains(&property)
}

/// The type of a property.
fn type_of(property: &str) -> Option<Type> {
    let key = if property == "k_through" { "k" } else { property };
    LawField::any(key).map(|field| field.ty)
}

/// A substance that an expression names.
#[derive(Clone, Copy)]
struct Called<'a, 'n> {
    section: &'static SectionDeclaration,
    name: &'n str,
    /// Its entry in the file; `None` for one of the library.
    entry: Option<&'a RawEntry>,
}

impl<'a> Elaboration<'a> {
    /// Adds the properties that an expression calls. False if one of them does not exist, which is
    /// reported.
    pub(crate) fn learn_properties(&mut self, place: Place<'_>, expression: &Expression) -> bool {
        let calls = expression.calls().into_iter().map(|named| (named, true));
        let names = expression.names().into_iter().map(|named| (named, false));
        let mut known = true;
        for ((text, range), is_call) in calls.chain(names) {
            let Some((name, property)) = text.rsplit_once('.') else { continue };
            let at = place.raw.part(&range);
            let problem = if is_call {
                self.learn_property((name, property), &place.words(), &at)
            } else {
                self.uncalled((name, property), &place.words(), &at)
            };
            known &= problem.is_none();
            self.problems.extend(problem);
        }
        known
    }

    fn learn_property(
        &mut self,
        (name, property): (&str, &str),
        words: &str,
        at: &Span,
    ) -> Option<Diagnostic> {
        let call = format!("{name}.{property}");
        if self.builder.has_table(&call) || self.names.has_failed(&call) {
            return None;
        }
        let Some(called) = self.substance_called(name) else {
            return self.unknown_substance((name, property), words, at);
        };
        self.used.insert((called.section.name, name.to_owned()));
        if self.names.is_hidden_substance(called.section.name, name) {
            self.names.fail(&call);
            return None;
        }
        match self.function_of(called, property) {
            Some(symbol) => {
                let id = self.builder.table(&call, symbol);
                let place = called.entry.map_or(at, |entry| &entry.key_span);
                self.map.insert(Item::Table(id), Field::Name, place.clone());
                None
            }
            None if self.names.has_failed(&call) => None,
            None => Some(self.no_function(called, property, words).at(at.clone(), "")),
        }
    }

    /// A property without brackets.
    fn uncalled(
        &self,
        (name, property): (&str, &str),
        words: &str,
        at: &Span,
    ) -> Option<Diagnostic> {
        // the search for the substance would cost time in files of many `NAME.T`
        let called = is_key(property).then(|| self.substance_called(name))??;
        let is_function = self.functions(called).any(|known| known == property);
        let hidden = self.names.kind_of(name).is_some() || !is_function;
        (!hidden).then(|| {
            let message = format!("{words} uses `{name}.{property}`, which is a function");
            Diagnostic::wrong(
                "netlist::not_called",
                message,
                at,
                format!("give it a temperature, for example `{name}.{property}(20 [degC])`"),
            )
        })
    }

    /// The lubricant, fluid or material of this name: of the file, else of the library.
    fn substance_called<'n>(&self, name: &'n str) -> Option<Called<'a, 'n>> {
        let sections = [&LUBRICANT, &FLUID, &MATERIAL];
        let own = sections.into_iter().find_map(|section| {
            let entry = self.elements(section.name).iter().find(|entry| entry.key == name)?;
            Some(Called { section, name, entry: Some(entry) })
        });
        let is = |known: &str| known == name;
        own.or_else(|| {
            let section = if library::lubricant_entries().iter().any(|entry| is(&entry.key)) {
                &LUBRICANT
            } else if library::fluids().iter().any(|record| is(&record.name)) {
                &FLUID
            } else if library::materials().iter().any(|record| is(&record.name)) {
                &MATERIAL
            } else {
                return None;
            };
            Some(Called { section, name, entry: None })
        })
    }

    /// A property over temperature; `None` if there is none or if it is wrong, which is noted.
    fn function_of(&mut self, called: Called<'a, '_>, property: &str) -> Option<TableSymbol> {
        let Called { section, name, entry } = called;
        if !TABULATED.contains(&property) || section.name == LUBRICANT.name {
            return None;
        }
        let ty = type_of(property)?;
        let Some(entry) = entry else {
            let (_, table) = library::find(name)?.film.iter().find(|(key, _)| key == property)?;
            return Some(symbol(table, ty));
        };
        self.functions(called).find(|known| *known == property)?;
        // the section itself reports problems of the table
        let reported = self.problems.len();
        let owner = Owner::element(section.name, name.to_owned());
        let fields = Fields::of(section, owner, entry, &mut self.problems);
        let symbol = fields.and_then(|fields| self.property_symbol(&fields, property, ty));
        self.problems.truncate(reported);
        if symbol.is_none() {
            self.names.fail(&format!("{name}.{property}"));
        }
        symbol
    }

    /// The properties of a substance that are functions.
    fn functions(&self, called: Called<'a, '_>) -> impl Iterator<Item = &'a str> + use<'a> {
        let Called { section, name, entry } = called;
        let of_oil: &[&'static str] =
            if section.name == LUBRICANT.name { &lubricant::PROPERTIES } else { &[] };
        let own = entry.into_iter().flat_map(|entry| match &entry.value.kind {
            RawKind::Table(table) => table.entries.as_slice(),
            _ => &[],
        });
        let is_table = |entry: &&RawEntry| matches!(entry.value.kind, RawKind::Table(_));
        let own = own.filter(is_table).map(|entry| entry.key.as_str());
        let own = own.filter(|key| TABULATED.contains(key));
        let shipped = library::find(name).filter(|_| entry.is_none() && of_oil.is_empty());
        let shipped = shipped.into_iter().flat_map(|record| &record.film);
        of_oil.iter().copied().chain(own).chain(shipped.map(|(key, _)| key.as_str()))
    }

    fn no_function(&self, called: Called<'a, '_>, property: &str, words: &str) -> Diagnostic {
        let Called { section, name, entry } = called;
        let substance = format!("{} `{name}`", section.name);
        let key = SYMBOLS.iter().find(|(symbol, _)| *symbol == property).map(|(_, key)| *key);
        let known: Vec<&str> = self.functions(called).collect();
        let constant = constant_of(called, key.unwrap_or(property));
        let constant = constant.filter(|_| !key.is_some_and(|key| known.contains(&key)));
        if let Some(constant) = constant {
            let follows = Expression::parse(&constant).is_ok_and(|e| !e.names().is_empty());
            let has = if follows { "an expression" } else { "one number" };
            let message =
                format!("{words} calls `{name}.{property}`, but {substance} has {has} for it");
            let table = "{ x = [\"20 degC\", \"100 degC\"], y = [.., ..] }";
            let key = key.unwrap_or(property);
            return Diagnostic::error("netlist::no_function", message).help(match entry {
                None => format!("write the number itself: `{constant}`"),
                Some(_) if follows => {
                    format!("write `{constant}` with your temperature in place of `T`")
                }
                Some(_) => format!(
                    "write the number itself, or give it over temperature: `{key} = {table}`"
                ),
            });
        }
        let message =
            format!("{words} calls `{name}.{property}`, a property that {substance} does not have");
        let near = key.filter(|key| known.contains(key));
        let near = near.or_else(|| suggest(property, known.iter().copied()));
        let calls: Vec<String> = known.iter().map(|key| format!("{name}.{key}(..)")).collect();
        let calls: Vec<&str> = calls.iter().map(String::as_str).collect();
        let problem = Diagnostic::error("netlist::no_function", message);
        match (near, calls.is_empty()) {
            (Some(near), _) => problem.help(format!(
                "did you mean `{name}.{near}(..)`? Its functions are {}",
                list(&calls)
            )),
            (None, false) if property == "nu" && known.contains(&"viscosity") => {
                problem.help(format!("write `{name}.viscosity(..) / {name}.density(..)`"))
            }
            (None, false) => problem.help(format!("its functions are {}", list(&calls))),
            (None, true) => problem.help("it has no property over temperature: write the number"),
        }
    }

    /// A name before the dot that is similar to that of a substance, or a property of nothing.
    fn unknown_substance(
        &mut self,
        (name, property): (&str, &str),
        words: &str,
        at: &Span,
    ) -> Option<Diagnostic> {
        let sections = [&LUBRICANT, &FLUID, &MATERIAL];
        let own = sections.into_iter().flat_map(|section| self.elements(section.name));
        let own = own.map(|entry| entry.key.as_str());
        let oils = library::lubricant_entries().iter().map(|entry| entry.key.as_str());
        let records = library::fluids().iter().chain(library::materials());
        let records = records.filter(|record| !record.film.is_empty());
        let all = own.chain(oils).chain(records.map(|record| record.name.as_str()));
        let has = |name: &&str| {
            let called = self.substance_called(name);
            called.is_some_and(|called| self.functions(called).any(|known| known == property))
        };
        let near = suggest(name, all.filter(has));
        if near.is_none() && !is_key(property) || self.names.is_hidden(name) {
            return None;
        }
        let help = match near {
            Some(near) => format!("did you mean `{near}.{property}(..)`?"),
            None => "`lptn materials` lists the library; your own belong below [fluid], \
                [material] or [lubricant]"
                .to_owned(),
        };
        let message =
            format!("{words} calls `{name}.{property}`, but no substance is named `{name}`");
        self.names.fail(&format!("{name}.{property}"));
        Some(Diagnostic::wrong("netlist::unknown_substance", message, at, help))
    }
}

/// The value of a property without a table: of the library as an expression would write it, of the
/// file as it is there.
fn constant_of(called: Called<'_, '_>, property: &str) -> Option<String> {
    let Called { section, name, entry } = called;
    if section.name == LUBRICANT.name || !TABULATED.contains(&property) {
        return None;
    }
    if let Some(entry) = entry {
        let RawKind::Table(table) = &entry.value.kind else { return None };
        return match &table.get(property)?.value.kind {
            RawKind::String { text, .. } => Some(text.clone()),
            RawKind::Table(_) => None,
            _ => Some(property.to_owned()),
        };
    }
    let record = library::find(name)?;
    let value = match property {
        "density" => record.density,
        "cp" => record.cp,
        "k" => record.k,
        "k_through" => record.k_through,
        _ => None,
    };
    let unit = type_of(property)?.usual_unit();
    value.map(|value| format!("{} [{unit}]", lptn_units::format_number(value)))
}
