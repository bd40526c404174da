//! Numbers that remember their pieces of piecewise functions.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::Scalar;

/// A value with a number for the pieces of `abs`, `min`, `max` and tables that led to it. If two
/// evaluations of one program have different traces, a kink may lie between them. If they have the
/// same, and every argument of such a function is monotonic, none does.
///
/// A value that does not depend on a variable leaves no trace.
///
/// ```
/// use lptn_units::{Scalar, Traced};
///
/// let above = |x: f64| (Traced::variable(x) + Traced::from_f64(-50.0)).max(Traced::from_f64(0.0));
/// assert_eq!(above(20.0).trace(), above(49.0).trace());
/// assert_ne!(above(49.0).trace(), above(51.0).trace());
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Traced {
    value: f64,
    trace: u64,
    varies: bool,
}

/// An odd number without a pattern.
const FACTOR: u64 = 0x517c_c1b7_2722_0a95;

fn mixed(a: u64, b: u64) -> u64 {
    (a.rotate_left(5) ^ b).wrapping_mul(FACTOR)
}

impl Traced {
    /// A number that varies.
    #[must_use]
    pub const fn variable(value: f64) -> Self {
        Self { value, trace: 0, varies: true }
    }

    /// The number of the pieces; 0 if there was none.
    #[must_use]
    pub const fn trace(self) -> u64 {
        self.trace
    }

    fn of(self, value: f64) -> Self {
        Self { value, ..self }
    }

    fn with(self, other: Self, value: f64) -> Self {
        let trace = match (self.trace, other.trace) {
            (0, trace) | (trace, 0) => trace,
            (a, b) => mixed(a, b),
        };
        Self { value, trace, varies: self.varies || other.varies }
    }

    fn on_piece(self, piece: u64) -> Self {
        let trace = if self.varies { mixed(self.trace, piece + 1) } else { self.trace };
        Self { trace, ..self }
    }
}

impl Add for Traced {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.with(other, self.value + other.value)
    }
}

impl Sub for Traced {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.with(other, self.value - other.value)
    }
}

impl Mul for Traced {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.with(other, self.value * other.value)
    }
}

impl Div for Traced {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.with(other, self.value / other.value)
    }
}

impl Neg for Traced {
    type Output = Self;

    fn neg(self) -> Self {
        self.of(-self.value)
    }
}

impl Scalar for Traced {
    const IN_PIECES: bool = true;

    fn from_f64(value: f64) -> Self {
        Self { value, trace: 0, varies: false }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    fn abs(self) -> Self {
        self.of(self.value.abs()).on_piece(u64::from(self.value < 0.0))
    }

    fn sqrt(self) -> Self {
        self.of(self.value.sqrt())
    }

    fn exp(self) -> Self {
        self.of(self.value.exp())
    }

    fn ln(self) -> Self {
        self.of(self.value.ln())
    }

    fn sin(self) -> Self {
        self.of(self.value.sin())
    }

    fn cos(self) -> Self {
        self.of(self.value.cos())
    }

    fn tanh(self) -> Self {
        self.of(self.value.tanh())
    }

    fn powi(self, exponent: i32) -> Self {
        self.of(self.value.powi(exponent))
    }

    fn powf(self, exponent: f64) -> Self {
        self.of(self.value.powf(exponent))
    }

    fn pow(self, exponent: Self) -> Self {
        self.with(exponent, self.value.powf(exponent.value))
    }

    fn chain(self, value: f64, _: f64) -> Self {
        self.of(value)
    }

    fn chain2(self, other: Self, value: f64, _: [f64; 2]) -> Self {
        self.with(other, value)
    }

    fn on_piece(self, piece: usize) -> Self {
        Self::on_piece(self, piece as u64)
    }

    fn min(self, other: Self) -> Self {
        let second = other.value < self.value || other.value.is_nan();
        self.with(other, if second { other.value } else { self.value }).on_piece(second.into())
    }

    fn max(self, other: Self) -> Self {
        let second = other.value > self.value || other.value.is_nan();
        self.with(other, if second { other.value } else { self.value }).on_piece(second.into())
    }
}

#[cfg(test)]
mod tests {
    use super::Traced;
    use crate::Scalar;

    #[test]
    fn constants_and_smooth_functions_leave_no_trace() {
        let number = Traced::from_f64(-3.0).abs().max(Traced::from_f64(1.0));
        assert_eq!((number.value(), number.trace()), (3.0, 0));
        let smooth = (Traced::variable(2.0) * number).exp().tanh().powf(0.3);
        assert_eq!(smooth.trace(), 0);
    }

    #[test]
    fn each_side_of_a_kink_has_its_trace_wherever_it_stands() {
        let band = |x: f64| {
            let distance = (Traced::variable(x) - Traced::from_f64(5.0)).abs();
            (Traced::from_f64(1.0) - distance).max(Traced::from_f64(0.0)) * Traced::from_f64(7.0)
        };
        let traces = [3.0, 4.5, 5.5, 7.0].map(|x| band(x).trace());
        for (i, a) in traces.iter().enumerate() {
            assert!(traces[..i].iter().all(|b| a != b) && *a != 0, "{traces:?}");
        }
        assert_eq!(band(3.0).trace(), band(-100.0).trace());
    }
}
