//! Properties that no solid has: nearly always a unit that is a thousand times too large or too small.

use crate::diagnostic::Diagnostic;
use crate::value::Place;

/// A property, with the range that covers solids from foams to metals with a factor to spare, in SI units.
struct Range {
    key: &'static str,
    unit: &'static str,
    /// A unit a thousand times larger, as it is usually written.
    larger: &'static str,
    from: f64,
    to: f64,
    solids: &'static str,
}

/// The limits are those of real solids near room temperature, with a factor to spare: uranium 116 and lithium 3582
/// J/(kg K), osmium 22587 kg/m^3 (CRC Handbook of Chemistry and Physics, as the package mendeleev 1 has it); silica
/// aerogels 3 kg/m^3 and about 0.015 W/(m K); natural diamond of type IIa 24 to 25 W/(cm K) (Proc. SPIE 2428 (1995) 610).
const RANGES: [Range; 3] = [
    Range {
        key: "cp",
        unit: "J/(kg K)",
        larger: "J/(g K)",
        from: 50.0,
        to: 10_000.0,
        solids: "100 to 4000 J/(kg K)",
    },
    Range {
        key: "density",
        unit: "kg/m^3",
        larger: "g/cm^3",
        from: 1.0,
        to: 30_000.0,
        solids: "3 to 22600 kg/m^3",
    },
    Range {
        key: "k",
        unit: "W/(m K)",
        larger: "W/(mm K)",
        from: 0.005,
        to: 5000.0,
        solids: "0.01 to 2500 W/(m K)",
    },
];

/// A warning if no solid has such a value, given in SI units.
pub(crate) fn check(place: Place<'_>, value: f64) -> Option<Diagnostic> {
    let range = RANGES.iter().find(|range| range.key == place.key)?;
    if value <= 0.0 || (range.from..=range.to).contains(&value) {
        return None; // what is not positive is an error elsewhere
    }
    let message = format!("{} is {} {}, which no solid has", place.words(), short(value), range.unit);
    let warning = Diagnostic::warning("netlist::implausible_property", message)
        .at(place.raw.span.clone(), format!("solids have {}", range.solids));
    let fits = |scale: f64| (range.from..=range.to).contains(&(value * scale));
    Some(if fits(1e3) {
        warning.help(format!("did you mean {} {}?", short(value), range.larger))
    } else if fits(1e-3) {
        warning.help(format!("did you mean {} {}?", short(value * 1e-3), range.unit))
    } else {
        warning.help("check the unit and the number of zeros")
    })
}

/// Without the noise of a change of units.
fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    lptn_units::format_number(rounded)
}
