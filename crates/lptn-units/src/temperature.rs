//! The probable scale of a temperature.

/// The plausible scales of a number that means a temperature.
///
/// 60 is 60 degC and not 60 K, at which air is liquid; 293.15 is 20 degC in kelvin. Numbers between
/// these, and those of glowing bodies, may be either.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TemperatureScale {
    /// Degrees Celsius.
    Celsius,
    /// Kelvin.
    Kelvin,
    /// Either of the two.
    Either,
}

impl TemperatureScale {
    /// The scale of a number without one, or with one that may be wrong.
    pub fn of(number: f64) -> Self {
        match number {
            n if n < COLDEST => Self::Celsius,
            n if (HOT..GLOWING).contains(&n) => Self::Kelvin,
            _ => Self::Either,
        }
    }
}

/// A number below this, in K -73 degC, is one of degrees Celsius.
const COLDEST: f64 = 200.0;
/// A number from this up to [`GLOWING`] is one of kelvin: -23 to 127 degC.
const HOT: f64 = 250.0;
const GLOWING: f64 = 400.0;
