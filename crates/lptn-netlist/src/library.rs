//! The materials and fluids that ship inside, each number with its source.
//!
//! The text is compiled in and read on first use: a netlist without a material of the library does
//! not pay for it.

use std::sync::LazyLock;

use lptn_data::Files;
use lptn_units::{Dimension, Interpolation, Outside, Table1, Type, parse_quantity};

use crate::format::NetlistFormat;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::syntax;

const TEXT: &str = include_str!("library.toml");

/// Properties over temperature: those of fluids, for films, and of some solids.
const FILMS: &str = include_str!("films.toml");

/// One substance of the library. Values in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct LibrarySubstance {
    /// The name that netlists use.
    pub name: String,
    /// Its description.
    pub title: String,
    /// Density in kg/m^3.
    pub density: Option<f64>,
    /// Specific heat capacity in J/(kg K); of a fluid at constant pressure.
    pub cp: Option<f64>,
    /// Thermal conductivity in W/(m K); of layers in their plane.
    pub k: Option<f64>,
    /// Thermal conductivity across layers in W/(m K), if it differs.
    pub k_through: Option<f64>,
    /// Temperature in K at which the properties of a fluid are valid; for solids `source` gives it.
    pub temperature: Option<f64>,
    /// Source of the numbers, and the state at which they are valid.
    pub source: String,
    /// Properties by key: tables over temperature in K, in SI units, if there are any. Those of a
    /// fluid are for films and flows.
    pub film: Vec<(String, Table1)>,
}

/// A lubricant of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryLubricant {
    /// The name that netlists use.
    pub name: String,
    /// Its description.
    pub title: String,
    /// Kinematic viscosity at 40 and at 100 degC in m^2/s.
    pub viscosity: [f64; 2],
    /// Density at 15 degC in kg/m^3.
    pub density: f64,
    /// Source of the numbers.
    pub source: String,
}

struct Library {
    materials: Vec<LibrarySubstance>,
    fluids: Vec<LibrarySubstance>,
    lubricants: Vec<RawEntry>,
}

static LIBRARY: LazyLock<Library> = LazyLock::new(|| {
    let (raw, films) = (read("library.toml", TEXT), read("films.toml", FILMS));
    let records = |name: &str| {
        let mut records: Vec<_> = raw.elements(name).iter().filter_map(record).collect();
        for record in &mut records {
            let own = films.elements(name).iter().find(|entry| entry.key == record.name);
            record.film = own.map_or_else(Vec::new, film);
        }
        records
    };
    let lubricants = raw.elements("lubricant").to_vec();
    Library { materials: records("material"), fluids: records("fluid"), lubricants }
});

fn read(name: &str, text: &str) -> RawNetlist {
    let mut files = Files::new();
    let file = files.add(name, text);
    syntax::read(&files, file, &NetlistFormat { sections: Vec::new(), later: &[] }).0
}

/// The solids, in the order of the library: steels, irons, light metals, copper alloys, plastics.
pub fn materials() -> &'static [LibrarySubstance] {
    &LIBRARY.materials
}

/// The fluids.
pub fn fluids() -> &'static [LibrarySubstance] {
    &LIBRARY.fluids
}

/// The lubricants.
pub fn lubricants() -> impl Iterator<Item = LibraryLubricant> {
    LIBRARY.lubricants.iter().filter_map(lubricant)
}

/// The lubricants, as a netlist would write them.
pub(crate) fn lubricant_entries() -> &'static [RawEntry] {
    &LIBRARY.lubricants
}

/// The solid or fluid of this name.
pub fn find(name: &str) -> Option<&'static LibrarySubstance> {
    materials().iter().chain(fluids()).find(|record| record.name == name)
}

fn record(entry: &RawEntry) -> Option<LibrarySubstance> {
    let RawKind::Table(table) = &entry.value.kind else { return None };
    let value = |key, ty| Some(parse_quantity(text(table, key)?, Some(ty)).ok()?.value);
    Some(LibrarySubstance {
        name: entry.key.clone(),
        title: text(table, "title")?.to_owned(),
        density: value("density", Type::of(Dimension::DENSITY)),
        cp: value("cp", Type::of(Dimension::SPECIFIC_HEAT)),
        k: value("k", Type::of(Dimension::CONDUCTIVITY)),
        k_through: value("k_through", Type::of(Dimension::CONDUCTIVITY)),
        temperature: value("T", Type::ABSOLUTE_TEMPERATURE),
        source: text(table, "source")?.to_owned(),
        film: Vec::new(),
    })
}

