//! How kinds of quantities are related: inverses, frequencies and rotations, the end of the
//! temperature scale.

use std::ops::Range;

use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind};
use crate::types::Type;

/// Whether the inverse of what was found is what is due, and both are quantities that people write:
/// a conductance and a resistance, a time and a frequency. The inverse of a length is a slip.
pub(crate) fn has_inverse(found: Type, wanted: Type) -> bool {
    const WRITTEN: [Dimension; 5] = [
        Dimension::RESISTANCE,
        Dimension::CONDUCTANCE,
        Dimension::FILM_COEFFICIENT,
        Dimension::CONDUCTIVITY,
        Dimension::TIME,
    ];
    let written = WRITTEN.contains(&wanted.dimension) || WRITTEN.contains(&found.dimension);
    written && is_inverse(found, wanted)
}

pub(crate) fn is_inverse(found: Type, wanted: Type) -> bool {
    let inverse = Dimension::NONE.checked_div(found.dimension) == Some(wanted.dimension);
    inverse && !found.absolute && !wanted.is_scalar()
}

/// The unit in which the number of a frequency is that of revolutions: `1/min` means rpm.
pub(crate) fn revolutions(scale: f64) -> Option<&'static str> {
    let is = |other: f64| (scale / other - 1.0).abs() < 1e-12;
    if is(1.0) { Some("rev/s") } else { is(1.0 / 60.0).then_some("rpm") }
}

/// Is a frequency given where a rotation is due?
pub(crate) fn is_frequency_for_rotation(found: Type, wanted: Type) -> bool {
    wanted == Type::of(Dimension::ANGULAR_VELOCITY) && found == Type::of(Dimension::FREQUENCY)
}

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

/// An absolute temperature in K; what rounding puts below 0 K is 0 K.
pub(crate) fn above_absolute_zero(kelvin: f64, span: Range<usize>) -> Result<f64, UnitError> {
    if kelvin < -1e-9 {
        return Err(UnitError::new(UnitErrorKind::BelowAbsoluteZero { kelvin }, span));
    }
    Ok(kelvin.max(0.0))
}
