//! The units: a fixed table of names, most of which take SI prefixes.

use crate::dimension::Dimension;

/// One unit: `si = (value + offset) * scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    pub(crate) scale: f64,
    /// Added before scaling; only temperatures alone use it.
    pub(crate) offset: f64,
    pub(crate) dimension: Dimension,
    prefixes: bool,
}

const fn si(name: &'static str, scale: f64, dimension: Dimension) -> Entry {
    Entry { name, scale, offset: 0.0, dimension, prefixes: true }
}

const fn plain(name: &'static str, scale: f64, dimension: Dimension) -> Entry {
    Entry { name, scale, offset: 0.0, dimension, prefixes: false }
}

const fn temperature(name: &'static str, scale: f64, offset: f64) -> Entry {
    Entry { name, scale, offset, dimension: Dimension::TEMPERATURE, prefixes: false }
}

const FOOT: f64 = 0.3048;
const POUND: f64 = 0.453_592_37;
const STANDARD_GRAVITY: f64 = 9.806_65;
const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;
const GALLON: f64 = 3.785_411_784e-3;
const BTU: f64 = 1_055.055_852_62;
/// A millimetre of mercury of 13 595.1 kg/m^3 (conventional) in Pa.
const MERCURY: f64 = 13.595_1 * STANDARD_GRAVITY;
const REVOLUTION: f64 = std::f64::consts::TAU;

/// Every unit. SI values: SI Brochure, 9th edition (2019), tables 2 to 8. The others: NIST Special
/// Publication 811 (2008), appendix B: international foot and avoirdupois pound (exact), BTU of the
/// International Table, thermochemical calorie, mechanical horsepower (550 ft lbf/s), metric
/// horsepower (75 kgf m/s), US gallon (231 in^3), conventional columns of mercury and of water
/// (1000 kg/m^3).
pub(crate) const UNITS: &[Entry] = &[
    si("m", 1.0, Dimension::LENGTH),
    si("g", 1e-3, Dimension::MASS),
    si("s", 1.0, Dimension::TIME),
    si("K", 1.0, Dimension::TEMPERATURE),
    si("A", 1.0, Dimension::CURRENT),
    si("rad", 1.0, Dimension::ANGLE),
    si("Hz", 1.0, Dimension::FREQUENCY),
    si("N", 1.0, Dimension::FORCE),
    si("Pa", 1.0, Dimension::PRESSURE),
    si("J", 1.0, Dimension::ENERGY),
    si("W", 1.0, Dimension::POWER),
    si("V", 1.0, Dimension::VOLTAGE),
    si("ohm", 1.0, Dimension::ELECTRICAL_RESISTANCE),
    si("L", 1e-3, Dimension::VOLUME),
    si("l", 1e-3, Dimension::VOLUME),
    si("bar", 1e5, Dimension::PRESSURE),
    si("Wh", 3600.0, Dimension::ENERGY),
    si("eV", 1.602_176_634e-19, Dimension::ENERGY),
    si("P", 0.1, Dimension::DYNAMIC_VISCOSITY),
    si("St", 1e-4, Dimension::KINEMATIC_VISCOSITY),
    si("cal", 4.184, Dimension::ENERGY),
    plain("kg", 1.0, Dimension::MASS),
    plain("tonne", 1e3, Dimension::MASS),
    plain("min", 60.0, Dimension::TIME),
    plain("h", 3600.0, Dimension::TIME),
    plain("d", 86_400.0, Dimension::TIME),
    plain("deg", REVOLUTION / 360.0, Dimension::ANGLE),
    plain("°", REVOLUTION / 360.0, Dimension::ANGLE),
    plain("rev", REVOLUTION, Dimension::ANGLE),
    plain("rpm", REVOLUTION / 60.0, Dimension::ANGULAR_VELOCITY),
    plain("krpm", REVOLUTION / 0.06, Dimension::ANGULAR_VELOCITY),
    plain("rps", REVOLUTION, Dimension::ANGULAR_VELOCITY),
    plain("%", 1e-2, Dimension::NONE),
    plain("ppm", 1e-6, Dimension::NONE),
    temperature("degC", 1.0, 273.15),
    temperature("degF", 5.0 / 9.0, 459.67),
    temperature("degR", 5.0 / 9.0, 0.0),
    plain("atm", 101_325.0, Dimension::PRESSURE),
    plain("psi", POUND_FORCE / (FOOT * FOOT / 144.0), Dimension::PRESSURE),
    plain("in", FOOT / 12.0, Dimension::LENGTH),
    plain("mil", FOOT / 12_000.0, Dimension::LENGTH),
    plain("ft", FOOT, Dimension::LENGTH),
    plain("yd", 3.0 * FOOT, Dimension::LENGTH),
    plain("mi", 5280.0 * FOOT, Dimension::LENGTH),
    plain("mph", 5280.0 * FOOT / 3600.0, Dimension::VELOCITY),
    plain("lb", POUND, Dimension::MASS),
    plain("oz", POUND / 16.0, Dimension::MASS),
    plain("lbf", POUND_FORCE, Dimension::FORCE),
    plain("kgf", STANDARD_GRAVITY, Dimension::FORCE),
    plain("gal", GALLON, Dimension::VOLUME),
    plain("gpm", GALLON / 60.0, Dimension::VOLUME_FLOW),
    plain("cfm", FOOT * FOOT * FOOT / 60.0, Dimension::VOLUME_FLOW),
    plain("lpm", 1e-3 / 60.0, Dimension::VOLUME_FLOW),
    plain("BTU", BTU, Dimension::ENERGY),
    plain("Btu", BTU, Dimension::ENERGY),
    plain("hp", 550.0 * FOOT * POUND_FORCE, Dimension::POWER),
    plain("PS", 75.0 * STANDARD_GRAVITY, Dimension::POWER),
    plain("mmHg", MERCURY, Dimension::PRESSURE),
    plain("inHg", 25.4 * MERCURY, Dimension::PRESSURE),
    plain("torr", 101_325.0 / 760.0, Dimension::PRESSURE),
    plain("mmH2O", STANDARD_GRAVITY, Dimension::PRESSURE),
    plain("inH2O", 25.4 * STANDARD_GRAVITY, Dimension::PRESSURE),
    plain("week", 604_800.0, Dimension::TIME),
    plain("weeks", 604_800.0, Dimension::TIME),
];

