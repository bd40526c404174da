//! Arithmetic on ranges of numbers.
//!
//! Rounding is not directed: ends are right to the rounding of the operations that found them.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Mul, Neg, Sub};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Interval {
    pub(crate) const ZERO: Self = Self { low: 0.0, high: 0.0 };
    /// Nothing is known.
    pub(crate) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    pub(crate) fn point(value: f64) -> Self {
        Self::new(value, value)
    }

    /// Everything, where an end is not a number.
    pub(crate) fn new(low: f64, high: f64) -> Self {
        if low <= high { Self { low, high } } else { Self::ALL }
    }

    pub(crate) fn is_bounded(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    pub(crate) fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    pub(crate) fn width(self) -> f64 {
        self.high - self.low
    }

    /// The largest absolute value.
    pub(crate) fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    pub(crate) fn hull(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.max(other.high))
    }

    /// The range of a function that never falls.
    pub(crate) fn rising(self, function: impl Fn(f64) -> f64) -> Self {
        Self::new(function(self.low), function(self.high))
    }

    pub(crate) fn reciprocal(self) -> Self {
        if self.low <= 0.0 && self.high >= 0.0 {
            return Self::ALL;
        }
        Self::new(self.high.recip(), self.low.recip())
    }

    pub(crate) fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self::new(0.0, self.magnitude())
        }
    }

    /// A whole power, not negative.
    pub(crate) fn power(self, exponent: u32) -> Self {
        let power = |x: f64| (0..exponent).fold(1.0, |product, _| product * x);
        if exponent.is_multiple_of(2) { self.abs().rising(power) } else { self.rising(power) }
    }

    pub(crate) fn sin(self) -> Self {
        // the first crest and the first trough from the lower end on
        let next = |from: f64| from + 2.0 * PI * ((self.low - from) / (2.0 * PI)).ceil();
        let ends = (self.low.sin(), self.high.sin());
        let high = if next(FRAC_PI_2) <= self.high { 1.0 } else { ends.0.max(ends.1) };
        let low = if next(-FRAC_PI_2) <= self.high { -1.0 } else { ends.0.min(ends.1) };
        if self.is_bounded() { Self::new(low, high) } else { Self::new(-1.0, 1.0) }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.low + other.low, self.high + other.high)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let ends =
            [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        if ends.iter().any(|end| end.is_nan()) {
            return Self::ALL;
        }
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { low, high }
    }
}

impl Mul<f64> for Interval {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        if factor == 0.0 {
            Self::ZERO
        } else if factor > 0.0 {
            Self::new(self.low * factor, self.high * factor)
        } else {
            Self::new(self.high * factor, self.low * factor)
        }
    }
}
