//! The type of a value: its dimension, and whether it is an absolute temperature.
//!
//! Angle is a dimension, so that `Hz` instead of `rpm` is an error. Torque times speed therefore
//! has the unit W rad. One surplus radian is accepted if a power is expected; any other difference
//! is refused.

use std::fmt;

use crate::dimension::Dimension;

/// The type of a value: a dimension, and for temperatures either a point on the scale (absolute) or
/// a difference of two such points.
///
/// 20 degC + 20 degC has no meaning while 20 K + 20 K has, so the two are kept apart.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Type {
    /// The physical dimension.
    pub dimension: Dimension,
    /// A point on the temperature scale; only ever true together with [`Dimension::TEMPERATURE`].
    pub absolute: bool,
}

impl Type {
    /// A point on the temperature scale, in K.
    pub const ABSOLUTE_TEMPERATURE: Self =
        Self { dimension: Dimension::TEMPERATURE, absolute: true };
    /// A plain number.
    pub const SCALAR: Self = Self::of(Dimension::NONE);

    /// A plain quantity of this dimension; a temperature difference for [`Dimension::TEMPERATURE`].
    pub const fn of(dimension: Dimension) -> Self {
        Self { dimension, absolute: false }
    }

    /// True if it is a plain number.
    pub fn is_scalar(&self) -> bool {
        !self.absolute && self.dimension.is_none()
    }

    /// True if it is a temperature, absolute or a difference.
    pub fn is_temperature(&self) -> bool {
        self.dimension == Dimension::TEMPERATURE
    }

    /// The unit to write a value of this type in: `degC` for an absolute temperature, otherwise
    /// [`Dimension::si_unit`].
    pub fn usual_unit(&self) -> String {
        if self.absolute { "degC".to_owned() } else { self.dimension.si_unit() }
    }

    /// True if a value of this type is accepted as `wanted`.
    ///
    /// The types are equal, or the value has exactly one radian too many: a torque (N m) times a
    /// rotational speed (rad/s) is a power. A rotational speed is never a frequency (1/s), and a
    /// torque times a frequency never a power.
    pub fn conforms_to(&self, wanted: Type) -> bool {
        let one_radian_too_many = || {
            !self.absolute
                && !wanted.absolute
                && wanted.dimension != Dimension::FREQUENCY
                && wanted.dimension.checked_mul(Dimension::ANGLE) == Some(self.dimension)
        };
        let alike = self.dimension.is_torque_per_time() == wanted.dimension.is_torque_per_time();
        alike && (*self == wanted || one_radian_too_many())
    }

    /// The more specific of two types that conform: a torque is an energy too.
    pub(crate) fn of_either(self, other: Type) -> Self {
        let kin = self.dimension.kin().either(other.dimension.kin());
        Self { dimension: self.dimension.of_kin(kin), ..self }
    }

    /// True if the two differ only by a power of rad, or by the radian that a torque does not show.
    /// Then a frequency was probably meant to be a rotational speed, which [`Dimension`]
    /// distinguishes.
    ///
    /// `other` is the expected type.
    pub fn differs_by_radians(&self, other: Type) -> bool {
        if self.differs_by_a_turn(other) {
            return true;
        }
        let apart = self.dimension.checked_div(other.dimension).map(|ratio| ratio.exponents());
        // if a frequency is expected, a speed is the mistake
        let due = other.dimension == Dimension::FREQUENCY || self.absolute || other.absolute;
        apart.is_some_and(|[rest @ .., rad]| {
            rest.iter().all(|exponent| exponent.is_zero()) && !rad.is_zero()
        }) && !due
    }

    /// True if only one of them is a torque times a frequency, although they are equal.
    pub(crate) fn differs_by_a_turn(&self, other: Type) -> bool {
        self.dimension == other.dimension
            && self.dimension.is_torque_per_time() != other.dimension.is_torque_per_time()
    }

    /// With the article a sentence needs: `a thermal resistance (K/W)`.
    pub fn with_article(&self) -> String {
        if !self.absolute && self.dimension.quantity_name().is_none() {
            return format!("a quantity in {self}");
        }
        let text = self.to_string();
        let article = if text.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
        format!("{article} {text}")
    }
}

impl fmt::Display for Type {
    /// `absolute temperature`, `thermal resistance (K/W)`, `plain number`, or the unit alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.absolute {
            return f.write_str("absolute temperature");
        }
        match self.dimension.quantity_name() {
            Some(name) if self.is_scalar() => f.write_str(name),
            Some(name) => write!(f, "{name} ({})", self.dimension.si_unit()),
            None => f.write_str(&self.dimension.si_unit()),
        }
    }
}