const PREFIXES: [(&str, f64); 16] = [
    ("P", 1e15),
    ("T", 1e12),
    ("G", 1e9),
    ("M", 1e6),
    ("k", 1e3),
    ("h", 1e2),
    ("da", 1e1),
    ("d", 1e-1),
    ("c", 1e-2),
    ("m", 1e-3),
    ("u", 1e-6),
    ("n", 1e-9),
    ("p", 1e-12),
    ("f", 1e-15),
    ("a", 1e-18),
    ("E", 1e18),
];

/// Words that people write for units, all in lower case, and the unit they mean.
const ALIASES: &[(&str, &str)] = &[
    ("watt", "W"),
    ("watts", "W"),
    ("joule", "J"),
    ("joules", "J"),
    ("kelvin", "K"),
    ("degk", "K"),
    ("°k", "K"),
    ("c", "degC"),
    ("celsius", "degC"),
    ("gradc", "degC"),
    ("centigrade", "degC"),
    ("f", "degF"),
    ("fahrenheit", "degF"),
    ("r", "degR"),
    ("rankine", "degR"),
    ("sec", "s"),
    ("secs", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("sekunden", "s"),
    ("minuten", "min"),
    ("stunden", "h"),
    ("std", "h"),
    ("mins", "min"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hr", "h"),
    ("hrs", "h"),
    ("hour", "h"),
    ("hours", "h"),
    ("day", "d"),
    ("days", "d"),
    ("t", "tonne"),
    ("ton", "tonne"),
    ("meter", "m"),
    ("metre", "m"),
    ("meters", "m"),
    ("metres", "m"),
    ("liter", "L"),
    ("litre", "L"),
    ("inch", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("kgs", "kg"),
    ("gram", "g"),
    ("grams", "g"),
    ("kilogram", "kg"),
    ("lbs", "lb"),
    ("lbm", "lb"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("rads", "rad"),
    ("revs", "rev"),
    ("bars", "bar"),
    ("ccm", "cm^3"),
    ("cc", "cm^3"),
    ("cbm", "m^3"),
    ("cuft", "ft^3"),
    ("cuin", "in^3"),
    ("sqin", "in^2"),
    ("sqcm", "cm^2"),
    ("micron", "um"),
    ("microns", "um"),
    ("thou", "mil"),
    ("kp", "kgf"),
    ("bhp", "hp"),
    ("wk", "week"),
    ("wks", "weeks"),
    ("ltr", "L"),
    ("liters", "L"),
    ("litres", "L"),
    ("millimeter", "mm"),
    ("millimetre", "mm"),
    ("centimeter", "cm"),
    ("centimetre", "cm"),
    ("kilowatt", "kW"),
    ("kilowatts", "kW"),
    ("kilojoule", "kJ"),
    ("milliseconds", "ms"),
    ("kelvins", "K"),
    ("deg_c", "degC"),
    ("deg_f", "degF"),
    ("turn", "rev"),
    ("percent", "%"),
    ("newton", "N"),
    ("volt", "V"),
    ("ampere", "A"),
    ("amp", "A"),
    ("pascal", "Pa"),
    ("nm", "N m"),
    ("ncm", "N cm"),
    ("nmm", "N mm"),
    ("knm", "kN m"),
    ("ws", "W s"),
    ("ah", "A h"),
    ("mah", "mA h"),
    ("sqm", "m^2"),
    ("qm", "m^2"),
    ("sqmm", "mm^2"),
    ("sqft", "ft^2"),
    ("upm", "rpm"),
    ("ºc", "degC"),
    ("˚c", "degC"),
    ("ºf", "degF"),
    ("˚f", "degF"),
];

/// The unit of this name, prefix included. `name` is in plain letters, see [`plain_name`].
pub(crate) fn find(name: &str) -> Option<Entry> {
    exact(name).or_else(|| {
        PREFIXES.iter().find_map(|(prefix, factor)| {
            let entry = name.strip_prefix(prefix).and_then(exact).filter(|entry| entry.prefixes)?;
            Some(Entry { scale: factor * entry.scale, ..entry })
        })
    })
}

fn exact(name: &str) -> Option<Entry> {
    UNITS.iter().find(|entry| entry.name == name).copied()
}

/// Writes special signs in plain letters: `°C` as `degC`, `µ` (two code points) as `u`, `Ω` as
/// `ohm`.
pub(crate) fn plain_name(written: &str) -> String {
    let mut name = written.replace('℃', "degC").replace('℉', "degF");
    if let Some(scale @ ("C" | "F" | "R")) = name.strip_prefix('°') {
        name = format!("deg{scale}");
    }
    name.replace(['µ', 'μ'], "u").replace(['Ω', '\u{2126}'], "ohm")
}

/// `kgK` as `kg K` and `mPas` as `mPa s`: units that were run together. Other letters at the end of
/// a name are slips.
pub(crate) fn run_together(name: &str) -> Option<String> {
    let joined = |last: &str, of: &dyn Fn(&str) -> bool| {
        let first = name.strip_suffix(last).filter(|first| of(first))?;
        find(first).map(|_| format!("{first} {last}"))
    };
    let by_time = |first: &str| ["Pa", "J", "W"].iter().any(|unit| first.ends_with(unit));
    let kilogram = || name.eq_ignore_ascii_case("kgk").then(|| "kg K".to_owned());
    joined("K", &|_| true)
        .or_else(|| joined("s", &by_time))
        .or_else(|| joined("m", &|first| first.ends_with("kg")))
        .or_else(kilogram)
}

/// Times that are not units because their length is ambiguous, and the text to write.
const CALENDAR: [(&str, &str); 7] = [
    ("a", "a year of 365 days is \"8760 h\""),
    ("yr", "a year of 365 days is \"8760 h\""),
    ("yrs", "a year of 365 days is \"8760 h\""),
    ("year", "a year of 365 days is \"8760 h\""),
    ("years", "a year of 365 days is \"8760 h\""),
    ("month", "a month has no fixed length: 30 days are \"30 d\""),
    ("months", "a month has no fixed length: 30 days are \"30 d\""),
];

/// Help for a unit that is left out on purpose.
pub(crate) fn calendar(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    CALENDAR.iter().find(|(word, _)| *word == lower).map(|(_, say)| *say)
}

/// The unit that was probably meant by an unknown name.
pub(crate) fn meant(name: &str) -> Option<String> {
    if calendar(name).is_some() {
        return None;
    }
    let lower = name.to_lowercase();
    let alias = ALIASES.iter().find(|(word, _)| *word == lower).map(|(_, unit)| *unit);
    const PREFIXED: [&str; 24] = [
        "mm", "cm", "km", "um", "kW", "mW", "uW", "MW", "kJ", "MJ", "mK", "kPa", "MPa", "hPa",
        "mbar", "mL", "kWh", "kHz", "mA", "mV", "cSt", "cP", "kcal", "ms",
    ];
    if let Some([milli, mega]) = TWO_SIZES.iter().find(|[milli, _]| milli.to_lowercase() == lower) {
        // the prefix as written; without any capital letter it is ambiguous
        return match name.starts_with('M') {
            true => Some((*mega).to_owned()),
            false => (name != lower).then(|| (*milli).to_owned()),
        };
    }
    let names = UNITS.iter().map(|entry| entry.name).chain(PREFIXED);
    let near = alias.or_else(|| crate::suggest::suggest(name, names));
    // a slip in the case of letters is likelier than two units, and those likelier than another
    // slip
    let certain =
        near.filter(|near| alias.is_some() || near.eq_ignore_ascii_case(name)).map(str::to_owned);
    certain.or_else(|| run_together(name)).or_else(|| near.map(str::to_owned))
}

/// Units in use with both prefixes that differ in their case only, a thousandth and a million.
const TWO_SIZES: [[&str; 2]; 5] =
    [["mW", "MW"], ["mJ", "MJ"], ["mPa", "MPa"], ["mHz", "MHz"], ["mWh", "MWh"]];
