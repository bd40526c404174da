//! Torques among the energies, which have the same dimension.
//!
//! N m and J have one dimension, and only the written unit distinguishes them. A dimension
//! therefore carries its kin. The kin takes no part in comparisons; it can only cause more
//! refusals. A torque times a frequency, or divided by a time, is not a power. A torque over a
//! length is a force and loses its kin. A force times a lever arm of two values (`F * r * n`) is
//! not recognised as a torque.

use crate::rational::Rational;

/// The exponents of a dimension: length, mass, time, temperature, current, angle.
pub(crate) type Exponents = [Rational; 6];

/// Properties of a dimension beyond its exponents.
///
/// A torque is an energy per radian, but the radian is not written: a torque of 1 N m does a work
/// of 1 J over a radian and 2π J over a revolution. So `torque * n` with `n` in `1/min` would be
/// a power by its exponents, and too small by 2π.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kin {
    /// Nothing.
    Plain,
    /// A torque is one of its factors.
    Torque,
    /// A torque and a frequency, or the inverse of a time, are among its factors.
    TorquePerTime,
    /// A power over a torque: 1/s by its exponents, and rad/s.
    Turning,
}

/// A kin and its exponents.
pub(crate) type Known = (Kin, Exponents);

impl Kin {
    pub(crate) fn of_product(left: Known, right: Known, product: Exponents) -> Self {
        match (left.0, right.0) {
            (kin, Self::Plain) => kin.with(right.1, product),
            (Self::Plain, kin) => kin.with(left.1, product),
            _ => Self::Plain,
        }
    }

    pub(crate) fn of_quotient(above: Known, below: Known, quotient: Exponents) -> Self {
        match (above.0, below.0) {
            (Self::Plain, Self::Torque) if is_frequency(quotient) => Self::Turning,
            (kin, Self::Plain) => kin.with(below.1, quotient),
            _ => Self::Plain,
        }
    }

    /// With one more factor, or divided by one. A torque over a length is a force.
    fn with(self, factor: Exponents, result: Exponents) -> Self {
        let [length, mass, time, _, _, angle] = factor;
        let of_body = !length.is_zero() || !mass.is_zero();
        let number = factor.iter().all(|exponent| exponent.is_zero());
        match self {
            Self::Turning if number => Self::Turning,
            Self::Plain | Self::Turning => Self::Plain,
            Self::TorquePerTime if !angle.is_zero() => Self::Plain,
            Self::TorquePerTime if of_body || time.is_zero() => self,
            Self::Torque if of_body => Self::Plain,
            Self::TorquePerTime | Self::Torque => Self::of_torque(result),
        }
    }

    /// The kin of a dimension with a torque among its factors, and nothing else of length or mass.
    pub(crate) fn of_torque(exponents: Exponents) -> Self {
        let [_, _, time, _, _, angle] = exponents;
        // a torque has 1/s^2
        let per_time = time.checked_add(Rational::integer(2)).is_some_and(|rest| rest.num() < 0);
        match per_time {
            true if angle.is_zero() => Self::TorquePerTime,
            // a power: the radian of the speed is that of the torque
            true if angle.num() > 0 => Self::Plain,
            _ => Self::Torque,
        }
    }

    /// The kin of a sum, or of a choice of two: an energy next to a torque is one.
    pub(crate) fn either(self, other: Self) -> Self {
        if self == Self::Plain { other } else { self }
    }
}

fn is_frequency([length, mass, time, temperature, current, angle]: Exponents) -> bool {
    let others = [length, mass, temperature, current, angle];
    others.iter().all(|exponent| exponent.is_zero()) && time.as_integer() == Some(-1)
}
