//! Newtypes for values written in Rust, so that a number never enters a network without its unit.

use lptn_units::{Dimension, Type};

use crate::value::{Input, Value};

macro_rules! typed {
    ($($(#[$doc:meta])* $name:ident: $ty:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl From<$name> for Input {
            fn from(value: $name) -> Self {
                Self { value: Value::Constant(value.0), ty: $ty, deviation: None, lump: None }
            }
        }
    )*};
}

typed! {
    /// Absolute temperature in K.
    Temperature: Type::ABSOLUTE_TEMPERATURE;
    /// Heat flow in W.
    HeatFlow: Type::of(Dimension::POWER);
    /// Heat capacity in J/K.
    HeatCapacity: Type::of(Dimension::CAPACITY);
    /// Thermal conductance in W/K.
    Conductance: Type::of(Dimension::CONDUCTANCE);
    /// Thermal resistance in K/W.
    Resistance: Type::of(Dimension::RESISTANCE);
    /// Film coefficient in W/(m^2 K).
    FilmCoefficient: Type::of(Dimension::FILM_COEFFICIENT);
    /// Area in m^2.
    Area: Type::of(Dimension::AREA);
    /// Time in s.
    Time: Type::of(Dimension::TIME);
}

/// 0 degC in K, exact by definition (SI Brochure, 9th edition, section 2.3.1).
pub const ZERO_CELSIUS: f64 = 273.15;

impl Temperature {
    /// The temperature of `celsius` degC.
    pub fn celsius(celsius: f64) -> Self {
        Self(celsius + ZERO_CELSIUS)
    }

    /// This temperature in degC.
    pub fn in_celsius(self) -> f64 {
        self.0 - ZERO_CELSIUS
    }
}

impl Time {
    /// A time of `minutes` min.
    pub fn minutes(minutes: f64) -> Self {
        Self(minutes * 60.0)
    }

    /// A time of `hours` h.
    pub fn hours(hours: f64) -> Self {
        Self(hours * 3600.0)
    }
}