fn lubricant(entry: &RawEntry) -> Option<LibraryLubricant> {
    let RawKind::Table(table) = &entry.value.kind else { return None };
    let quantity =
        |text: &str, dimension| Some(parse_quantity(text, Some(Type::of(dimension))).ok()?.value);
    let nu = |text: &str| quantity(text, Dimension::KINEMATIC_VISCOSITY);
    let viscosity = match text(table, "nu_40") {
        Some(nu_40) => {
            let index = number(&table.get("VI")?.value)?;
            [nu(nu_40)?, lptn_laws::viscosity_at_100(nu(nu_40)? * 1e6, index)? * 1e-6]
        }
        None => {
            let RawKind::Array(points) = &table.get("viscosity")?.value.kind else { return None };
            [nu(second(points.first()?)?)?, nu(second(points.get(1)?)?)?]
        }
    };
    let source = text(table, "source")?;
    Some(LibraryLubricant {
        name: entry.key.clone(),
        title: source.split(':').next()?.to_owned(),
        viscosity,
        density: quantity(text(table, "density")?, Dimension::DENSITY)?,
        source: source.to_owned(),
    })
}

/// The second of a pair: the viscosity of a point.
fn second(pair: &RawValue) -> Option<&str> {
    let RawKind::Array(pair) = &pair.kind else { return None };
    word(pair.get(1)?)
}

/// The properties of a fluid over temperature in K, in SI units.
fn film(fluid: &RawEntry) -> Vec<(String, Table1)> {
    let RawKind::Table(properties) = &fluid.value.kind else { return Vec::new() };
    let property = |entry: &RawEntry| {
        let RawKind::Table(points) = &entry.value.kind else { return None };
        let (x, y) = (numbers(points, "x")?, numbers(points, "y")?);
        let interpolation = match text(points, "interp") {
            Some("linear") => Interpolation::Linear,
            _ => Interpolation::Pchip,
        };
        let table = Table1::new(x, y, interpolation, Outside::Error).ok()?;
        Some((entry.key.clone(), table))
    };
    properties.entries.iter().filter_map(property).collect()
}

fn numbers(table: &RawTable, key: &str) -> Option<Vec<f64>> {
    let RawKind::Array(items) = &table.get(key)?.value.kind else { return None };
    items.iter().map(number).collect()
}

fn number(value: &RawValue) -> Option<f64> {
    match &value.kind {
        RawKind::Integer(text) | RawKind::Float(text) => text.parse().ok(),
        _ => None,
    }
}

fn text<'a>(table: &'a RawTable, key: &str) -> Option<&'a str> {
    word(&table.get(key)?.value)
}

fn word(value: &RawValue) -> Option<&str> {
    match &value.kind {
        RawKind::String { text, .. } => Some(text),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{LIBRARY, TEXT, find, fluids, lubricants, materials};

    #[test]
    fn every_lubricant_of_the_library_is_read() {
        assert_eq!(lubricants().count(), LIBRARY.lubricants.len());
        let oil = lubricants().find(|oil| oil.name == "iso_vg_220").expect("it is shipped");
        // the table of docs/losses.md
        assert!((oil.viscosity[1] - 18.75e-6).abs() < 5e-9, "{:?}", oil.viscosity);
        assert_eq!(oil.title, "mineral oil ISO VG 220");
    }

    /// A record whose text cannot be read would be missing, or lack the number.
    #[test]
    fn every_line_of_the_library_is_read() {
        let all = || materials().iter().chain(fluids());
        let text = TEXT.split("\n[lubricant.").next().unwrap_or_default();
        assert_eq!(text.matches("\nsource =").count(), all().count());
        assert_eq!(
            text.matches("\ndensity =").count(),
            all().filter(|r| r.density.is_some()).count()
        );
        assert_eq!(text.matches("\ncp =").count(), all().filter(|r| r.cp.is_some()).count());
        assert_eq!(text.matches("\nk =").count(), all().filter(|r| r.k.is_some()).count());
        assert_eq!(
            text.matches("\nT =").count(),
            all().filter(|r| r.temperature.is_some()).count()
        );
        assert!(fluids().iter().all(|r| r.temperature.is_some()));
    }

    #[test]
    fn numbers_are_those_of_their_sources() {
        let aluminium = find("aluminium_6061").map(|r| (r.density, r.cp, r.k));
        assert_eq!(aluminium, Some((Some(2700.0), Some(896.0), Some(167.0))));
        assert_eq!(find("steel_8620").and_then(|r| r.cp), Some(475.0));
        assert_eq!(find("air").map(|r| (r.cp, r.temperature)), Some((Some(1006.0), Some(298.15))));
    }

    /// The heat capacity of a volume of a dense solid lies between 1 and 5 MJ/(m^3 K), of plastics
    /// as well.
    #[test]
    fn no_number_is_a_power_of_ten_off() {
        for record in materials() {
            if let (Some(density), Some(cp)) = (record.density, record.cp) {
                assert!((1e6..5e6).contains(&(density * cp)), "{record:?}");
            }
        }
    }
}
