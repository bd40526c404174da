//! Relations between kinds of quantities: inverses, frequencies and rotations, the end of the
//! temperature scale.

use std::ops::Range;

use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind};
use crate::types::Type;

/// True if the inverse of the found type is the wanted one and people write both: a conductance and
/// a resistance, a time and a frequency. The inverse of a length is a slip.
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

/// True if a frequency is given instead of a rotation.
pub(crate) fn is_frequency_for_rotation(found: Type, wanted: Type) -> bool {
    wanted == Type::of(Dimension::ANGULAR_VELOCITY) && found == Type::of(Dimension::FREQUENCY)
}

/// An absolute temperature in K; a value that rounding puts below 0 K becomes 0 K.
pub(crate) fn above_absolute_zero(kelvin: f64, span: Range<usize>) -> Result<f64, UnitError> {
    if kelvin < -1e-9 {
        return Err(UnitError::new(UnitErrorKind::BelowAbsoluteZero { kelvin }, span));
    }
    Ok(kelvin.max(0.0))
}
