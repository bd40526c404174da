//! Forward-mode derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::Scalar;

/// A value and its derivatives with respect to `N` variables.
///
/// Source: A. Griewank and A. Walther, Evaluating Derivatives, 2nd edition (SIAM 2008), chapter 3
/// (forward mode).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Dual<const N: usize> {
    /// The value of the function itself.
    pub value: f64,
    /// One derivative per variable.
    pub derivatives: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A constant: all derivatives are 0.
    pub const fn constant(value: f64) -> Self {
        Self { value, derivatives: [0.0; N] }
    }

    /// The variable `index`: its own derivative is 1. An index from `N` on gives a constant.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut dual = Self::constant(value);
        if let Some(own) = dual.derivatives.get_mut(index) {
            *own = 1.0;
        }
        dual
    }
}

/// A slope times a derivative. A derivative of 0 stays 0, however steep the function.
fn times(slope: f64, derivative: f64) -> f64 {
    if derivative == 0.0 { 0.0 } else { slope * derivative }
}

/// The slope of `value = x^a`; 0 if it is infinite: at x = 0 for 0 < a < 1.
fn power_slope(base: f64, exponent: f64, value: f64) -> f64 {
    if base == 0.0 && (0.0..1.0).contains(&exponent) {
        0.0
    } else if base > 0.0 && value > 0.0 && value.is_finite() {
        exponent * (value / base)
    } else {
        exponent * base.powf(exponent - 1.0)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;

    #[inline]
    fn add(mut self, other: Self) -> Self {
        self.value += other.value;
        for (mine, theirs) in self.derivatives.iter_mut().zip(other.derivatives) {
            *mine += theirs;
        }
        self
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;

    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self.value -= other.value;
        for (mine, theirs) in self.derivatives.iter_mut().zip(other.derivatives) {
            *mine -= theirs;
        }
        self
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        self.chain2(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.chain2(other, quotient, [1.0 / other.value, -quotient / other.value])
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, derivatives: self.derivatives.map(|d| -d) }
    }
}

impl<const N: usize> Scalar for Dual<N> {
    fn from_f64(value: f64) -> Self {
        Self::constant(value)
    }

    fn value(self) -> f64 {
        self.value
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivatives.iter().all(|d| d.is_finite())
    }

    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root == 0.0 { 0.0 } else { 0.5 / root })
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }

    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    fn tanh(self) -> Self {
        let value = self.value.tanh();
        self.chain(value, 1.0 - value * value)
    }

    fn powi(self, exponent: i32) -> Self {
        let slope = match exponent.checked_sub(1) {
            Some(less) if exponent != 0 => f64::from(exponent) * self.value.powi(less),
            _ => 0.0,
        };
        self.chain(self.value.powi(exponent), slope)
    }

    fn powf(self, exponent: f64) -> Self {
        let value = self.value.powf(exponent);
        self.chain(value, power_slope(self.value, exponent, value))
    }

    fn pow(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        // 0^b is constantly 0 for b > 0, while ln 0 is infinite.
        let in_exponent = if self.value == 0.0 { 0.0 } else { value * self.value.ln() };
        self.chain2(exponent, value, [power_slope(self.value, exponent.value, value), in_exponent])
    }

    #[inline]
    fn plus(mut self, term: f64) -> Self {
        self.value += term;
        self
    }

    #[inline]
    fn scaled(self, factor: f64) -> Self {
        self.chain(self.value * factor, factor)
    }

    #[inline]
    fn chain(self, value: f64, slope: f64) -> Self {
        if slope.is_finite() {
            // the sum with 0 is never -0
            return Self { value, derivatives: self.derivatives.map(|d| slope * d + 0.0) };
        }
        Self { value, derivatives: self.derivatives.map(|d| times(slope, d)) }
    }

    #[inline]
    fn chain2(self, other: Self, value: f64, slopes: [f64; 2]) -> Self {
        let [mine, theirs] = slopes;
        let mut derivatives = self.derivatives;
        let both = derivatives.iter_mut().zip(other.derivatives);
        // without a case for each derivative, which would cost a third more
        if mine.is_finite() && theirs.is_finite() {
            both.for_each(|(d, o)| *d = mine * *d + theirs * o + 0.0);
        } else {
            both.for_each(|(d, o)| *d = times(mine, *d) + times(theirs, o));
        }
        Self { value, derivatives }
    }
}
