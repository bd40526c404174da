//! The scale in which a temperature was probably meant.

/// The scales in which a number that stands for a temperature is a plausible one.
///
/// 60 is 60 degC and not 60 K, at which air is liquid; 293.15 is 20 degC in kelvin. Between, and
/// where things glow, it may be either.
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
    /// That of a number without a scale, or of one whose scale may be wrong.
    pub fn of(number: f64) -> Self {
        match number {
            n if n < COLDEST => Self::Celsius,
            n if (HOT..GLOWING).contains(&n) => Self::Kelvin,
            _ => Self::Either,
        }
    }
}

/// Below so many K, -73 degC, a number is one of degrees Celsius.
const COLDEST: f64 = 200.0;
/// From here on to [`GLOWING`] a number is one of kelvin: -23 to 127 degC.
const HOT: f64 = 250.0;
const GLOWING: f64 = 400.0;
