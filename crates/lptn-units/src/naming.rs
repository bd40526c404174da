//! Names of dimensions: usual units and usual words.

use std::fmt;

use crate::dimension::{BASE_UNITS, Dimension};
use crate::rational::Rational;

/// Dimension, usual SI unit, usual words.
const KNOWN: &[(Dimension, &str, &str)] = &[
    (Dimension::NONE, "1", "plain number"),
    (Dimension::LENGTH, "m", "length"),
    (Dimension::AREA, "m^2", "area"),
    (Dimension::VOLUME, "m^3", "volume"),
    (Dimension::MASS, "kg", "mass"),
    (Dimension::TIME, "s", "time"),
    (Dimension::TEMPERATURE, "K", "temperature difference"),
    (Dimension::CURRENT, "A", "electric current"),
    (Dimension::ANGLE, "rad", "angle"),
    (Dimension::FREQUENCY, "1/s", "frequency"),
    (Dimension::ANGULAR_VELOCITY, "rad/s", "rotational speed"),
    (Dimension::VELOCITY, "m/s", "velocity"),
    (Dimension::ACCELERATION, "m/s^2", "acceleration"),
    (Dimension::FORCE, "N", "force"),
    (Dimension::PRESSURE, "Pa", "pressure"),
    (Dimension::ENERGY, "J", "energy"),
    (Dimension::TORQUE, "N m", "torque"),
    (Dimension::POWER, "W", "power"),
    (Dimension::CAPACITY, "J/K", "heat capacity"),
    (Dimension::CONDUCTANCE, "W/K", "thermal conductance"),
    (Dimension::RESISTANCE, "K/W", "thermal resistance"),
    (Dimension::FILM_COEFFICIENT, "W/(m^2 K)", "heat transfer coefficient"),
    (Dimension::AREA_RESISTANCE, "m^2 K/W", "thermal resistance of an area"),
    (Dimension::CONDUCTIVITY, "W/(m K)", "thermal conductivity"),
    (Dimension::DENSITY, "kg/m^3", "density"),
    (Dimension::SPECIFIC_HEAT, "J/(kg K)", "specific heat capacity"),
    (Dimension::VOLUMETRIC_HEAT_CAPACITY, "J/(m^3 K)", "volumetric heat capacity"),
    (Dimension::SPECIFIC_ENERGY, "J/kg", "specific energy"),
    (Dimension::HEAT_FLUX, "W/m^2", "heat flux"),
    (Dimension::POWER_DENSITY, "W/m^3", "power density"),
    (Dimension::MASS_FLOW, "kg/s", "mass flow"),
    (Dimension::VOLUME_FLOW, "m^3/s", "volume flow"),
    (Dimension::DYNAMIC_VISCOSITY, "Pa s", "dynamic viscosity"),
    (Dimension::KINEMATIC_VISCOSITY, "m^2/s", "kinematic viscosity or diffusivity"),
    (Dimension::EXPANSION_COEFFICIENT, "1/K", "expansion coefficient"),
    (Dimension::HEATING_RATE, "K/s", "heating rate"),
    (Dimension::TEMPERATURE_GRADIENT, "K/m", "temperature gradient"),
    (Dimension::RADIATION_CONSTANT, "W/(m^2 K^4)", "radiation constant"),
    (Dimension::VOLTAGE, "V", "voltage"),
    (Dimension::ELECTRICAL_RESISTANCE, "ohm", "electrical resistance"),
];

/// Derived units to extract from a product of base units. J is not one of them: a writer of K/W/s
/// thinks in W.
const FACTORS: [(Dimension, &str); 2] = [(Dimension::POWER, "W"), (Dimension::FORCE, "N")];

impl Dimension {
    /// The unit a reader expects: `W`, `K/W`, `J/K`, `W/(m^2 K)`; if the dimension has no usual
    /// unit, the shortest product of base units and one derived unit. `1` for a plain number.
    /// [`Unit::parse`] reads it back with scale 1.
    ///
    /// [`Unit::parse`]: crate::Unit::parse
    pub fn si_unit(&self) -> String {
        match self.known() {
            _ if *self == Dimension::POWER && self.is_torque_per_time() => "N m/s".to_owned(),
            Some((_, unit, _)) => (*unit).to_owned(),
            None => shortest(*self),
        }
    }

    /// Its unit and its words; N m and J are distinguished.
    fn known(&self) -> Option<&'static (Dimension, &'static str, &'static str)> {
        let of_kin = KNOWN.iter().find(|(known, ..)| known == self && known.kin() == self.kin());
        of_kin.or_else(|| KNOWN.iter().find(|(known, ..)| known == self))
    }

    /// The usual name of the quantity, `thermal resistance` for K/W, if it has one.
    pub fn quantity_name(&self) -> Option<&'static str> {
        let plain = || self.known().map(|(_, _, words)| *words);
        if self.is_torque_per_time() { None } else { plain() }
    }
}

impl fmt::Display for Dimension {
    /// In SI base units, `kg m^2/s^3`; `1` for a plain number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&compose(&base_factors(*self)))
    }
}

type Factor = (&'static str, Rational);

/// The product with the fewest factors: base units alone, or with one derived unit pulled out.
fn shortest(dimension: Dimension) -> String {
    let mut best = base_factors(dimension);
    for (derived, symbol) in FACTORS {
        for sign in [1, -1] {
            let exponent = Rational::integer(sign);
            let rest = derived.checked_pow(exponent).and_then(|d| dimension.checked_div(d));
            let Some(rest) = rest else { continue };
            let mut factors = vec![(symbol, exponent)];
            factors.extend(base_factors(rest));
            if factors.len() < best.len() {
                best = factors;
            }
        }
    }
    compose(&best)
}

/// Base units with their exponents, mass first as it is usually written.
fn base_factors(dimension: Dimension) -> Vec<Factor> {
    let [length, mass, time, temperature, current, angle] = dimension.exponents();
    let [m, kg, s, k, a, rad] = BASE_UNITS;
    [(kg, mass), (m, length), (k, temperature), (a, current), (rad, angle), (s, time)]
        .into_iter()
        .filter(|(_, exponent)| !exponent.is_zero())
        .collect()
}

/// `kg m^2/(s^2 K)`: the factors above the bar, then those below it.
fn compose(factors: &[Factor]) -> String {
    let above: Vec<String> =
        factors.iter().filter(|(_, e)| e.num() > 0).map(|&(name, e)| power(name, e)).collect();
    let below: Vec<String> = factors
        .iter()
        .filter(|(_, e)| e.num() < 0)
        .filter_map(|&(name, e)| Some(power(name, e.checked_neg()?)))
        .collect();
    let numerator = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
    match below.as_slice() {
        [] => numerator,
        [one] => format!("{numerator}/{one}"),
        many => format!("{numerator}/({})", many.join(" ")),
    }
}

fn power(name: &str, exponent: Rational) -> String {
    match exponent.as_integer() {
        Some(1) => name.to_owned(),
        Some(n) => format!("{name}^{n}"),
        None => format!("{name}^({exponent})"),
    }
}
