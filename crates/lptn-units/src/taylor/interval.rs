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

    /// All numbers between two ends; everything if an end is not a number.
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
        let [a, b] = [self.low * other.low, self.low * other.high];
        let [c, d] = [self.high * other.low, self.high * other.high];
        if (a + b + c + d).is_nan() && [a, b, c, d].iter().any(|end| end.is_nan()) {
            return Self::ALL;
        }
        let lesser = |x: f64, y: f64| if x < y { x } else { y };
        let larger = |x: f64, y: f64| if x > y { x } else { y };
        let low = lesser(lesser(a, b), lesser(c, d));
        let high = larger(larger(a, b), larger(c, d));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(low: f64, high: f64) -> Interval {
        Interval::new(low, high)
    }

    /// Moore, Kearfott, Cloud, chapter 2.
    #[test]
    fn sums_and_products_are_those_of_the_ends() {
        assert_eq!(of(-1.0, 2.0) + of(3.0, 5.0), of(2.0, 7.0));
        assert_eq!(of(-1.0, 2.0) - of(3.0, 5.0), of(-6.0, -1.0));
        assert_eq!(-of(-1.0, 2.0), of(-2.0, 1.0));
        assert_eq!(of(-1.0, 2.0) * of(3.0, 5.0), of(-5.0, 10.0));
        assert_eq!(of(-2.0, -1.0) * of(-5.0, 3.0), of(-6.0, 10.0));
        assert_eq!((of(-1.0, 2.0) * 3.0, of(-1.0, 2.0) * -3.0), (of(-3.0, 6.0), of(-6.0, 3.0)));
        assert_eq!((of(-1.0, 2.0) * 0.0, Interval::ALL * 0.0), (Interval::ZERO, Interval::ZERO));
        assert_eq!(
            (Interval::ZERO * Interval::ALL, Interval::ALL * Interval::ZERO),
            (Interval::ZERO, Interval::ZERO)
        );
        // 0 times something without bound may be anything
        assert_eq!(of(0.0, 1.0) * Interval::ALL, Interval::ALL);
        assert_eq!(of(2.0, 4.0).reciprocal(), of(0.25, 0.5));
        assert_eq!(of(-4.0, -2.0).reciprocal(), of(-0.5, -0.25));
        for over_zero in [of(-1.0, 1.0), of(0.0, 1.0), of(-1.0, 0.0)] {
            assert_eq!(over_zero.reciprocal(), Interval::ALL);
        }
    }

    #[test]
    fn magnitudes_and_whole_powers_know_where_zero_is() {
        assert_eq!(of(-3.0, 2.0).abs(), of(0.0, 3.0));
        assert_eq!((of(1.0, 2.0).abs(), of(-3.0, -1.0).abs()), (of(1.0, 2.0), of(1.0, 3.0)));
        assert_eq!(
            (of(-3.0, 2.0).power(2), of(-3.0, 2.0).power(3)),
            (of(0.0, 9.0), of(-27.0, 8.0))
        );
        assert_eq!(of(-3.0, -2.0).power(2), of(4.0, 9.0));
        assert_eq!(of(-3.0, 2.0).power(0), Interval::point(1.0));
        assert_eq!((of(-3.0, 2.0).magnitude(), of(-3.0, 2.0).width()), (3.0, 5.0));
        assert_eq!(of(-1.0, 0.0).hull(of(2.0, 3.0)), of(-1.0, 3.0));
        assert!(
            of(-3.0, 2.0).is_bounded()
                && !of(0.0, f64::INFINITY).is_bounded()
                && !Interval::ALL.is_bounded()
        );
        assert!(Interval::ZERO.is_zero() && !of(0.0, 1.0).is_zero() && !of(-1.0, 0.0).is_zero());
        assert_eq!((of(1.0, 0.0), of(f64::NAN, 0.0)), (Interval::ALL, Interval::ALL));
    }

    /// Against the largest and smallest of many values, widened by the change between two of them.
    #[test]
    fn sines_turn_at_crests_and_troughs() {
        let steps = 2000;
        for (from, width) in (-40..40)
            .flat_map(|k| [0.1, 1.0, 2.5, 4.0, 7.0].map(|width| (0.37 * f64::from(k), width)))
        {
            let found = of(from, from + width).sin();
            let values =
                (0..=steps).map(|i| (from + width * f64::from(i) / f64::from(steps)).sin());
            let (low, high) =
                values.fold((1.0_f64, -1.0_f64), |(low, high), v| (low.min(v), high.max(v)));
            let between = (width / f64::from(steps)).powi(2);
            assert!(
                found.low <= low && low - between <= found.low,
                "{from} {width}: {found:?} {low}"
            );
            assert!(
                found.high >= high && high + between >= found.high,
                "{from} {width}: {found:?} {high}"
            );
        }
        assert_eq!(of(0.0, f64::INFINITY).sin(), of(-1.0, 1.0));
    }
}
