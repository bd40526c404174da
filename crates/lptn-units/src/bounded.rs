//! Bounds as numbers that laws are evaluated on.
//!
//! A law is written once, generic over [`Scalar`]. On bounds it gives bounds, as long as it takes
//! no decision by a value. A law that does so looks at one number of a range, and its result then
//! has no bound: [`Bounded::watched`] notices every look.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::expr::Program;
use crate::scalar::Scalar;
use crate::taylor::Taylor;

thread_local! {
    /// True if a range was taken for one number since [`Bounded::watched`] began.
    static LOOKED: Cell<bool> = const { Cell::new(false) };
}

/// Bounds on a number and on its Taylor coefficients, on which programs and laws are evaluated.
///
/// ```
/// use lptn_units::{Bounded, Scalar, Taylor};
///
/// let law = |x: Bounded| x * x + Bounded::from_f64(1.0);
/// let bounds = Bounded::watched(|| law(Bounded::from(Taylor::variable(2.0, 3.0))));
/// assert_eq!(bounds.and_then(|b| b.taylor().range()), Some([5.0, 10.0]));
///
/// // a law that decides by a value has no bounds where the decision could differ
/// let decides = |x: Bounded| if x.value() > 2.5 { x } else { -x };
/// let bounds = Bounded::watched(|| decides(Bounded::from(Taylor::variable(2.0, 3.0))));
/// assert_eq!(bounds, None);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounded(Taylor);

impl Bounded {
    /// The bounds.
    pub fn taylor(self) -> Taylor {
        self.0
    }

    /// The result of a calculation on bounds; `None` if it took a range for one number, so that
    /// its bounds need not hold.
    pub fn watched<R>(calculate: impl FnOnce() -> R) -> Option<R> {
        let before = LOOKED.replace(false);
        let result = calculate();
        let looked = LOOKED.replace(before);
        (!looked).then_some(result)
    }

    fn of(self, function: impl FnOnce(Taylor) -> Taylor) -> Self {
        Self(function(self.0))
    }

    /// The only number of the range, or its middle.
    fn middle(self) -> f64 {
        self.0.range().map_or(f64::NAN, |[low, high]| 0.5 * low + 0.5 * high)
    }

    fn is_one_number(self) -> bool {
        self.0.degree() == 0
            && self.0.range().is_some_and(|[low, high]| low.to_bits() == high.to_bits())
    }
}

impl From<Taylor> for Bounded {
    fn from(bounds: Taylor) -> Self {
        Self(bounds)
    }
}

impl Add for Bounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Bounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Bounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for Bounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl Neg for Bounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Scalar for Bounded {
    fn from_f64(value: f64) -> Self {
        Self(Taylor::constant(value))
    }

    fn value(self) -> f64 {
        if !self.is_one_number() {
            LOOKED.set(true);
        }
        self.middle()
    }

    fn sample(self) -> f64 {
        self.middle()
    }

    fn is_finite(self) -> bool {
        self.0.range().is_some()
    }

    fn run_on(program: &Program, slots: &[Self]) -> Option<Self> {
        let at = |slot: u32| slots.get(slot as usize).map_or(Taylor::unknown(), |bounds| bounds.0);
        Some(Self(program.enclosed(&at)))
    }

    fn abs(self) -> Self {
        self.of(Taylor::abs)
    }

    fn sqrt(self) -> Self {
        self.of(Taylor::square_root)
    }

    fn exp(self) -> Self {
        self.of(Taylor::exp)
    }

    fn ln(self) -> Self {
        self.of(Taylor::ln)
    }

    fn sin(self) -> Self {
        self.of(Taylor::sin)
    }

    fn cos(self) -> Self {
        self.of(Taylor::cos)
    }

    fn tanh(self) -> Self {
        self.of(Taylor::tanh)
    }

    fn powi(self, exponent: i32) -> Self {
        self.powf(f64::from(exponent))
    }

    fn powf(self, exponent: f64) -> Self {
        self.of(|base| base.power(exponent))
    }

    fn pow(self, exponent: Self) -> Self {
        Self((self.0.ln() * exponent.0).exp())
    }

    fn chain(self, value: f64, _: f64) -> Self {
        LOOKED.set(true);
        Self(Taylor::constant(value))
    }

    fn chain2(self, _: Self, value: f64, slope: [f64; 2]) -> Self {
        self.chain(value, slope[0])
    }

    fn min(self, other: Self) -> Self {
        Self(self.0.smaller(other.0))
    }

    fn max(self, other: Self) -> Self {
        Self(self.0.larger(other.0))
    }
}
