//! Torques among the energies, which have the same dimension.

use crate::dimension::Dimension;
use crate::rational::Rational;

/// What is known of a dimension beyond its exponents.
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

impl Kin {
    pub(crate) fn of_product(left: Dimension, right: Dimension, product: Dimension) -> Self {
        match (left.kin(), right.kin()) {
            (Self::Plain, Self::Plain) => Self::Plain,
            (kin, Self::Plain) => kin.with(right, product),
            (Self::Plain, kin) => kin.with(left, product),
            _ => Self::Plain,
        }
    }

    pub(crate) fn of_quotient(above: Dimension, below: Dimension, quotient: Dimension) -> Self {
        match (above.kin(), below.kin()) {
            (Self::Plain, Self::Torque) if above == Dimension::POWER => Self::Turning,
            (kin, Self::Plain) => kin.with(below, quotient),
            _ => Self::Plain,
        }
    }

    /// With one more factor, or divided by one. A torque over a length is a force.
    fn with(self, factor: Dimension, result: Dimension) -> Self {
        let [length, mass, time, _, _, angle] = factor.exponents();
        let of_body = !length.is_zero() || !mass.is_zero();
        match self {
            Self::Plain => Self::Plain,
            Self::Turning if factor.is_none() => Self::Turning,
            Self::Turning => Self::Plain,
            Self::TorquePerTime if !angle.is_zero() => Self::Plain,
            Self::TorquePerTime if of_body || time.is_zero() => self,
            Self::Torque if of_body => Self::Plain,
            Self::TorquePerTime | Self::Torque => Self::of_torque(result),
        }
    }

    /// Of a dimension with a torque among its factors, and nothing else of length or mass.
    pub(crate) fn of_torque(dimension: Dimension) -> Self {
        let [_, _, time, _, _, angle] = dimension.exponents();
        let [_, _, own, ..] = Dimension::ENERGY.exponents();
        let per_time = time.checked_sub(own).is_some_and(|rest: Rational| rest.num() < 0);
        match per_time {
            true if angle.is_zero() => Self::TorquePerTime,
            // a power: the radian of the speed is that of the torque
            true if angle.num() > 0 => Self::Plain,
            _ => Self::Torque,
        }
    }

    /// That of a sum, or of one of two that are chosen from: an energy beside a torque is one.
    pub(crate) fn either(self, other: Self) -> Self {
        if self == Self::Plain { other } else { self }
    }
}
