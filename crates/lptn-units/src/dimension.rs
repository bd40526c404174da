//! Physical dimensions with rational exponents, the angle among them.

use std::fmt;
use std::hash::{Hash, Hasher};

use crate::kin::{Kin, Known};
use crate::rational::Rational;

/// A physical dimension: exponents of length, mass, time, temperature, current and angle.
///
/// The angle is a separate dimension here, unlike in the SI: 50 Hz and 50 rad/s differ by a factor
/// of 2π that no number shows, and only the dimension can distinguish them.
///
/// A torque (N m) and an energy (J) are equal here, as their exponents are. A dimension remembers
/// which of the two it is, because only an energy times a frequency is a power; see
/// [`Dimension::is_torque_per_time`].
#[derive(Clone, Copy)]
pub struct Dimension {
    exponents: [Rational; 6],
    /// It takes no part in comparisons.
    kin: Kin,
}

impl PartialEq for Dimension {
    fn eq(&self, other: &Self) -> bool {
        self.exponents == other.exponents
    }
}

impl Eq for Dimension {}

impl Hash for Dimension {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.exponents.hash(state);
    }
}

/// Symbols of the base units, in the order of the exponents.
pub(crate) const BASE_UNITS: [&str; 6] = ["m", "kg", "s", "K", "A", "rad"];

macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident = [$($exponent:literal),*];)*) => {
        impl Dimension {
            $($(#[$doc])* pub const $name: Self = Self::integers([$($exponent),*]);)*
        }
    };
}

dimensions! {
    /// Plain number.
    NONE = [0, 0, 0, 0, 0, 0];
    /// m
    LENGTH = [1, 0, 0, 0, 0, 0];
    /// m^2
    AREA = [2, 0, 0, 0, 0, 0];
    /// m^3
    VOLUME = [3, 0, 0, 0, 0, 0];
    /// kg
    MASS = [0, 1, 0, 0, 0, 0];
    /// s
    TIME = [0, 0, 1, 0, 0, 0];
    /// K; see [`Type`](crate::Type) for absolute temperatures and differences.
    TEMPERATURE = [0, 0, 0, 1, 0, 0];
    /// A
    CURRENT = [0, 0, 0, 0, 1, 0];
    /// rad
    ANGLE = [0, 0, 0, 0, 0, 1];
    /// 1/s; not a rotation.
    FREQUENCY = [0, 0, -1, 0, 0, 0];
    /// rad/s
    ANGULAR_VELOCITY = [0, 0, -1, 0, 0, 1];
    /// m/s
    VELOCITY = [1, 0, -1, 0, 0, 0];
    /// m/s^2
    ACCELERATION = [1, 0, -2, 0, 0, 0];
    /// N
    FORCE = [1, 1, -2, 0, 0, 0];
    /// Pa
    PRESSURE = [-1, 1, -2, 0, 0, 0];
    /// J; see [`Dimension::TORQUE`] for N m.
    ENERGY = [2, 1, -2, 0, 0, 0];
    /// W
    POWER = [2, 1, -3, 0, 0, 0];
    /// J/K
    CAPACITY = [2, 1, -2, -1, 0, 0];
    /// W/K
    CONDUCTANCE = [2, 1, -3, -1, 0, 0];
    /// K/W
    RESISTANCE = [-2, -1, 3, 1, 0, 0];
    /// W/(m^2 K)
    FILM_COEFFICIENT = [0, 1, -3, -1, 0, 0];
    /// m^2 K/W
    AREA_RESISTANCE = [0, -1, 3, 1, 0, 0];
    /// W/(m K)
    CONDUCTIVITY = [1, 1, -3, -1, 0, 0];
    /// kg/m^3
    DENSITY = [-3, 1, 0, 0, 0, 0];
    /// J/(kg K)
    SPECIFIC_HEAT = [2, 0, -2, -1, 0, 0];
    /// J/(m^3 K)
    VOLUMETRIC_HEAT_CAPACITY = [-1, 1, -2, -1, 0, 0];
    /// J/kg
    SPECIFIC_ENERGY = [2, 0, -2, 0, 0, 0];
    /// W/m^2
    HEAT_FLUX = [0, 1, -3, 0, 0, 0];
    /// W/m^3
    POWER_DENSITY = [-1, 1, -3, 0, 0, 0];
    /// kg/s
    MASS_FLOW = [0, 1, -1, 0, 0, 0];
    /// m^3/s
    VOLUME_FLOW = [3, 0, -1, 0, 0, 0];
    /// Pa s
    DYNAMIC_VISCOSITY = [-1, 1, -1, 0, 0, 0];
    /// m^2/s, also a thermal diffusivity.
    KINEMATIC_VISCOSITY = [2, 0, -1, 0, 0, 0];
    /// 1/K
    EXPANSION_COEFFICIENT = [0, 0, 0, -1, 0, 0];
    /// K/s
    HEATING_RATE = [0, 0, -1, 1, 0, 0];
    /// K/m
    TEMPERATURE_GRADIENT = [-1, 0, 0, 1, 0, 0];
    /// W/(m^2 K^4), the dimension of the Stefan-Boltzmann constant.
    RADIATION_CONSTANT = [0, 1, -3, -4, 0, 0];
    /// V
    VOLTAGE = [2, 1, -3, 0, -1, 0];
    /// ohm
    ELECTRICAL_RESISTANCE = [2, 1, -3, 0, -2, 0];
}

impl Dimension {
    const fn integers(exponents: [i32; 6]) -> Self {
        let [l, m, t, k, a, r] = exponents;
        Self {
            exponents: [
                Rational::integer(l),
                Rational::integer(m),
                Rational::integer(t),
                Rational::integer(k),
                Rational::integer(a),
                Rational::integer(r),
            ],
            kin: Kin::Plain,
        }
    }

    /// N m: equal to [`Dimension::ENERGY`], but not a power if multiplied by a frequency.
    pub const TORQUE: Self = Self::ENERGY.of_kin(Kin::Torque);

    pub(crate) const fn of_kin(self, kin: Kin) -> Self {
        Self { kin, ..self }
    }

    pub(crate) const fn kin(&self) -> Kin {
        self.kin
    }

    fn both(self) -> Known {
        (self.kin, self.exponents)
    }

    /// The dimension of a value in its usual unit: only a torque is more than its exponents there.
    pub(crate) fn as_written(self) -> Self {
        let torque = self.kin == Kin::Torque && self == Self::ENERGY;
        if torque { self } else { self.of_kin(Kin::Plain) }
    }

    /// True if a torque times a frequency (1/s, Hz), or a torque over a time, is part of it.
    ///
    /// A torque is an energy per radian. Times a rotational speed (rad/s) it is a power; times a
    /// frequency of revolutions it is too small by a factor of 2π.
    pub fn is_torque_per_time(&self) -> bool {
        self.kin == Kin::TorquePerTime
    }

    /// The exponents of length, mass, time, temperature, current and angle.
    pub const fn exponents(&self) -> [Rational; 6] {
        self.exponents
    }

    /// The dimension of a product; `None` if an exponent overflows.
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        let product = self.zip(other, Rational::checked_add)?;
        Some(product.of_kin(Kin::of_product(self.both(), other.both(), product.exponents)))
    }

    /// The dimension of a quotient; `None` if an exponent overflows.
    pub fn checked_div(self, other: Self) -> Option<Self> {
        let quotient = self.zip(other, Rational::checked_sub)?;
        Some(quotient.of_kin(Kin::of_quotient(self.both(), other.both(), quotient.exponents)))
    }

    /// The dimension of a power; `None` if an exponent overflows.
    pub fn checked_pow(self, exponent: Rational) -> Option<Self> {
        let mut exponents = self.exponents;
        for e in &mut exponents {
            *e = e.checked_mul(exponent)?;
        }
        let kin = if exponent == Rational::ONE { self.kin } else { Kin::Plain };
        Some(Self { exponents, kin })
    }

    fn zip(self, other: Self, combine: fn(Rational, Rational) -> Option<Rational>) -> Option<Self> {
        let mut exponents = self.exponents;
        for (mine, theirs) in exponents.iter_mut().zip(other.exponents) {
            *mine = combine(*mine, theirs)?;
        }
        Some(Self { exponents, kin: Kin::Plain })
    }

    /// True if it is [`Dimension::NONE`].
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }
}

impl fmt::Debug for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Dimension({self})")
    }
}
