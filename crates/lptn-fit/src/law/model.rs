//! The laws, as functions of coefficients and variables.

use std::fmt;

use lptn_units::{Dimension, EvalError, Rational};

use super::points::Points;
use super::powers::power_name;
use super::written::WrittenLaw;

/// A law of power over speed.
#[derive(Clone, Debug)]
pub enum LossLaw {
    /// The sum of these powers of the speed, each with a coefficient of any sign. If one is
    /// negative, the best sum without negative coefficients is one of the shorter sums, which is
    /// listed too.
    Powers(Vec<Rational>),
    /// One power with an exponent that is fitted too.
    FreeExponent,
    /// A law that a user wrote.
    Written(Box<WrittenLaw>),
}

impl LossLaw {
    /// omega, omega^(5/3) and omega^3, every sum of them, and a free exponent.
    pub fn standard() -> Vec<Self> {
        let exponents =
            [Rational::ONE, Rational::new(5, 3).unwrap_or(Rational::ONE), Rational::integer(3)];
        let subsets: [&[usize]; 7] = [&[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2], &[0, 1, 2]];
        let sum = |subset: &&[usize]| Self::Powers(subset.iter().map(|&i| exponents[i]).collect());
        subsets.iter().map(sum).chain([Self::FreeExponent]).collect()
    }

    /// The number of coefficients.
    pub fn count(&self) -> usize {
        match self {
            Self::Powers(exponents) => exponents.len(),
            Self::FreeExponent => 2,
            Self::Written(law) => law.coefficients().len(),
        }
    }

    /// Names and dimensions of the coefficients. That of a free exponent is the power at the
    /// highest speed.
    pub(crate) fn coefficients(&self) -> Vec<(String, Dimension)> {
        let per_speed = |exponent: Rational| {
            let speed =
                Dimension::ANGULAR_VELOCITY.checked_pow(exponent).unwrap_or(Dimension::NONE);
            Dimension::POWER.checked_div(speed).unwrap_or(Dimension::NONE)
        };
        match self {
            Self::Powers(exponents) => {
                let names = ["a", "b", "c", "d", "e", "f", "g", "h"];
                let all = exponents.iter().zip(names);
                all.map(|(exponent, name)| (name.to_owned(), per_speed(*exponent))).collect()
            }
            Self::FreeExponent => {
                vec![("P_top".to_owned(), Dimension::POWER), ("n".to_owned(), Dimension::NONE)]
            }
            Self::Written(law) => law.coefficients().to_vec(),
        }
    }

    /// The value in W at a point, and its derivatives by the coefficients (SI units).
    pub(crate) fn evaluate(
        &self,
        p: &[f64],
        points: &Points,
        point: usize,
    ) -> Result<(f64, Vec<f64>), EvalError> {
        let omega = points.speed()[point];
        match self {
            Self::Powers(exponents) => {
                let slopes: Vec<f64> = exponents.iter().map(|e| omega.powf(e.to_f64())).collect();
                Ok((slopes.iter().zip(p).map(|(slope, p)| slope * p).sum(), slopes))
            }
            Self::FreeExponent => {
                let ratio = omega / points.largest_speed();
                let shape = ratio.powf(p[1]);
                Ok((p[0] * shape, vec![shape, p[0] * shape * ratio.ln()]))
            }
            Self::Written(law) => law.evaluate(p, points.variables(), point),
        }
    }
}

impl fmt::Display for LossLaw {
    /// `omega + omega^3`, `omega^n`, or the law as written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Powers(exponents) => {
                let names: Vec<String> =
                    exponents.iter().map(|e| power_name("omega", *e)).collect();
                f.write_str(&names.join(" + "))
            }
            Self::FreeExponent => f.write_str("omega^n"),
            Self::Written(law) => f.write_str(law.text()),
        }
    }
}
