//! The arithmetic that programs run on.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::expr::Program;

/// A number a [`Program`](crate::Program) can be evaluated on: `f64`, or [`Dual`](crate::Dual) for
/// derivatives.
///
/// Derivatives at points without one: `abs`, `min` and `max` take one side at their kinks
/// (`abs'(0) = 1`; `min` and `max` of equal values take the first; a table takes the piece above
/// its knot). `sqrt` and `x^a` with 0 < a < 1 have an infinite derivative at 0; it is given as 0,
/// so that a law whose conductance goes like `abs(dT)^0.25` has a finite Jacobian at `dT = 0`
/// (where the term `dT * dG/ddT` is 0). `x^a` with a > 1 has the exact derivative 0 at 0.
pub trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// True if it needs to know its piece of a table: see [`Scalar::on_piece`].
    const IN_PIECES: bool = false;

    /// A constant.
    fn from_f64(value: f64) -> Self;
    /// The value without its derivatives.
    fn value(self) -> f64;
    /// A value for a check that refuses the number or not, and decides nothing else; that of a
    /// range is its middle.
    fn sample(self) -> f64 {
        self.value()
    }
    /// The result of a program in another way than operation by operation, for numbers that have
    /// one.
    fn run_on(_program: &Program, _slots: &[Self]) -> Option<Self> {
        None
    }
    /// True if the value and all derivatives are finite.
    fn is_finite(self) -> bool;
    /// Absolute value.
    fn abs(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// e^x.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Sine of an angle in rad.
    fn sin(self) -> Self;
    /// Cosine of an angle in rad.
    fn cos(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Whole power.
    fn powi(self, exponent: i32) -> Self;
    /// Constant real power of a base that is not negative.
    fn powf(self, exponent: f64) -> Self;
    /// Real power of a base that is not negative, both varying.
    fn pow(self, exponent: Self) -> Self;
    /// The sum with a constant.
    #[must_use]
    fn plus(self, term: f64) -> Self {
        self + Self::from_f64(term)
    }
    /// The product with a constant.
    #[must_use]
    fn scaled(self, factor: f64) -> Self {
        self * Self::from_f64(factor)
    }
    /// A function of this number, from its value and its slope here.
    fn chain(self, value: f64, slope: f64) -> Self;
    /// A function of this and another number, from its value and its slopes along each.
    fn chain2(self, other: Self, value: f64, slopes: [f64; 2]) -> Self;

    /// The same number, which comes from this piece of a table.
    #[must_use]
    fn on_piece(self, _piece: usize) -> Self {
        self
    }

    /// The smaller; the first of equal values; NaN if one of them is NaN.
    fn min(self, other: Self) -> Self {
        if other.value() < self.value() || other.value().is_nan() { other } else { self }
    }

    /// The larger; the first of equal values; NaN if one of them is NaN.
    fn max(self, other: Self) -> Self {
        if other.value() > self.value() || other.value().is_nan() { other } else { self }
    }
}

impl Scalar for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }

    fn abs(self) -> Self {
        self.abs()
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }

    fn exp(self) -> Self {
        self.exp()
    }

    fn ln(self) -> Self {
        self.ln()
    }

    fn sin(self) -> Self {
        self.sin()
    }

    fn cos(self) -> Self {
        self.cos()
    }

    fn tanh(self) -> Self {
        self.tanh()
    }

    fn powi(self, exponent: i32) -> Self {
        self.powi(exponent)
    }

    fn powf(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    fn pow(self, exponent: Self) -> Self {
        self.powf(exponent)
    }

    fn chain(self, value: f64, _: f64) -> Self {
        value
    }

    fn chain2(self, _: Self, value: f64, _: [f64; 2]) -> Self {
        value
    }
}
