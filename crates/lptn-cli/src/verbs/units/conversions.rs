//! Units that engineers use, by quantity.

use lptn_units::Dimension;

/// A quantity and the units it is usually given in, the SI unit first.
pub(crate) const USUAL: &[(Dimension, &[&str])] = &[
    (Dimension::POWER, &["W", "mW", "kW", "BTU/h", "hp"]),
    (Dimension::ENERGY, &["J", "kJ", "MJ", "Wh", "kWh", "cal", "BTU"]),
    (Dimension::TORQUE, &["N m", "N mm", "kN m", "lbf ft", "lbf in"]),
    (Dimension::CAPACITY, &["J/K", "kJ/K", "Wh/K", "BTU/degR"]),
    (Dimension::RESISTANCE, &["K/W", "mK/W", "degR h/BTU"]),
    (Dimension::CONDUCTANCE, &["W/K", "mW/K", "kW/K", "BTU/(h degR)"]),
    (Dimension::FILM_COEFFICIENT, &["W/(m^2 K)", "W/(cm^2 K)", "BTU/(h ft^2 degR)"]),
    (Dimension::AREA_RESISTANCE, &["m^2 K/W", "cm^2 K/W", "mm^2 K/W", "h ft^2 degR/BTU"]),
    (Dimension::CONDUCTIVITY, &["W/(m K)", "W/(mm K)", "BTU/(h ft degR)"]),
    (Dimension::HEAT_FLUX, &["W/m^2", "kW/m^2", "W/cm^2", "BTU/(h ft^2)"]),
    (Dimension::SPECIFIC_HEAT, &["J/(kg K)", "kJ/(kg K)", "J/(g K)", "BTU/(lb degR)"]),
    (Dimension::VOLUMETRIC_HEAT_CAPACITY, &["J/(m^3 K)", "MJ/(m^3 K)", "kJ/(L K)"]),
    (Dimension::DENSITY, &["kg/m^3", "g/cm^3", "kg/L", "lb/ft^3"]),
    (Dimension::TEMPERATURE, &["K", "mK", "degR"]),
    (Dimension::TIME, &["s", "ms", "min", "h", "d"]),
    (Dimension::LENGTH, &["m", "cm", "mm", "um", "in", "ft"]),
    (Dimension::AREA, &["m^2", "cm^2", "mm^2", "in^2", "ft^2"]),
    (Dimension::VOLUME, &["m^3", "L", "mL", "in^3", "gal"]),
    (Dimension::MASS, &["kg", "g", "tonne", "lb", "oz"]),
    (Dimension::MASS_FLOW, &["kg/s", "g/s", "kg/min", "kg/h", "lb/min"]),
    (Dimension::VOLUME_FLOW, &["m^3/s", "L/min", "mL/s", "m^3/h", "gpm", "cfm"]),
    (Dimension::VELOCITY, &["m/s", "km/h", "ft/min", "mph"]),
    (Dimension::ANGULAR_VELOCITY, &["rad/s", "rpm", "rev/s", "deg/s"]),
    (Dimension::FREQUENCY, &["1/s", "Hz", "kHz"]),
    (Dimension::ANGLE, &["rad", "deg", "rev"]),
    (Dimension::FORCE, &["N", "kN", "lbf"]),
    (Dimension::PRESSURE, &["Pa", "kPa", "MPa", "bar", "psi"]),
    (Dimension::DYNAMIC_VISCOSITY, &["Pa s", "mPa s", "cP"]),
    (Dimension::KINEMATIC_VISCOSITY, &["m^2/s", "mm^2/s", "cSt"]),
    (Dimension::HEATING_RATE, &["K/s", "K/min", "K/h"]),
    (Dimension::VOLTAGE, &["V", "mV", "kV"]),
    (Dimension::CURRENT, &["A", "mA"]),
    (Dimension::ELECTRICAL_RESISTANCE, &["ohm", "mohm", "kohm"]),
    (Dimension::NONE, &["1", "%", "ppm"]),
];

/// The units of an absolute temperature.
pub(crate) const ABSOLUTE: &[&str] = &["degC", "degF"];

/// The usual units of a dimension.
pub(crate) fn of(dimension: Dimension) -> &'static [&'static str] {
    // a torque and an energy have one dimension and two units
    let same = |known: &Dimension| *known == dimension && known.si_unit() == dimension.si_unit();
    USUAL.iter().find(|(known, _)| same(known)).map_or(&[], |(_, units)| units)
}

#[cfg(test)]
mod tests {
    use lptn_units::{Type, Unit};

    use super::{ABSOLUTE, USUAL};

    #[test]
    fn every_unit_is_one_of_its_quantity() {
        for (dimension, units) in USUAL {
            assert_eq!(units[0], dimension.si_unit());
            for unit in *units {
                assert_eq!(Unit::parse(unit).unwrap().ty, Type::of(*dimension), "{unit}");
            }
        }
        for unit in ABSOLUTE {
            assert_eq!(Unit::parse(unit).unwrap().ty, Type::ABSOLUTE_TEMPERATURE);
        }
    }
}
