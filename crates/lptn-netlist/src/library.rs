//! The materials and fluids that ship inside, each number with its source.
//!
//! The text is compiled in and read when it is first asked for: a netlist that names no material of
//! the library does not pay for it.

use std::sync::LazyLock;

use lptn_data::Files;
use lptn_units::{Dimension, Type, parse_quantity};

use crate::format::NetlistFormat;
use crate::raw::{RawEntry, RawKind, RawTable};
use crate::syntax;

const TEXT: &str = include_str!("library.toml");

/// One substance of the library. Values in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct LibrarySubstance {
    /// The name that netlists use.
    pub name: String,
    /// What it is, in words.
    pub title: String,
    /// Density in kg/m^3.
    pub density: Option<f64>,
    /// Specific heat capacity in J/(kg K); of a fluid at constant pressure.
    pub cp: Option<f64>,
    /// Thermal conductivity in W/(m K).
    pub k: Option<f64>,
    /// Temperature in K at which the properties of a fluid hold; for solids the source says it.
    pub temperature: Option<f64>,
    /// Where the numbers come from, and at which state they hold.
    pub source: String,
}

struct Library {
    materials: Vec<LibrarySubstance>,
    fluids: Vec<LibrarySubstance>,
    lubricants: Vec<RawEntry>,
}

static LIBRARY: LazyLock<Library> = LazyLock::new(|| {
    let mut files = Files::new();
    let file = files.add("library.toml", TEXT);
    let (raw, _) = syntax::read(&files, file, &NetlistFormat { sections: Vec::new(), later: &[] });
    let section = |name: &str| match raw.top.get(name).map(|entry| &entry.value.kind) {
        Some(RawKind::Table(table)) => table.entries.iter().filter_map(record).collect(),
        _ => Vec::new(),
    };
    let lubricants = raw.elements("lubricant").to_vec();
    Library { materials: section("material"), fluids: section("fluid"), lubricants }
});

/// The solids, in the order of the library: steels, irons, light metals, copper alloys, plastics.
pub fn materials() -> &'static [LibrarySubstance] {
    &LIBRARY.materials
}

/// The fluids.
pub fn fluids() -> &'static [LibrarySubstance] {
    &LIBRARY.fluids
}

/// The lubricants, as a netlist would write them.
pub(crate) fn lubricants() -> &'static [RawEntry] {
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
        temperature: value("T", Type::ABSOLUTE_TEMPERATURE),
        source: text(table, "source")?.to_owned(),
    })
}

fn text<'a>(table: &'a RawTable, key: &str) -> Option<&'a str> {
    match &table.get(key)?.value.kind {
        RawKind::String { text, .. } => Some(text),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{TEXT, find, fluids, materials};

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
